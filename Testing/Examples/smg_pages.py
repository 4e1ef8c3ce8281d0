#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages on meshes with groups print what their commands print. The temperatures of the deck of Examples/CalculiX are those of
a bar of two materials, and of CalculiX where that is installed."""

import math
import os
import re
import shlex
import shutil
import subprocess

from program import read_vtk_xml, run

SOURCE = os.environ["SMG_SOURCE_DIR"]
EXAMPLES = os.path.join(SOURCE, "Examples")


def check_page(page, problem):
    """The problem file is on the page; its commands, but those of Gmsh, print the text that follows them."""
    with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
        blocks = [block.split("\n", 1) for block in file.read().split("```")[1::2]]
    with open(os.path.join(EXAMPLES, problem), encoding="utf-8") as file:
        assert ["json", file.read()] in blocks, page
    kinds = [kind for kind, _ in blocks]
    commands = kinds.index("sh")
    assert kinds[commands + 1] == "", page
    printed = []
    for command in blocks[commands][1].splitlines():
        program, *arguments = shlex.split(command, comments=True)
        assert program in ("build/bin/smg", "gmsh"), command
        if program != "gmsh":
            printed += run(*arguments).stdout.splitlines()
    for line in blocks[commands + 1][1].splitlines():
        assert line in printed, (page, line, printed)


def expected(x):
    """Over 20 mm of copper and 20 mm of steel, from 20 degrees at the end, with 100 mW/mm^2."""
    return 20 + 100 * max(20 - x, 0) / 400 + 100 * min(40 - x, 20) / 50


if not os.path.lexists("Examples"):
    os.symlink(EXAMPLES, "Examples")
shutil.copy(os.path.join(EXAMPLES, "Data", "heat_sink.msh"), "heat_sink.msh")
check_page("docs/groups.md", "HeatConduction/heat.json")
check_page("Examples/CalculiX/README.md", "CalculiX/heat.json")

bar = read_vtk_xml("bar.vtu")
temperatures = [value for (value,) in bar["Solution"]]
for (x, _, _), value in zip(bar["Points"], temperatures):
    assert math.isclose(value, expected(x), abs_tol=1e-5), (x, value)
assert all(math.isclose(flux, 100, rel_tol=1e-5) for flux, _, _ in bar["Flux"])

if shutil.which("ccx"):
    shutil.copy(os.path.join(EXAMPLES, "CalculiX", "bar.inp"), "deck.inp")
    subprocess.run(["ccx", "deck"], check=True, capture_output=True, timeout=60)
    with open("deck.dat", encoding="ascii") as file:
        nodes = [line.split() for line in file if re.fullmatch(r" +\d+ +\S+\n?", line)]
    assert len(nodes) == len(temperatures), nodes
    for number, value in nodes:
        assert math.isclose(float(value), temperatures[int(number) - 1], abs_tol=1e-5), (number, value)
