#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The results of the lessons of the smoothing are equal bit for bit.

same_smoothing.py REST SMOOTH... : the mesh at rest, and the result of each lesson."""

import math
import sys

from program import read_vtk_xml, run


def arrays(mesh):
    run("convert", mesh, "mesh.vtp", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtp")
    return {name: result[name] for name in ("Points", "connectivity")}


rest, *results = map(arrays, sys.argv[1:])
# The head stays, and the rest moves by up to millimetres.
for before, after in zip(rest["Points"], results[0]["Points"]):
    assert before == after or math.dist(before, (-0.07, 0.14, 0.01)) > 0.04 - 1e-6
assert 5e-4 < max(map(math.dist, rest["Points"], results[0]["Points"])) < 1e-2
assert results[0]["connectivity"] == rest["connectivity"]
for name, result in zip(sys.argv[3:], results[1:]):
    assert result == results[0], name
    print(name, "is", sys.argv[2])
