#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg info as a black box: from the header, and with a description of the mesh."""

import json

from program import load, run, write_torus


def info(*arguments, code=0):
    done = run("info", *arguments, "--report", "info.json", code=code)
    return done, load("info.json")


def test_the_header_tells_the_cost_of_a_solve():
    write_torus("torus.obj", 240, 120)
    run("convert", "torus.obj", "torus.vsm", "--quiet")
    done, report = info("torus.vsm")
    assert "description" not in report and "bodies" not in done.stdout
    expected = report["expected_solve"]
    assert f"{expected['passes']} passes" in done.stdout, done.stdout
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"vertices": [0], "value": 0}]}, file)
    run("solve", "torus.vsm", "out.vsm", "--problem", "problem.json", "--dry-run",
        "--report", "estimate.json")
    estimate = load("estimate.json")
    for key in ("memory_bytes", "passes"):
        assert expected[key] == estimate[key], key
    # The order of the file is not that in which it is solved.
    assert info("torus.obj")[1]["expected_solve"]["memory_bytes"] < 2 * expected["memory_bytes"]


def test_bounds_have_all_digits():
    for x in 448000.12, 448000.13:
        with open("far.obj", "w", encoding="ascii") as file:
            file.write(f"v {x} 5412345.678 101.5\nv 448001 5412346 101.5\nv 448002 5412345.9 0.1\nf 1 2 3\n")
        done, report = info("far.obj")
        assert report["bounds"][0] == x, report["bounds"]
        assert f"bounds      [{x}, 448002] x [5412345.678, 5412346] x [0.1, 101.5]" in done.stdout, done.stdout
        assert "cells       1 triangle\n" in done.stdout, done.stdout


def test_a_mesh_is_described():
    for name in ("torus.vsm", "torus.obj"):
        done, report = info(name, "--full")
        mesh = report["description"]
        assert (mesh["vertices"], mesh["cells"], mesh["bodies"]) == (28800, 57600, 1), mesh
        assert mesh["closed"] and mesh["consistently_wound"] and mesh["boundary_edges"] == 0
        assert mesh["nonmanifold_edges"] == mesh["nonmanifold_vertices"] == 0
        length = mesh["edge_length"]
        assert 0 < length["minimum"] < length["mean"] < length["maximum"]
        assert mesh["columns"]["vertices"][0] == {
            "name": "OriginalId", "type": "int64", "components": 1, "minimum": [0],
            "maximum": [28799], "not_finite": 0}
        assert "boundary    none: closed" in done.stdout, done.stdout
        assert "OriginalId (int64 x 1): [0, 28799]" in done.stdout, done.stdout


def test_flaws_are_printed():
    # Two triangles with a vertex in common, one of them twice, and a vertex of no cell.
    with open("flawed.off", "w", encoding="utf-8") as file:
        file.write("OFF\n6 3 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n5 5 5\n"
                   "3 0 1 2\n3 0 3 4\n3 2 1 0\n")
    done, report = info("flawed.off", "--full")
    mesh = report["description"]
    assert (mesh["bodies"], mesh["duplicate_cells"], mesh["isolated_vertices"]) == (1, 1, 1), mesh
    assert (mesh["boundary_edges"], mesh["nonmanifold_vertices"]) == (3, 1), mesh
    assert mesh["columns"]["cells"][-1]["tags"] == {"0": 2, "2": 1}, mesh["columns"]
    assert "1 duplicate\n" in done.stdout and "no: 1 non-manifold vertex\n" in done.stdout
    assert "CellFlags (uint8 x 1): 0 (2), 2 (1)\n" in done.stdout, done.stdout


def test_a_page_has_the_description():
    run("info", "flawed.off", "--full", "--quiet", "--report", "info.html")
    with open("info.html", encoding="utf-8") as file:
        page = file.read()
    assert "description bodies" in page and "nonmanifold vertices" in page
    assert "{&quot;0&quot;:2,&quot;2&quot;:1}" in page


def test_too_little_memory_is_an_error():
    write_torus("wide.obj", 1200, 600)
    error = run("info", "wide.obj", "--full", "--memory", 16, code=1).stderr
    assert "the description of the mesh needs at least" in error, error


test_the_header_tells_the_cost_of_a_solve()
test_bounds_have_all_digits()
test_a_mesh_is_described()
test_flaws_are_printed()
test_a_page_has_the_description()
test_too_little_memory_is_an_error()
print("passed")
