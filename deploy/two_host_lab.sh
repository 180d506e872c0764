#!/bin/bash
# Two PCs in one: two network namespaces with a cable between them, and a session split over them. Nothing is left behind
# but the results; the machine's own network is not touched. Needs no root where the kernel lets users make namespaces.
#   deploy/two_host_lab.sh run p2|p3 [SCENE] [options]   one session; results in OUT/pc1 and OUT/pc2
#   deploy/two_host_lab.sh table [SCENE] [options]       one PC, then p2 and p3 over delays and losses; OUT/table.md
#   deploy/two_host_lab.sh try COMMAND1 COMMAND2         a command of your own on each PC; ends when both have
# Options:
#   --delay MS --jitter MS --loss PERCENT   of the cable, each way (run, try); else the two are joined directly
#   --cut "AFTER FOR"                       pulls the cable AFTER s from when the two have met, for FOR s (run); OUT/cut.txt says when
#   --clock S                               PC 2's clock is S seconds ahead of PC 1's (run, try); below 0: behind
#   --seconds S                             of each session, once all nodes run (default 10)
#   --delays "0 5 20 50" --losses "0 1 10"  of the table
#   --out DIR   (default out/two_host_lab)  --bin-dir DIR  (default build/release/bin)
# PC 1 is 192.168.77.1 and PC 2 is 192.168.77.2, each on its interface eth0.
set -euo pipefail

fail() { echo "two_host_lab: $*" >&2; exit 2; }

if [ -z "${PALPATE_LAB_CABLE:-}" ]; then  # once more, in a network namespace of our own: the room of the cable
  own=(--net --kill-child)
  [ "$(id -u)" -eq 0 ] || own+=(--user --map-root-user)
  unshare "${own[@]}" true 2>/dev/null || fail "this kernel makes no network namespaces for you; run it as root"
  PALPATE_LAB_CABLE=1 exec unshare "${own[@]}" "$0" "$@"
fi

top=$(cd "$(dirname "$0")/.." && pwd)
delay=0 jitter=0 loss=0 cut='' clock=0 seconds=10 out=out/two_host_lab bin=$top/build/release/bin
delays="0 5 20 50" losses="0 1 10"
words=()
while [ $# -gt 0 ]; do
  case $1 in
    --delay | --jitter | --loss | --cut | --clock | --seconds | --out | --delays | --losses)
      [ $# -gt 1 ] || fail "$1: give a value"
      printf -v "${1#--}" %s "$2"
      shift
      ;;
    --bin-dir) bin=$2; shift ;;
    --*) fail "unknown option $1; the head of this file lists them" ;;
    *) words+=("$1") ;;
  esac
  shift
done
[ -x "$bin/palpate" ] && [ -x "$bin/palpate-link" ] || fail "$bin: holds no palpate and palpate-link; build, or give --bin-dir"

pc1='' pc2='' cable='' cutter=''
tear_down() {
  for pid in $cutter $cable $pc1 $pc2; do kill "$pid" 2>/dev/null || true; done  # a namespace goes with its last process
  cable=''
  wait 2>/dev/null || true
}
trap tear_down EXIT
trap 'exit 130' INT TERM

on() {  # a command on a PC
  local ahead=()
  [ "$1" != "$pc2" ] || [ "$clock" = 0 ] || ahead=(unshare --time --monotonic "$clock" --fork)
  nsenter --target "$1" --net "${ahead[@]}" "${@:2}"
}

set_up() {
  unshare --net sleep infinity & pc1=$!
  unshare --net sleep infinity & pc2=$!
  for pid in $pc1 $pc2; do  # until each is in a namespace of its own
    while [ "$(readlink "/proc/$pid/ns/net")" = "$(readlink /proc/self/ns/net)" ]; do sleep 0.01; done
  done
}

# Lays the cable: a veth pair from PC to PC, or one from each PC to the model between them.
lay() {
  for end in cable1 cable2; do ip link delete $end 2>/dev/null || true; done
  on "$pc1" ip link delete eth0 2>/dev/null || true
  if [ "$delay $jitter $loss $cut" = "0 0 0 " ]; then
    ip link add eth0 netns "$pc1" type veth peer name eth0 netns "$pc2"
  else
    ip link add cable1 type veth peer name eth0 netns "$pc1"
    ip link add cable2 type veth peer name eth0 netns "$pc2"
    ip link set cable1 up
    ip link set cable2 up
  fi
  for n in 1 2; do
    local pc=pc$n
    on "${!pc}" ip link set lo up
    on "${!pc}" ip link set eth0 up
    on "${!pc}" ip address replace 192.168.77.$n/24 dev eth0
    on "${!pc}" ip route replace default dev eth0
  done
  cable=''
  [ "$delay $jitter $loss $cut" = "0 0 0 " ] && return
  "$bin/palpate-link" cable1 cable2 --delay-ms "$delay" --jitter-ms "$jitter" --loss-percent "$loss" >"$out/cable.txt" &
  cable=$!
}

# Pulls the cable for a while: neither PC has a carrier, as with a real one. Times are of PC 1's clock, in seconds.
cut_for_a_while() {
  local folder=$1 after=${cut% *} for=${cut#* } end
  until grep -q 'is there' "$folder/pc1.txt" && grep -q 'is there' "$folder/pc2.txt"; do sleep 0.05; done
  sleep "$after"
  read -r pulled _ </proc/uptime
  for end in cable1 cable2; do ip link set $end down; done
  sleep "$for"
  for end in cable1 cable2; do ip link set $end up; done
  read -r back _ </proc/uptime
  echo "pulled $pulled back $back" >"$folder/cut.txt"
}

# One session: run DEPLOYMENT SCENE FOLDER. Fails if one of the sides does.
session() {
  local deployment=$1 scene=$2 folder=$3 code=0 side1 side2
  mkdir -p "$folder"
  on "$pc1" "$bin/palpate" run "$scene" --deployment "$deployment" --side 1 --peers 192.168.77.2 --headless \
    --seconds "$seconds" --out "$folder/pc1" >"$folder/pc1.txt" 2>&1 &
  side1=$!
  on "$pc2" "$bin/palpate" run "$scene" --deployment "$deployment" --side 2 --peers 192.168.77.1 --headless \
    --seconds "$seconds" --out "$folder/pc2" >"$folder/pc2.txt" 2>&1 &
  side2=$!
  [ -z "$cut" ] || { cut_for_a_while "$folder" & cutter=$!; }
  wait "$side1" || code=$?
  wait "$side2" || code=$?
  [ -z "$cutter" ] || { kill "$cutter" 2>/dev/null || true; cutter=''; }
  [ $code -eq 0 ] || { tail -n 5 "$folder/pc1.txt" "$folder/pc2.txt" >&2; return $code; }
}

alone() {  # the same on one PC, for comparison: alone SCENE FOLDER
  mkdir -p "$2"
  on "$pc1" ip link set lo up
  on "$pc1" "$bin/palpate" run "$1" --headless --seconds "$seconds" --out "$2/pc1" >"$2/pc1.txt" 2>&1 ||
    { tail -n 5 "$2/pc1.txt" >&2; return 1; }
}

pull() {  # takes the cable away, if it is a model
  [ -z "$cable" ] || { kill "$cable"; wait "$cable" 2>/dev/null || true; cable=''; }
}

mkdir -p "$out"
set_up
case ${words[0]:-} in
  run)
    [[ ${words[1]:-} =~ ^p[23]$ ]] || fail "run: which deployment, p2 or p3?"
    lay
    session "${words[1]}" "${words[2]:-$top/scenes/head_press.toml}" "$out"
    for n in 1 2; do sed "s/^/pc$n: /" "$out/pc$n.txt" | tail -n 4; done
    ;;
  table)
    scene=${words[1]:-$top/scenes/head_press.toml}
    folders=("$out/all_0ms_0percent")
    alone "$scene" "${folders[0]}"
    echo "done: all on one PC, without a network"
    for deployment in p2 p3; do
      for delay in $delays; do
        for loss in $losses; do
          folder=$out/${deployment}_${delay}ms_${loss}percent
          lay
          session "$deployment" "$scene" "$folder"
          pull
          folders+=("$folder")
          echo "done: $deployment, $delay ms, $loss %"
        done
      done
    done
    python3 "$top/deploy/lab/link_table.py" "${folders[@]}" | tee "$out/table.md"
    ;;
  try)
    [ ${#words[@]} -eq 3 ] || fail "try: give two commands, in quotes"
    lay
    on "$pc2" bash -c "${words[2]}" & second=$!
    code=0
    on "$pc1" bash -c "${words[1]}" || code=$?
    wait $second || code=$?
    exit $code
    ;;
  *) fail "run, table or try? The head of this file says more" ;;
esac
