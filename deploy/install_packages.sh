#!/bin/bash
# Installs those of Debian's packages named in the given lists that are missing. Says one line; needs root or sudo
# only if something is missing.
#   deploy/install_packages.sh LIST...        a list has one package a line, "#" starts a remark
set -euo pipefail

fail() {
  echo "install_packages: $*" >&2
  exit 2
}

[ $# -gt 0 ] || fail "no list given; write deploy/install_packages.sh deploy/packages.txt"
for list in "$@"; do [ -r "$list" ] || fail "$list: cannot be read; name a list of packages"; done
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this is no Debian; install what these lists name by hand: $*"
fi

wanted=0
missing=()
read -r -d '' -a packages < <(sed 's/#.*//' "$@" | sort -u && printf '\0')
for package in "${packages[@]}"; do
  wanted=$((wanted + 1))
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "packages: all $wanted are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "${#missing[@]} packages are missing and this is not root; install them as root: apt-get install ${missing[*]}"
  as_root=(sudo)
fi

[ ${#as_root[@]} -eq 0 ] || sudo true  # its question before anything is written over it
started=$SECONDS
line_every_s=${PALPATE_LINE_EVERY_S:-10}
log=$(mktemp)
trap 'rm -f "$log"; kill $(jobs -p) 2>/dev/null || true' EXIT
# Quiet while all is well, but not silent: what apt does now shows in place on a terminal, elsewhere in a line every ten seconds.
progress() {
  local shown=$SECONDS last
  while sleep 0.5; do
    last=$(tail -n 1 "$log" | tr -d '\r\t\033')
    if [ -t 1 ]; then
      printf '\r\033[Kpackages: %d s  %.80s' $((SECONDS - started)) "$last"
    elif [ $((SECONDS - shown)) -ge "$line_every_s" ]; then
      shown=$SECONDS
      printf 'packages: %d s  %.80s\n' $((SECONDS - started)) "$last"
    fi
  done
}
# Behind it the watcher, not apt: so that Ctrl-C and sudo's question reach apt.
apt() {
  local watcher code=0
  progress &
  watcher=$!
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Dpkg::Use-Pty=0 "$@" >>"$log" 2>&1 || code=$?
  kill "$watcher" 2>/dev/null && wait "$watcher" 2>/dev/null || true
  [ ! -t 1 ] || printf '\r\033[K'
  return "$code"
}
why() { grep -m 1 '^E:' "$log" || tail -n 1 "$log"; }

echo "packages: installing ${#missing[@]} of $wanted and what they need"
apt update || fail "apt-get update failed: $(why); check the network and /etc/apt"
apt install --yes --no-install-recommends "${missing[@]}" || fail "apt-get install failed: $(why)"
echo "packages: installed ${#missing[@]} in $((SECONDS - started)) s"
