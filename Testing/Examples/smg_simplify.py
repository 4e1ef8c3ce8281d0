#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg simplify as a black box: formats, columns, report, errors."""

import os

from kills import FOLDER, again, kill_after
from mesh_files import read_mesh
from program import load, run, write_torus


def simplify(*arguments, code=0):
    return run("simplify", *arguments, "--report", "report.json", code=code)


def test_every_format_has_the_same_surface():
    write_torus("torus.obj", 240, 120)
    run("convert", "torus.obj", "torus.vsm", "--quiet")
    done = simplify("torus.vsm", "small.ply", "--vertices", 500)
    assert "500 vertices and 1000 triangles of 28800 and 57600" in done.stdout, done.stdout
    report = load("report.json")
    assert (report["vertices"], report["cells"]) == (500, 1000) and report["dropped_bodies"] == 0
    assert 0 < report["error"] < 0.1 and report["notes"] == []
    points, *_ = read_mesh("torus.obj")
    known = set(map(tuple, points))
    small, cells, *_ = read_mesh("small.ply")
    assert len(small) == 500 and len(cells) == 1000
    assert all(point in known for point in map(tuple, small))
    for suffix in (".vsm", ".vtp", ".vtu", ".smb", ".obj", ".off", ".stl", ".vtk", ".mesh"):
        simplify("torus.vsm", "small" + suffix, "--vertices", 500)
        run("info", "small" + suffix, "--report", "info.json")
        info = load("info.json")
        assert (info["vertices"], info["cells"]) == (500, 1000), suffix
    run("info", "small.vsm", "--report", "info.json")
    columns = [column["name"] for column in load("info.json")["columns"]["vertices"]]
    assert columns == ["OriginalId"], columns
    # A mesh file is simplified as its stream.
    simplify("torus.obj", "again.ply", "--vertices", 500)
    assert read_mesh("again.ply")[:2] == (small, cells)


def test_a_simplified_mesh_goes_into_the_next_command():
    """Its numbers are those of the whole mesh, whose order no format can have."""
    simplify("torus.vsm", "small.vsm", "--vertices", 500)
    for suffix in (".ply", ".vtp", ".vtu", ".smb", ".obj", ".off", ".stl", ".vtk", ".mesh", ".msh", ".node"):
        run("smooth", "small.vsm", "smooth" + suffix, "--quiet", "--no-sync")
        run("info", "smooth" + suffix, "--report", "info.json")
        assert load("info.json")["cells"] == 1000, suffix


def test_labels_are_those_of_triangles_that_were_there():
    """In every format that has columns of cells; of others, and of solids, a note names those that are lost."""
    points, cells, *_ = read_mesh("torus.obj")
    with open("labels.vtk", "w") as file:
        file.write(f"# vtk DataFile Version 3.0\nlabels\nASCII\nDATASET POLYDATA\nPOINTS {len(points)} double\n")
        file.writelines("%r %r %r\n" % tuple(point) for point in points)
        file.write(f"POLYGONS {len(cells)} {sum(1 + len(cell) for cell in cells)}\n")
        file.writelines(" ".join(map(str, [len(cell), *cell])) + "\n" for cell in cells)
        file.write(f"CELL_DATA {len(cells)}\nSCALARS Material int 1\nLOOKUP_TABLE default\n")
        file.writelines("%d\n" % (1 if points[cell[0]][0] < 0 else 2) for cell in cells)
    for suffix in (".vsm", ".ply", ".vtp", ".vtu"):
        simplify("labels.vtk", "small" + suffix, "--vertices", 500)
        assert load("report.json")["notes"] == [], suffix
        run("info", "small" + suffix, "--report", "info.json")
        columns = [column["name"] for column in load("info.json")["columns"]["cells"]]
        assert "Material" in columns, (suffix, columns)
    simplify("labels.vtk", "small.stl", "--vertices", 500)
    assert "Material" in " ".join(load("report.json")["notes"])


def test_held_points_stay():
    """WHERE in JSON, several times, and a file; and a simplification that goes on knows what was held."""
    points, *_ = read_mesh("torus.obj")
    with open("low.json", "w") as file:
        file.write('[{"halfspace": [0, 0, -1, 0.9]}]')
    held = {tuple(point) for k, point in enumerate(points) if point[2] <= -0.9 or k in (5, 77)}
    for vertices in (5000, 100):
        done = simplify("torus.vsm", "small.ply", "--vertices", vertices, "--hold", '{"vertices": [5, 77]}',
                        "--hold", "low.json")
        assert held <= set(map(tuple, read_mesh("small.ply")[0]))
        assert (f"more than 100 vertices: {len(held)} are held." in done.stdout) == (vertices == 100), done.stdout
    assert "hold[0]" in simplify("torus.vsm", "x.ply", "--vertices", 99, "--hold", '{"sphere": [9, 9, 9, 1]}', code=1).stderr
    simplify("torus.vsm", "x.ply", "--vertices", 99, "--hold", '{"ball": [9, 9, 9, 1]}', code=2)


def test_an_error_is_kept():
    counts = []
    for error in (1e-3, 1e-2):
        simplify("torus.vsm", "small.vsm", "--error", error)
        report = load("report.json")
        assert report["error"] <= error
        counts.append(report["vertices"])
    assert 28800 > counts[0] > counts[1] > 50, counts
    simplify("torus.vsm", "small.vsm", "--error", 1e3)
    assert "larger than the mesh" in load("report.json")["notes"][0]
    simplify("torus.vsm", "small.vsm", "--error", 1e-3, "--vertices", 500)
    assert load("report.json")["vertices"] == counts[0] and "exceed the error" in load("report.json")["notes"][0]


def test_few_vertices_are_few():
    """A result of so few vertices that vertices are merged, or that nothing would be left, is one."""
    for vertices in (4, 5, 8, 12):
        simplify("torus.vsm", "few.ply", "--vertices", vertices)
        report = load("report.json")
        points, cells, *_ = read_mesh("few.ply")
        assert len(points) == report["vertices"] > 2 and len(cells) == report["cells"] > 0, report
        assert report["vertices"] <= vertices or "more than" in " ".join(report["notes"]), report


def test_dry_run():
    done = run("simplify", "torus.vsm", "none.ply", "--vertices", 500, "--dry-run", "--report", "dry.json")
    assert "28800 vertices" in done.stdout and not os.path.exists("none.ply"), done.stdout
    simplify("torus.vsm", "small.ply", "--vertices", 500)
    estimate, size = load("dry.json"), os.path.getsize("small.ply")
    assert 0.6 * size < estimate["output_bytes"] < 1.7 * size, (estimate, size)


def test_errors():
    def error(*arguments, code=1):
        return simplify(*arguments, code=code).stderr

    assert "--vertices, --error or both is required" in error("torus.vsm", "x.ply", code=2)
    assert "this is not a format of a surface: write it as .vsm" in error("torus.vsm", "x.xyz", "--vertices", 9, "--dry-run")
    assert "holds no triangles" in error("torus.vsm", "x.sva", "--vertices", 9)
    assert "there is no folder nowhere" in error("torus.vsm", "nowhere/x.ply", "--vertices", 9)
    assert "torus.vsm" in error("torus.vsm", "torus.vsm", "--vertices", 9)
    assert not any(name.startswith("x.") for name in os.listdir("."))


def test_a_killed_one_continues():
    """Killed when a window was full and run again: the same bits, whether the result is one window or
    parts that were saved; also with the conversion of the mesh."""
    write_torus("large.obj", 640, 320)
    run("convert", "large.obj", "large.vsm", "--quiet")
    for mesh, goal, kills in (("large.vsm", ("--vertices", 500), (1,)),
                              ("large.vsm", ("--vertices", 60000), (1, 3)),
                              ("large.vsm", ("--error", 1e-5), (1, 3)),
                              ("large.obj", ("--vertices", 60000), (2,))):
        case = ("simplify", mesh, "small.vsm", *goal, "--memory", 16, "--report", "report.json")
        run(*case)
        with open("small.vsm", "rb") as file:
            bits = file.read()
        report = load("report.json")
        for least in kills:
            os.remove("small.vsm")
            kill_after(case, least)
            assert not os.path.exists("small.vsm")
            code, error = again((*case, "--threads", 1))
            assert code == 0 and "found a checkpoint after part" in error, error
            with open("small.vsm", "rb") as file:
                assert file.read() == bits, (case, least)
            resumed = load("report.json")
            assert 0 < resumed["resumed_vertices"] < 204800
            for key in ("vertices", "cells", "error", "dropped_bodies"):
                assert resumed[key] == report[key], key
            assert not os.path.exists(FOLDER)
    case = ("simplify", "large.vsm", "small.vsm", "--vertices", 60000, "--memory", 16)
    kill_after(case, 1)
    for word, other in (("mesh", (case[0], "torus.vsm", *case[2:])),
                        ("vertices", (*case[:4], 59999, *case[5:])), ("memory", (*case[:6], 17)),
                        ("another error", (*case, "--error", 1)),
                        ("kind of computation", ("convert", "large.obj", "small.vsm"))):
        code, error = again((*other, "--quiet"))
        assert code == 1 and word in error and "remove the folder" in error, (word, error)
    code, _ = again(case)
    assert code == 0


test_every_format_has_the_same_surface()
test_labels_are_those_of_triangles_that_were_there()
test_held_points_stay()
test_an_error_is_kept()
test_few_vertices_are_few()
test_dry_run()
test_errors()
test_a_killed_one_continues()
print("passed")
