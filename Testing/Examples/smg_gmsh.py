#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that Gmsh makes of one geometry, two layers of hexahedra and a surface with curves: whatever the format, the order of
the elements and the partition, groups are those of the geometry, and temperatures and fluxes exact."""

import json
import math
import shutil
import subprocess
import sys

from program import load, read_vtk_xml, run

if not shutil.which("gmsh"):
    print("SKIPPED: Gmsh is not installed")
    sys.exit(77)

LAYERS = """
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.1, 0.1, 0}; Point(4) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Curve{1 : 4} = 6;
Transfinite Surface{1};
Recombine Surface{1};
a() = Extrude {0, 0, 0.02} { Surface{1}; Layers{4}; Recombine; };
b() = Extrude {0, 0, 0.03} { Surface{a(0)}; Layers{3}; Recombine; };
Physical Surface("cold") = {1};
Physical Surface("between layers") = {a(0)};
Physical Surface("heiß oben") = {b(0)};
Physical Volume("lower") = {a(1)};
Physical Volume("upper") = {b(1)};
Physical Point("corner") = {1};
"""
BOXES = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
%s
Physical Volume("bodies") = {1, 2};
eps = 1e-6;
Physical Surface("west") = Surface In BoundingBox {-eps, -eps, -eps, eps, 1 + eps, 1 + eps};
Physical Surface("east") = Surface In BoundingBox {2 - eps, -eps, -eps, 2 + eps, 1 + eps, 1 + eps};
Mesh.MeshSizeMax = 0.2;
"""
FACES = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Physical Surface("all") = {1 : 6};
"""
PLATE = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 1};
Mesh.MeshSizeMax = 0.3;
Physical Curve("right end") = {2};
Physical Curve("left end") = {4};
Physical Surface("plate") = {1};
"""
FORMATS = [], ["-bin"], ["-format", "msh22"], ["-format", "msh40"], ["-order", "2"], ["-part", "4"], ["-part", "3", "-bin"]


def gmsh(text, dimension, arguments):
    with open("body.geo", "w", encoding="utf-8") as file:
        file.write(text)
    subprocess.run(["gmsh", "-" + dimension, "body.geo", "-o", "body.msh", "-v", "1", *arguments], check=True)


def solve(problem):
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump(problem, file)
    run("solve", "body.msh", "body.vtu", "--problem", "problem.json", "--tolerance", "1e-11", "--report", "report.json")
    return load("report.json")["conditions"]


def check(name, found, expected):
    assert math.isclose(found, expected, rel_tol=1e-8, abs_tol=1e-12), (name, found, expected)


for arguments in FORMATS:
    gmsh(LAYERS, "3", arguments)
    run("info", "body.msh", "--report", "info.json", "--full")
    groups = {group["name"]: group for group in load("info.json")["groups"]}
    assert set(groups) == {"cold", "between layers", "heiß oben", "lower", "upper", "corner"}, (arguments, groups)
    for name, measure in {"cold": 0.01, "lower": 2e-4, "upper": 3e-4, "corner": 0}.items():
        check((arguments, name), groups[name]["measure"], measure)
        assert groups[name]["count"] > 0, groups
    cold, hot, film = solve({
        "conductivity": [{"group": "lower", "value": 2}, {"group": "upper", "value": 5}],
        "dirichlet": [{"group": "cold", "value": 10}],
        "flux": [{"group": "heiß oben", "value": 300}, {"group": "between layers", "value": 50}]})
    for condition, flux, mean in (cold, -3.5, 10), (film, 0.5, 13.5), (hot, 3, 15.3):
        check((arguments, condition["name"]), condition["flux"][0], flux)
        check((arguments, condition["name"]), condition["mean"][0], mean)
        check((arguments, condition["name"]), condition["area"], 0.01)
    body = read_vtk_xml("body.vtu")
    for (_, _, z), (value,) in zip(body["Points"], body["Solution"]):
        if not math.isnan(value):  # a vertex of an edge, of elements of the second order
            check((arguments, z), value, 10 + 350 * min(z, 0.02) / 2 + 300 * max(z - 0.02, 0) / 5)

    gmsh(PLATE, "2", arguments)
    left, right = solve({"dirichlet": [{"group": "left end", "value": 8}, {"group": "right end", "value": 0}]})
    check(arguments, left["flux"][0], 2)
    check(arguments, right["flux"][0], -2)
    check(arguments, left["area"], 1)

# Bodies that were not fragmented have different triangles between them, and are not joined by welding their vertices.
for touching, isJoined in ("", False), ("BooleanFragments{ Volume{1, 2}; Delete; }{}", True):
    gmsh(BOXES % touching, "3", [])
    run("convert", "body.msh", "body.vsm", "--weld", "0", "--report", "convert.json")
    notes = [note for note in load("convert.json")["notes"] if "do not match" in note]
    assert len(notes) == (0 if isJoined else 1), notes
    flux = solve({"dirichlet": [{"group": "west", "value": 0}, {"group": "east", "value": 2}]})[1]["flux"][0]
    assert (abs(flux - 1) < 1e-8) == isJoined, flux

# Gmsh leaves out the volumes if only faces have names: version 4 tells that there are some.
for arguments, knows in ([], True), (["-format", "msh22"], False), (["-setnumber", "Mesh.SaveAll", "1"], False):
    gmsh(FACES, "3", arguments)
    run("convert", "body.msh", "body.vsm", "--report", "convert.json")
    assert any("name the volumes" in note for note in load("convert.json")["notes"]) == knows, arguments
