#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lesson Examples/CalculiX: its page says what its commands print, and its temperatures are those of a bar of two
materials, and of CalculiX where that is installed."""

import math
import os
import re
import shlex
import shutil
import subprocess

from program import load, read_vtk_xml, run

SOURCE = os.environ["SMG_SOURCE_DIR"]
LESSON = os.path.join(SOURCE, "Examples", "CalculiX")


def expected(x):
    """Over 20 mm of copper and 20 mm of steel, from 20 degrees at the end, with 100 mW/mm^2."""
    return 20 + 100 * max(20 - x, 0) / 400 + 100 * min(40 - x, 20) / 50


if not os.path.lexists("Examples"):
    os.symlink(os.path.join(SOURCE, "Examples"), "Examples")
with open(os.path.join(LESSON, "README.md"), encoding="utf-8") as file:
    problem, commands, said, _ = (block.split("\n", 1)[1] for block in file.read().split("```")[1::2])
with open(os.path.join(LESSON, "heat.json"), encoding="utf-8") as file:
    assert file.read() == problem
printed = []
for command in commands.splitlines():
    program, *arguments = shlex.split(command)
    assert program == "build/bin/smg", command
    printed += run(*arguments).stdout.splitlines()
for line in said.splitlines():
    assert line in printed, (line, printed)

bar = read_vtk_xml("bar.vtu")
temperatures = [value for (value,) in bar["Solution"]]
for (x, _, _), value in zip(bar["Points"], temperatures):
    assert math.isclose(value, expected(x), abs_tol=1e-5), (x, value)
assert all(math.isclose(flux, 100, rel_tol=1e-5) for flux, _, _ in bar["Flux"])

if shutil.which("ccx"):
    shutil.copy(os.path.join(LESSON, "bar.inp"), "deck.inp")
    subprocess.run(["ccx", "deck"], check=True, capture_output=True, timeout=60)
    with open("deck.dat", encoding="ascii") as file:
        nodes = [line.split() for line in file if re.fullmatch(r" +\d+ +\S+\n?", line)]
    assert len(nodes) == len(temperatures), nodes
    for number, value in nodes:
        assert math.isclose(float(value), temperatures[int(number) - 1], abs_tol=1e-5), (number, value)
