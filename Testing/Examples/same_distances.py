#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The results of the lessons of the distance are equal to those of the command line, bit for bit.

same_distances.py MESH DISTANCES... : the mesh, and the result of each lesson."""

import sys

from program import read_vtk_xml, run


def arrays(mesh):
    run("convert", mesh, "mesh.vtp", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtp")
    return result["Points"], result["Distance"]


run("distance", sys.argv[1], "smg.vsm", "--from", '{"nearest": [[-0.0175, 0.187, -0.02]]}', "--quiet")
expected = arrays("smg.vsm")
assert min(expected[1]) == (0,) and max(expected[1]) > (0.2,)
for name in sys.argv[2:]:
    assert arrays(name) == expected, name
    print(name, "is that of smg")
