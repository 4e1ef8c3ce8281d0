#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lessons of an example have equal results, bit for bit, and correct ones.

same_results.py EXAMPLE MESH RESULT... : the mesh of the lessons, and the result of each."""

import math
import os
import shutil
import subprocess
import sys

from program import load, read_vtk_xml, run


def arrays(mesh, names):
    run("convert", mesh, "mesh.vtu", "--order", "keep", "--quiet")
    result = read_vtk_xml("mesh.vtu")
    return {name: result[name] for name in names}


def deformation(mesh, result):
    """Fixed points stay, and the head moves by some centimetres."""
    rest = arrays(mesh, result)
    for before, after in zip(rest["Points"], result["Points"]):
        assert before[1] > 0.05 or math.dist(before, after) < 1e-9
    assert max(map(math.dist, rest["Points"], result["Points"])) > 0.03
    assert result["connectivity"] == rest["connectivity"]


def smoothing(mesh, result):
    """The head stays, and the rest moves by up to millimetres."""
    rest = arrays(mesh, result)
    for before, after in zip(rest["Points"], result["Points"]):
        assert before == after or math.dist(before, (-0.07, 0.14, 0.01)) > 0.04 - 1e-6
    assert 5e-4 < max(map(math.dist, rest["Points"], result["Points"])) < 1e-2
    assert result["connectivity"] == rest["connectivity"]


def distance(mesh, result):
    """They are those of the command line."""
    run("distance", mesh, "smg.vsm", "--from", '{"nearest": [[-0.0175, 0.187, -0.02]]}', "--quiet")
    assert result == arrays("smg.vsm", result)
    assert min(result["Distance"]) == (0,) and max(result["Distance"]) > (0.2,)


def blending(_mesh, result):
    """The true light, up to its mean, without the steps of 32, 64 and 96 between the scans."""
    errors = [light - 128 - 512 * z for (light,), (_, _, z) in zip(result["Light"], result["Points"])]
    mean = sum(errors) / len(errors)
    assert max(abs(error - mean) for error in errors) < 6, max(abs(error - mean) for error in errors)


def heat(mesh, result):
    """It is hottest in the chip, coldest at the fins; where Gmsh is installed, the mesh that it makes of the
    lesson's file has the same groups, and nearly the same temperatures."""
    lesson = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "HeatConduction")
    if shutil.which("gmsh"):
        geometry = os.path.join(lesson, "heat_sink.geo")
        subprocess.run(["gmsh", "-3", geometry, "-o", "made.msh", "-v", "1"], check=True)
        reports = []
        for name in (mesh, "made.msh"):
            run("solve", name, "heat.vsm", "--problem", os.path.join(lesson, "heat.json"), "--report", "heat.json")
            reports.append(load("heat.json"))
        for kept, made in zip(*(report["conditions"] + report["parts"] for report in reports)):
            assert kept["name"] == made["name"], (kept, made)
            for key in "area", "measure":
                assert math.isclose(kept.get(key, 1), made.get(key, 1), rel_tol=1e-9), (kept, made)
        peaks = [report["maximum"][0]["value"] for report in reports]
        assert abs(peaks[0] - peaks[1]) < 0.5, peaks
    conductivity = {1: 25.0, 2: 200.0}
    for (material,), gradient, flux in zip(result["PhysicalTag"], result["Gradient"], result["Flux"]):
        assert all(abs(f + conductivity[material] * g) <= 1e-12 * abs(f) for g, f in zip(gradient, flux))
    temperatures = [t for (t,) in result["Solution"]]
    assert 20 < min(temperatures) and max(temperatures) < 80
    assert result["Points"][temperatures.index(max(temperatures))][2] < 0.001
    assert result["Points"][temperatures.index(min(temperatures))][2] > 0.006


# The arrays that are equal, and what the first result must be.
EXAMPLES = {
    "Deformation": (("Points", "connectivity"), deformation),
    "Smoothing": (("Points", "connectivity"), smoothing),
    "Distance": (("Points", "Distance"), distance),
    "Blending": (("Points", "Light"), blending),
    "HeatConduction": (("Points", "connectivity", "OriginalId", "OriginalCellId", "PhysicalTag", "Solution",
                        "Gradient", "Flux"), heat),
}

example, mesh_of_lessons, *results = sys.argv[1:]
equal, check = EXAMPLES[example]
first, *others = (arrays(result, equal) for result in results)
check(mesh_of_lessons, first)
for name, other in zip(results[1:], others):
    for array in equal:
        # Calculators that make the light may add in another order.
        same = other[array] == first[array] if array != "Light" else len(other[array]) == len(
            first[array]) and all(abs(a - b) < 1e-9 for (a,), (b,) in zip(other[array], first[array]))
        assert same, (name, array)
    print(name, "is", results[0])
