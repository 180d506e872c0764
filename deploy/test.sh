#!/bin/bash
# Installs what is missing, builds, and runs the whole test suite. The last line is "N passed, N failed".
#   deploy/test.sh [--sanitizers]    after that, the unit and property tests once more with the address and
#                                    undefined-behaviour sanitizers: a second build, as long as the first
set -uo pipefail
cd "$(dirname "$0")/.." || exit
started=$SECONDS
. deploy/step.sh
sanitizers=no
for word in "$@"; do
  case $word in
    --sanitizers) sanitizers=yes ;;
    *) echo "deploy/test.sh: unknown option $word; --sanitizers is the only one" >&2; exit 2 ;;
  esac
done
trap 'rm -f "$step_log"' EXIT
jobs=$(nproc)
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
passed=0 failed=0

finish() {
  echo "total: $((SECONDS - started)) s"
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
  exit
}

# A set-up or build that fails counts as one failed test: the suite behind it did not run.
must() { "$@" || { failed=$((failed + 1)); finish; }; }

# Runs ctest and adds up its summary: "98% tests passed, 1 tests failed out of 42".
count_tests() {
  local name=$1 summary code=0
  shift
  step_lines=2000 step "$name" "$@" || code=$?
  summary=$(grep -E 'tests passed, [0-9]+ tests failed out of [0-9]+' "$step_log" | tail -n 1)
  if [[ $summary =~ ,\ ([0-9]+)\ tests\ failed\ out\ of\ ([0-9]+) ]]; then
    failed=$((failed + BASH_REMATCH[1]))
    passed=$((passed + BASH_REMATCH[2] - BASH_REMATCH[1]))
    [ "$code" -eq 0 ] || [ "${BASH_REMATCH[1]}" -gt 0 ] || failed=$((failed + 1))
  else
    failed=$((failed + 1))
  fi
}

must deploy/install_packages.sh deploy/packages.txt deploy/packages-test.txt
must step "head CT" deploy/fetch_head.sh
must step "configure" cmake --preset ready
must step "build" cmake --build --preset ready --parallel "$jobs"
count_tests "tests" ctest --preset ready -j2
[ "$sanitizers" = yes ] || finish
must step "configure with sanitizers" cmake --preset asan
must step "build with sanitizers" cmake --build --preset asan --parallel "$jobs"
count_tests "tests with sanitizers" ctest --preset asan -j2 -L '^(unit|property)$'
finish
