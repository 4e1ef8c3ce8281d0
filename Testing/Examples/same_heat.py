#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lessons of the heat conduction compute equal solutions, bit for bit, and correct ones.

same_heat.py MESH SOLVED... : the mesh of the lesson, and the result of each lesson."""

import os
import subprocess
import sys

from program import read_vtk_xml, run

SCRIPT = os.path.join(
    os.environ["SMG_SOURCE_DIR"], "Examples", "HeatConduction", "make_mesh.py")


def arrays(mesh):
    run("convert", mesh, "mesh.vtu", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtu")
    names = ("Points", "connectivity", "OriginalId", "OriginalCellId", "Material", "Solution",
             "Gradient", "Flux")
    return {name: result[name] for name in names}


# The mesh in the tree is the output of its script.
subprocess.run([sys.executable, SCRIPT, "made.vtk"], check=True)
with open(sys.argv[1], "rb") as mesh, open("made.vtk", "rb") as made:
    assert mesh.read() == made.read()

first, *others = map(arrays, sys.argv[2:])
conductivity = {1: 25.0, 2: 200.0}
for (material,), gradient, flux in zip(first["Material"], first["Gradient"], first["Flux"]):
    assert all(abs(f + conductivity[material] * g) <= 1e-12 * abs(f) for g, f in zip(gradient, flux))
temperatures = [t for (t,) in first["Solution"]]
assert 20 < min(temperatures) and max(temperatures) < 70
# It is hottest at the bottom of the chip, coldest at the fins.
assert first["Points"][temperatures.index(max(temperatures))][2] == 0
assert first["Points"][temperatures.index(min(temperatures))][2] > 0.006
for name, result in zip(sys.argv[3:], others):
    for array in first:
        assert result[array] == first[array], (name, array)
    print(name, "is", sys.argv[2])
