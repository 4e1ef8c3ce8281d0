#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many passes smg solve takes on the real meshes of the archive, held at both ends.

smg_passes.py [all]: the smaller meshes, or all."""

import json
import sys

from archive_meshes import CHOSEN, in_archive
from program import load, run

# The maximum of passes to 1e-6 and to 1e-10 on meshes with many slivers; on the others ...
SLIVERS = {"dragon.ply": (15, 26), "bunny_tet.mesh": (34, 56), "head_tet336k.vtk": (13, 22)}
# ... and of all with clamped weights.
MOST, MOST_CLAMPED = (10, 17), (9, 16)

SMALL = ("armadillo43k.obj", "lucy50k.ply", "elephant44k.off", "dragon_res3.ply",
         "rangemap_lato315.ply", "armadillo_tet.msh", "bunny_tet.mesh", "raptor_tet.vtu")
LARGE = ("bunny.ply", "horse_be.ply", "brain168k.vtk", "dragon.ply", "head_mri_1m.ply",
         "head_tet336k.vtk")


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


def check(name):
    run("convert", in_archive(name), "mesh.vsm", "--quiet", *CHOSEN.get(name, ()))
    low, high = bounds("mesh.vsm")
    for weights, most in (("cotangent", SLIVERS.get(name, MOST)), ("clamped", MOST_CLAMPED)):
        write_problem(low, high, 2, weights)
        taken = passes("mesh.vsm", 1e-6), passes("mesh.vsm", 1e-10)
        print(name, weights, *taken, flush=True)
        assert taken[0] <= most[0] and taken[1] <= most[1], (name, weights)


for mesh_name in SMALL + (LARGE if sys.argv[1:] == ["all"] else ()):
    check(mesh_name)
sys.exit(0)
