#!/bin/bash
# Counts the instructions of the kernels anew and writes bench/instruction_counts.json.
#   bench/record_instruction_counts.sh [BUILD]    BUILD is build/ready if not given; it must hold the tests
set -euo pipefail
cd "$(dirname "$0")/.."
test="${1:-build/ready}/tests/instruction_count_test"
if [ ! -x "$test" ]; then
  echo "record_instruction_counts: no $test; build the target instruction_count_test first" >&2
  exit 2
fi
PALPATE_RECORD_INSTRUCTIONS=1 "$test"
git --no-pager diff --stat -- bench/instruction_counts.json
