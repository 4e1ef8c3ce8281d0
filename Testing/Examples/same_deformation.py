#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The results of the lessons of the deformation are equal bit for bit.

same_deformation.py REST DEFORMED... : the mesh at rest, and the result of each lesson."""

import math
import sys

from program import read_vtk_xml, run


def arrays(mesh):
    run("convert", mesh, "mesh.vtp", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtp")
    return {name: result[name] for name in ("Points", "connectivity")}


rest, *results = map(arrays, sys.argv[1:])
# Fixed points stay, and the head moves by some centimetres.
for before, after in zip(rest["Points"], results[0]["Points"]):
    assert before[1] > 0.05 or math.dist(before, after) < 1e-9
assert max(map(math.dist, rest["Points"], results[0]["Points"])) > 0.03
assert results[0]["connectivity"] == rest["connectivity"]
for name, result in zip(sys.argv[3:], results[1:]):
    assert result == results[0], name
    print(name, "is", sys.argv[2])
