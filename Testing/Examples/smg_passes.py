#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many passes smg solve takes on the real meshes of the archive, held at both ends.

smg_passes.py [all]: the smaller ones, or all."""

import json
import sys

from archive_meshes import CHOSEN, in_archive
from program import load, run

SURFACES = ("armadillo43k.obj", "lucy50k.ply", "elephant44k.off", "dragon_res3.ply")
LARGE_SURFACES = ("bunny.ply", "horse_be.ply", "rangemap_lato315.ply", "brain168k.vtk",
                  "dragon.ply", "head_mri_1m.ply")
SOLIDS = ("armadillo_tet.msh", "bunny_tet.mesh", "raptor_tet.vtu")
LARGE_SOLIDS = ("head_tet336k.vtk",)


def bounds(mesh):
    """Its lowest and highest coordinates."""
    run("info", mesh, "--quiet", "--report", "info.json")
    ends = load("info.json")["bounds"]
    return ends[0::2], ends[1::2]


def write_problem(low, high, axis, weights):
    """Three columns, the positions, prescribed on 2 % at either end of an axis."""
    margin = 0.02 * (high[axis] - low[axis])
    normal = [float(d == axis) for d in range(3)]
    ends = (normal + [high[axis] - margin], [-n for n in normal] + [-low[axis] - margin])
    problem = {"columns": 3, "weights": weights,
               "dirichlet": [{"halfspace": end, "value": "position"} for end in ends]}
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump(problem, file)


def passes(mesh, tolerance):
    run("solve", mesh, "out.vsm", "--problem", "problem.json", "--tolerance", tolerance,
        "--max-cycles", 60, "--quiet", "--report", "report.json")
    report = load("report.json")
    assert report["converged"], (mesh, report["notes"])
    return report["passes"]


def check(name, most, most_accurate):
    run("convert", in_archive(name), "mesh.vsm", "--quiet", *CHOSEN.get(name, ()))
    low, high = bounds("mesh.vsm")
    longest = max(range(3), key=lambda d: high[d] - low[d])
    write_problem(low, high, longest, "cotangent")
    usual, accurate = passes("mesh.vsm", 1e-6), passes("mesh.vsm", 1e-10)
    print(name, usual, accurate)
    assert usual <= most and accurate <= most_accurate, name


def test_cotangent_weights(large):
    for name in SURFACES + (LARGE_SURFACES if large else ()):
        check(name, 9, 17)
    for name in SOLIDS + (LARGE_SOLIDS if large else ()):
        check(name, 11, 17)


def test_raw_cotangent_weights_of_slivers():
    run("convert", in_archive("dragon.ply"), "mesh.vsm", "--quiet")
    low, high = bounds("mesh.vsm")
    for axis in range(3):
        write_problem(low, high, axis, "raw-cotangent")
        taken = passes("mesh.vsm", 1e-6)
        print("dragon.ply, raw, axis", axis, taken)
        assert taken <= 30, axis


test_cotangent_weights(sys.argv[1:] == ["all"])
test_raw_cotangent_weights_of_slivers()
sys.exit(0)
