#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints where the time of a run of Testing/run.sh went: the longest tests, the sum of each label, and the
time that each target took to compile.

    times.py SECONDS FOLDER...

SECONDS: how long ago the run began; older results are left out. FOLDER: build folders, each with the
`tests.xml` of `ctest --output-junit` and the `.ninja_log` of Ninja. Times are those of the clock while other
tests and compilations ran beside them: sums are larger than the time of the run.
"""
import collections
import os
import re
import sys
import time
import xml.etree.ElementTree as ElementTree

LONGEST = 40
SLOW = 10
"""From how many seconds on a test is to be in slow.txt."""


def tests(folder):
    """(seconds, name, labels) of each test of the folder that ran."""
    for case in ElementTree.parse(os.path.join(folder, "tests.xml")).iter("testcase"):
        if case.get("status") == "run" or case.find("failure") is not None:
            labels = [entry.get("value") for entry in case.iter("property") if entry.get("name") == "cmake_labels"]
            yield float(case.get("time")), case.get("name"), labels[0].split(";") if labels else []


def compilations(folder, since):
    """(seconds, target) of each command of Ninja whose last output is newer than `since`."""
    last = {}
    with open(os.path.join(folder, ".ninja_log"), encoding="utf-8") as log:
        for line in log:
            fields = line.rstrip("\n").split("\t")
            if len(fields) == 5:
                start, end, _, output, command = fields
                last[output] = (int(end) - int(start)) / 1000, command
    commands = {}
    for output, (seconds, command) in last.items():
        path = os.path.join(folder, output)
        if os.path.exists(path) and os.path.getmtime(path) >= since:
            found = re.search(r"([^/]+)\.dir/", output)
            commands[command] = seconds, found.group(1) if found else "links and generated files"
    return commands.values()


def known_slow():
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "slow.txt"), encoding="utf-8") as names:
        return {line.strip() for line in names}


def is_newer(path, since):
    return os.path.exists(path) and os.path.getmtime(path) >= since


def table(title, rows):
    if rows:
        print(f"\n{title}")
        for seconds, *words in rows:
            print(f"{seconds:9.1f} s  {' '.join(words)}")


def main():
    since = time.time() - float(sys.argv[1]) - 1
    ran, labelled, compiled = [], collections.Counter(), collections.Counter()
    for folder in sys.argv[2:]:
        where = os.path.basename(folder)
        if is_newer(os.path.join(folder, "tests.xml"), since):
            for seconds, name, labels in tests(folder):
                ran.append((seconds, where, name))
                for label in labels:
                    labelled[where, label] += seconds
        if is_newer(os.path.join(folder, ".ninja_log"), since):
            for seconds, target in compilations(folder, since):
                compiled[where, target] += seconds
    table(f"The {LONGEST} longest of {len(ran)} tests:", sorted(ran, reverse=True)[:LONGEST])
    known = known_slow()
    table(
        f"Over {SLOW} s, and not in Testing/slow.txt:",
        sorted(((s, w, n) for s, w, n in ran if w == "build" and s > SLOW and n not in known), reverse=True),
    )
    table("Tests of each label:", [(seconds, *key) for key, seconds in labelled.most_common()])
    table("Compilation of each target:", [(seconds, *key) for key, seconds in compiled.most_common(LONGEST)])


if __name__ == "__main__":
    main()
