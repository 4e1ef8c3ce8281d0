#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg deform --engine hypre on several processes: points, normals, pieces, reports and errors."""

import json
import os

from program import load, read_vtk_xml, run, write_medit
from smg_hypre import run_on, run_where_possible
from tetrahedra import tetrahedra
from torus import torus

HANDLES = {"handles": [
    {"region": {"box": [-9, -9, -9, 0.2, 9, 9]}, "fixed": True},
    {"region": {"box": [2.5, -9, -9, 9, 9, 9]}, "rotate": {"axis": [1, 1, 0], "degrees": 70},
     "scale": 1.2, "translate": [0.3, 0, 0.5]},
    {"region": {"nearest": [[-1, 0, 0]]}, "fixed": True}], "tolerance": 1e-10}
FREE = 50.0  # x of a component without handle


def write(name, content):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(content, file)


def write_surface(name):
    """Two tori as PLY in single precision, one without handle; all normals are wrong."""
    points, quadrangles = torus(40, 20)
    count = len(points)
    points = points + [(x + FREE, y, z) for x, y, z in points]
    quadrangles = quadrangles + [tuple(c + count for c in q) for q in quadrangles]
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        for axis in ("x", "y", "z", "nx", "ny", "nz"):
            file.write("property float %s\n" % axis)
        file.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                   % len(quadrangles))
        file.writelines("%.9g %.9g %.9g 0 0 -1\n" % point for point in points)
        file.writelines("4 %d %d %d %d\n" % quadrangle for quadrangle in quadrangles)


def meshes():
    write_surface("surface.ply")
    points, cells = tetrahedra(6)
    count = len(points)
    points = points + [(x + FREE, y, z) for x, y, z in points]
    write_medit("solid.mesh", points, cells + [tuple(c + count for c in cell) for cell in cells])
    run("convert", "surface.ply", "surface.vsm", "--quiet")
    run("convert", "solid.mesh", "solid.vsm", "--quiet")
    write("handles.json", HANDLES)
    return ("surface", ".vtp", ".pvtp"), ("solid", ".vtu", ".pvtu")


def by_number(array, pieces):
    """The tuples of an array of the pieces by original number, each vertex once."""
    return {number: value for piece in pieces for (number,), (ghost,), value in zip(
        piece["OriginalId"], piece.get("vtkGhostType", [(0,)] * len(piece[array])), piece[array])
        if ghost == 0}


def assert_equal(values, expected, name, tolerance=1e-6):
    size = max(v for row in expected.values() for v in row) - min(
        v for row in expected.values() for v in row)
    assert values.keys() == expected.keys(), name
    error = max(abs(a - b) for k in values for a, b in zip(values[k], expected[k]))
    assert error < tolerance * size, (name, error, size)


def check(name, suffix, index, processes, expected, figures):
    options = ("--handles", "handles.json", "--engine", "hypre", "--report", "report.json")
    run_on(processes, "deform", name + ".vsm", "out" + suffix, *options)
    run_on(processes, "deform", name + ".vsm", "pieces" + index, *options)
    report = load("report.json")
    assert report["converged"] and report["distributed"]["setups"] == 1
    assert len(report["distributed"]["iterations"]) == 7
    assert [step["name"] for step in report["steps"]] == ["rotation", "position"]
    for key in ("vertices", "cells", "prescribed", "shared", "components", "free_components"):
        assert report[key] == figures[key], key
    assert report["notes"] == figures["notes"], (report["notes"], figures["notes"])
    inverted, same = report["inverted"], figures["inverted"]
    assert (inverted["cells"] > 0) == (name == "solid")
    assert inverted.get("worst", {}).get("cell") == same.get("worst", {}).get("cell"), name
    parts = [read_vtk_xml(f"pieces/pieces_{p}{suffix}") for p in range(processes)]
    for arrays in ([read_vtk_xml("out" + suffix)], parts):
        assert_equal(by_number("Points", arrays), by_number("Points", [expected]), name)
        assert ("Normals" in arrays[0]) == ("Normals" in expected)
        if "Normals" in expected:
            assert_equal(by_number("Normals", arrays), by_number("Normals", [expected]), name, 1e-5)


def test_any_number_of_processes_gives_the_same():
    for name, suffix, index in meshes():
        run("deform", name + ".vsm", "expected" + suffix, "--handles", "handles.json",
            "--report", "expected.json")
        expected, figures = read_vtk_xml("expected" + suffix), load("expected.json")
        assert figures["shared"] > 0 and figures["free_components"] == 1
        assert ("Normals" in expected) == (name == "surface")
        for processes in (1, 2, 3):
            check(name, suffix, index, processes, expected, figures)
    run_on(2, "deform", "surface.vsm", "pieces.pvtp", "--handles", "handles.json",
           "--engine", "hypre", "--normals", "drop")
    assert "Normals" not in read_vtk_xml("pieces/pieces_1.vtp")


def test_failures_are_one_line():
    def message(handles, *options, out="x.pvtu"):
        write("bad.json", handles)
        return run_on(2, "deform", "solid.vsm", out, "--handles", "bad.json", "--engine", "hypre",
                      *options, code=1)
    for out in ("x.pvtu", "x.vtu"):
        assert "no V-cycles to count" in message(HANDLES, "--cycles", 3, out=out)
    assert "no V-cycles to count" in message({"handles": HANDLES["handles"], "cycles": 2})
    assert "leave them out" in message(HANDLES, "--in-core")
    nothing = {"region": {"sphere": [9, 9, 9, 0.1]}, "fixed": True}
    assert "no vertex" in message({"handles": [nothing]})
    assert not os.path.exists("x.vtu") and not os.path.exists("x.pvtu")


def refused():
    meshes()
    return "deform", "solid.vsm", "x.vtu", "--handles", "handles.json"


if __name__ == "__main__":
    run_where_possible(
        refused, [test_any_number_of_processes_gives_the_same, test_failures_are_one_line])
