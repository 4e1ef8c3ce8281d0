#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The results of the lessons of the blend are equal.

same_blending.py BLENDED... : the result of each lesson."""

import sys

from program import read_vtk_xml, run


def arrays(mesh):
    run("convert", mesh, "mesh.vtp", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtp")
    return result["Points"], [light for light, in result["Light"]]


first, *others = map(arrays, sys.argv[1:])
points, lights = first
# The true light, up to its mean, without the steps of 32, 64 and 96 between the scans.
true = [128 + 512 * z for _, _, z in points]
errors = [light - value for light, value in zip(lights, true)]
mean = sum(errors) / len(errors)
assert max(abs(error - mean) for error in errors) < 6, max(abs(error - mean) for error in errors)
for name, (also, found) in zip(sys.argv[2:], others):
    assert also == points, name
    # Calculators may add in another order.
    assert max(abs(a - b) for a, b in zip(found, lights)) < 1e-9, name
    print(name, "is", sys.argv[1])
