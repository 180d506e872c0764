#!/usr/bin/env python3
"""Counts test cases after a run of CTest, and names those that failed or were skipped.

    count_tests.py JUNIT RESULTS

JUNIT is what `ctest --output-junit` wrote: one entry a test program. RESULTS is the folder where each program left the
results of its cases (GTEST_OUTPUT, see tests/CMakeLists.txt). CTest alone would count a program as passed whose cases
were all skipped. The last line is "N passed, N failed, N skipped".
"""
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path


class Count:
    def __init__(self):
        self.passed, self.failed, self.skipped = 0, 0, 0

    def fail(self, name, why):
        self.failed += 1
        print(f"failed: {name}" + (f": {why}" if why else ""))

    def skip(self, name, why):
        self.skipped += 1
        print(f"skipped: {name}: {why or 'no reason given'}")


def readable(path):
    """Parameters of cases may hold bytes that XML does not allow."""
    text = path.read_bytes().decode("utf-8", errors="replace")
    return re.sub("&#x?[0-9a-fA-F]+;|[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", "", text)


def reason(skipped):
    """GoogleTest puts file:line first, then what the test says of itself."""
    lines = [line.strip() for line in skipped.get("message", "").splitlines()]
    return " ".join(line for line in lines if line)


def count_cases(program, cases, count):
    """Counts the cases of one program; returns how many of them failed."""
    before = count.failed
    for case in cases:
        name = f"{program}: {case.get('classname')}.{case.get('name')}"
        skipped = case.find("skipped")
        if case.find("failure") is not None or case.find("error") is not None:
            count.fail(name, "")
        elif case.get("status") == "notrun":
            count.skip(name, "disabled")
        elif skipped is not None or case.get("result") == "skipped":
            count.skip(name, "" if skipped is None else reason(skipped))
        else:
            count.passed += 1
    return count.failed - before


def count_program(entry, results, count):
    program, status = entry.get("name"), entry.get("status")
    if status == "disabled":
        count.skip(program, "left out of this build")
        return
    try:
        cases = list(xml.fromstring(readable(results / f"{program}.xml")).iter("testcase"))
    except (OSError, xml.ParseError):
        count.fail(program, "it ended without results of its cases")
        return
    failed = count_cases(program, cases, count)
    if not cases:
        count.fail(program, "it ran no test")
    elif status != "run" and failed == 0:
        count.fail(program, "all its cases passed, but not the program")


def main(junit, results):
    count = Count()
    try:
        entries = list(xml.parse(junit).getroot().iter("testcase"))
        if not entries:
            count.fail("ctest", "no test was selected")
    except (OSError, xml.ParseError) as error:
        entries = []
        count.fail("ctest", f"no results: {error}")
    for entry in entries:
        count_program(entry, Path(results), count)
    print(f"{count.passed} passed, {count.failed} failed, {count.skipped} skipped")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: count_tests.py JUNIT RESULTS")
    main(sys.argv[1], sys.argv[2])
