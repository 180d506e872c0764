#!/bin/bash
# Installs what is missing, builds, and runs the tests; then some of them once more with sanitizers. The last line is
# "N passed, N failed, N skipped", counted by test case; those that failed or were skipped are named.
#   deploy/test.sh                   all but the cases that tests/thorough.cmake names; with the address sanitizer (and
#                                    undefined behaviour) what reads files and the wire
#   deploy/test.sh --all             every case; with the sanitizers all tests labelled `address` or `thread`
#   deploy/test.sh --sanitizers      every case; all unit and property tests in place of those labelled `address`
set -uo pipefail
cd "$(dirname "$0")/.." || exit
started=$SECONDS
. deploy/step.sh
all=no sanitizers=no
for word in "$@"; do
  case $word in
    --all) all=yes ;;
    --sanitizers) all=yes sanitizers=yes ;;
    *) echo "deploy/test.sh: unknown option $word; there are --all and --sanitizers" >&2; exit 2 ;;
  esac
done
trap 'rm -f "$step_log"' EXIT
jobs=$(nproc)
export UBSAN_OPTIONS=print_stacktrace=1
passed=0 failed=0 skipped=0

finish() {
  echo "total: $((SECONDS - started)) s"
  echo "$passed passed, $failed failed, $skipped skipped"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
  exit
}

# A set-up or build that fails counts as one failed test: the suite behind it did not run.
must() { "$@" || { failed=$((failed + 1)); finish; }; }

# A step that runs ctest with this preset and more options; adds up the cases of all its test programs.
count_tests() {
  local name=$1 preset=$2 results=build/$2/test_results counted code=0 summary='([0-9]+) passed, ([0-9]+) failed, ([0-9]+) skipped$'
  shift 2
  rm -rf "$results" && mkdir -p "$results"
  step_lines=2000 step "$name" ctest --preset "$preset" --output-junit "$PWD/$results/ctest.xml" "$@" || code=$?
  counted=$(deploy/count_tests.py "$results/ctest.xml" "$results") || true
  printf "%s\n" "${counted:-not counted}"
  if [[ $counted =~ $summary ]]; then
    passed=$((passed + BASH_REMATCH[1])) skipped=$((skipped + BASH_REMATCH[3]))
    failed=$((failed + BASH_REMATCH[2]))
    [ "$code" -eq 0 ] || [ "${BASH_REMATCH[2]}" -gt 0 ] || failed=$((failed + 1))
  else
    failed=$((failed + 1))
  fi
}

must deploy/install_packages.sh deploy/packages.txt deploy/packages-test.txt
must step "head CT" deploy/fetch_head.sh
must step "labelled abdomen" deploy/fetch_liver.sh
must step "configure" cmake --preset ready -DPALPATE_ROOMS=ON
must step "build" cmake --build --preset ready --parallel "$jobs"
cases=(-LE '^thorough$') target=doors_tests label='^doors$'
[ "$all" = no ] || cases=() target=address_tests label='^address$'
[ "$sanitizers" = no ] || target=all label='^(unit|property|sanitizers)$'
count_tests "tests" ready -j2 "${cases[@]}"
must step "configure with the address sanitizer" cmake --preset asan
must step "build with the address sanitizer" cmake --build --preset asan --parallel "$jobs" --target "$target"
count_tests "tests with the address sanitizer" asan -j2 -L "$label"
[ "$all" = yes ] || finish
must step "configure with the thread sanitizer" cmake --preset tsan
must step "build with the thread sanitizer" cmake --build --preset tsan --parallel "$jobs" --target thread_tests
count_tests "tests with the thread sanitizer" tsan -j2 -L '^thread$'
finish
