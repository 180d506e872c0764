# shellcheck shell=bash
# For test.sh and demo.sh: steps that are quiet while they go well.
#   . deploy/step.sh
#   step "build" cmake --build build/ready
# What a step says goes to $step_log. On a terminal its last line shows while it runs; elsewhere a line a minute. A step
# that fails shows the last $step_lines lines of its log, and step returns its exit code.
step_log=${step_log:-$(mktemp)}
step_lines=60

step() {
  local name=$1 started=$SECONDS shown=$SECONDS code=0 pid
  shift
  : >"$step_log"
  [ -t 1 ] || printf '%s ...\n' "$name"
  "$@" >"$step_log" 2>&1 &
  pid=$!
  trap 'kill "$pid" 2>/dev/null; exit 130' INT TERM  # what runs behind a script does not hear Ctrl-C
  while kill -0 "$pid" 2>/dev/null; do
    sleep 0.5
    if [ -t 1 ]; then
      printf '\r\033[K%s  %d s  %.80s' "$name" $((SECONDS - started)) "$(tail -n 1 "$step_log" | tr -d '\r\t\033')"
    elif [ $((SECONDS - shown)) -ge 60 ]; then
      printf '%s ... %d s: %.80s\n' "$name" $((SECONDS - started)) "$(tail -n 1 "$step_log" | tr -d '\r\t\033')"
      shown=$SECONDS
    fi
  done
  wait "$pid" || code=$?
  trap - INT TERM
  [ -t 1 ] && printf '\r\033[K'
  if [ "$code" -eq 0 ]; then
    printf '%s: %d s\n' "$name" $((SECONDS - started))
  else
    printf '%s: failed after %d s (exit code %d); the end of what it said:\n' "$name" $((SECONDS - started)) "$code"
    tail -n "$step_lines" "$step_log"
  fi
  return "$code"
}
