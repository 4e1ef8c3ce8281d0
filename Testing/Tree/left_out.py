# SPDX-License-Identifier: BSD-3-Clause
"""What a configuration leaves out, nothing that it runs needs: no test that sets up a fixture is in
Testing/slow.txt, or in Testing/nightly.txt of main, unless all tests that require the fixture are.

    left_out.py CTEST BUILD
"""
import json
import os
import subprocess
import sys

ctest, build = sys.argv[1:]
testing = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


def lines(name):
    with open(os.path.join(testing, name), encoding="utf-8") as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


listed = subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
properties = {
    test["name"]: {entry["name"]: entry["value"] for entry in test.get("properties", [])}
    for test in json.loads(listed.stdout)["tests"]
}
assert properties, "there are no tests"

left_out = {
    "Testing/slow.txt": {words[0] for words in lines("slow.txt")},
    "Testing/nightly.txt": {words[0] for words in lines("nightly.txt") if len(words) == 1},
}
faults = []
for where, names in left_out.items():
    for name in sorted(names & properties.keys()):
        made = set(properties[name].get("FIXTURES_SETUP", []))
        faults += [
            f"{where} has {name}, which {other} needs"
            for other, its in properties.items()
            if other not in names and made & set(its.get("FIXTURES_REQUIRED", []))
        ]
print("\n".join(faults))
sys.exit(bool(faults))
