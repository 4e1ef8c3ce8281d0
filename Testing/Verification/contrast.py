#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""contrast.py SOLVER_TESTS DOCS : the table of high contrasts in DOCS/verification.md, from the test Contrast."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))
from documented_tables import markdown, replace_tables  # noqa: E402

program, docs = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    found = pathlib.Path(folder) / "found.json"
    subprocess.run([program, "--gtest_filter=Contrast.EnergyFluxes*", f"--gtest_output=json:{found}"], check=True)
    test = json.loads(found.read_text(encoding="utf-8"))["testsuites"][0]["testsuite"][0]
rows = []
for name, errors in test.items():
    # Of the entries of a test, the properties of this one have a shape, a kind of cells and a contrast.
    if name.count(", ") >= 2:
        shape, cells, contrast = name.rsplit(", ", 2)
        rows.append((shape, cells, f"{float(contrast):g}", *(f"{float(e):.0e}" if "e" in e else e
                                                              for e in errors.split())))
head = ("shape", "cells", "contrast", "energy", "fluxes", "means", "balance", "V-cycles")
page = pathlib.Path(docs) / "verification.md"
before, after = replace_tables(page, {"contrast": markdown(head, rows)})
page.write_text(after, encoding="utf-8")
