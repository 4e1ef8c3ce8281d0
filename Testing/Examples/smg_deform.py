#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg deform and smg preview as black boxes: results, formats, reports, errors and exit codes."""

import json
import math
import os
import re
import sys

from mesh_files import SOLIDS, SURFACES, read_mesh
from odd_mesh import odd_solid, odd_surface
from program import load, read_vtk_xml, run, write_medit, write_torus
from tetrahedra import tetrahedra
from torus import torus

DIAGONAL = math.sqrt(6 * 6 + 6 * 6 + 2 * 2)
RIGHT = {"halfspace": [1, 0, 0, 2.8]}
LEFT = {"halfspace": [-1, 0, 0, 2.8]}


def handles(*each, **members):
    """The name of a handle file."""
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": each, **members}, file)
    return "handles.json"


def deform(mesh, out, *arguments, **options):
    return run("deform", mesh, out, "--handles", "handles.json", *arguments, **options)


def arrays(name):
    """The arrays of a mesh file of any format except those of VTK."""
    run("convert", name, "arrays.vtu", "--order", "keep", "--quiet")
    return read_vtk_xml("arrays.vtu")


def columns(name):
    run("info", name, "--quiet", "--report", "columns.json")
    return {column["name"]: column for column in load("columns.json")["columns"]["vertices"]}


def distance(points, expected):
    assert len(points) == len(expected)
    return max(math.dist(a, b) for a, b in zip(points, expected)) / DIAGONAL


def surface_file(name, normal=False):
    """A torus as PLY in single precision; its normals, if it has them, are wrong."""
    points, quadrangles = torus(60, 30)
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        for axis in ("x", "y", "z") + (("nx", "ny", "nz") if normal else ()):
            file.write("property float %s\n" % axis)
        file.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                   % len(quadrangles))
        for point in points:
            file.write("%.9g %.9g %.9g" % point + (" 0 0 -1\n" if normal else "\n"))
        for quadrangle in quadrangles:
            file.write("4 %d %d %d %d\n" % quadrangle)


def solid_file(name, n=6):
    write_medit(name, *tetrahedra(n))


def test_rigid_motions():
    """If all handles have the same motion, so has the mesh."""
    write_torus("torus.obj", 120, 60)
    run("convert", "torus.obj", "torus.vsm", "--quiet")
    rest = arrays("torus.vsm")
    turned = {"rotate": {"axis": [0, 0, -2], "degrees": 200, "center": [1, 0, 0]}, "scale": 2,
              "translate": [0, 0, 3]}
    cos, sin = math.cos(math.radians(-200)), math.sin(math.radians(-200))
    handles({"region": RIGHT, **turned}, {"region": LEFT, **turned}, weights="uniform", tolerance=1e-9)
    done = deform("torus.vsm", "out.vsm", "--report", "report.json")
    assert load("report.json")["converged"] and done.stderr == "", done.stderr
    result = arrays("out.vsm")
    error = distance(result.pop("Points"), [(1 + 2 * (cos * (x - 1) - sin * y),
                                             2 * (sin * (x - 1) + cos * y), 2 * z + 3)
                                            for x, y, z in rest["Points"]])
    assert error < 1e-7, error
    assert result == {name: rest[name] for name in rest if name != "Points"}


def test_report_and_options():
    """The command line overrides the file; k cycles per step take 2 k + 1 passes."""
    handles({"region": RIGHT, "translate": [0, 0, 1]},
            {"region": LEFT, "rotate": {"axis": [1, 0, 0], "degrees": 60, "center": [-3, 0, 0]}},
            {"region": {"sphere": [3, 0, 0, 0.5]}, "fixed": True}, cycles=3, weights="uniform")
    done = deform("torus.vsm", "three.vsm", "--report", "report.json")
    report = load("report.json")
    assert report["passes"] == 7 and [step["cycles"] for step in report["steps"]] == [3, 3]
    assert [step["name"] for step in report["steps"]] == ["rotation", "position"]
    assert report["shared"] > 0 and report["seconds"]["convert"] == 0 and done.stderr == ""
    assert "rotation: 3 V-cycles" in done.stdout and "position: 3 V-cycles" in done.stdout
    assert "held by more than one handle" in done.stdout
    deform("torus.vsm", "five.vsm", "--cycles", 5, "--quiet", "--report", "report.json")
    assert load("report.json")["passes"] == 11
    deform("torus.vsm", "tight.vsm", "--tolerance", 1e-8, "--quiet", "--report", "report.json")
    report = load("report.json")
    assert report["converged"] and all(step["residual"] <= 1e-8 for step in report["steps"])
    done = deform("torus.vsm", "one.vsm", "--tolerance", 1e-8, "--max-cycles", 1, "--quiet",
                  "--report", "report.json", code=3)
    assert "not converged" in done.stderr and not load("report.json")["converged"]
    assert done.stderr.count("--max-cycles") == 1, done.stderr
    deform("torus.vsm", "cotangent.vsm", "--tolerance", 1e-8, "--weights", "cotangent", "--quiet")
    tight = arrays("tight.vsm")["Points"]
    assert distance(arrays("cotangent.vsm")["Points"], tight) > 1e-4
    assert distance(arrays("five.vsm")["Points"], tight) < distance(
        arrays("three.vsm")["Points"], tight) < 1e-2
    deform("torus.vsm", "core.vsm", "--in-core", "--threads", 1, "--block-nodes", 333,
           "--core-nodes", 100, "--sweeps", 2, "--quiet")
    deform("torus.vsm", "streamed.vsm", "--memory", 64, "--core-nodes", 0, "--quiet",
           "--report", "report.json")
    assert load("report.json")["pool_bytes_peak"] <= 64 << 20
    with open("core.vsm", "rb") as core, open("streamed.vsm", "rb") as streamed:
        assert core.read() == streamed.read(), "streaming and in-core results differ"
    deform("torus.obj", "converted.vsm", "--quiet", "--report", "report.json")
    assert load("report.json")["seconds"]["convert"] > 0
    assert arrays("converted.vsm")["Points"] == arrays("three.vsm")["Points"]


def test_formats():
    """Every format gets the same points, in the order and the precision of the input."""
    surface_file("surface.ply")
    run("convert", "surface.ply", "surface.vsm", "--quiet")
    handles({"region": RIGHT, "translate": [0, 0.25, 1]}, {"region": LEFT, "fixed": True})
    deform("surface.vsm", "out.vsm", "--quiet")
    expected = arrays("out.vsm")
    assert max(z for _, _, z in expected["Points"]) > 1.5
    for name in ("out.vtp", "out.vtu"):
        deform("surface.vsm", name, "--quiet")
        result = read_vtk_xml(name)
        result["types"] = expected["types"]
        assert result == expected, name
    run("convert", "out.vsm", "plain.smb", "--order", "keep", "--quiet")
    for name in ("out.ply", "out.sma", "out.smb"):
        deform("surface.vsm", name, "--quiet")
        result = arrays(name)
        assert result["Points"] == expected["Points"], name
        assert result["connectivity"] == expected["connectivity"], name
    with open("out.smb", "rb") as out, open("plain.smb", "rb") as plain:
        assert out.read() == plain.read()
    run("info", "out.ply", "--quiet", "--report", "info.json")
    assert load("info.json")["positions"] == "float32"


def test_order_of_files():
    """A stream or a PLY file is written again in its order."""
    handles({"region": RIGHT, "translate": [0, 0, 1]}, {"region": LEFT, "fixed": True},
            tolerance=1e-9)
    run("convert", "surface.ply", "in.smb", "--order", "axis", "--quiet")
    for source, name in (("in.smb", "moved.sma"), ("surface.ply", "moved.ply")):
        deform(source, name, "--quiet")
        rest, result = arrays(source), arrays(name)
        assert result["connectivity"] == rest["connectivity"], name
        assert result["OriginalId"] == rest["OriginalId"], name
        held = [(a, b) for a, b in zip(rest["Points"], result["Points"]) if abs(a[0]) > 2.801]
        assert len(held) > 20
        assert all(math.dist((a[0], a[1], a[2] + (a[0] > 0)), b) < 1e-6 for a, b in held), name


def same_file(name, other):
    with open(name, "rb") as one, open(other, "rb") as two:
        return one.read() == two.read()


def check_orders(rest, suffixes):
    """Every format in and out has the bits of the way through .vsm and --restore-order."""
    for k, source in enumerate(suffixes):
        run("convert", rest, "in" + source, "--restore-order", "--quiet")
        run("convert", "in" + source, "in.vsm", "--quiet")
        deform("in.vsm", "moved.vsm", "--quiet")
        for out in (source, suffixes[k - 1]):
            done = deform("in" + source, "direct" + out)
            assert "stream order" not in done.stdout, done.stdout
            run("convert", "moved.vsm", "restored" + out, "--restore-order", "--quiet")
            if source == out == ".ply":
                direct, restored = read_mesh("direct.ply"), read_mesh("restored.ply")
                assert direct.points == restored.points and direct.cells == restored.cells
            else:
                assert same_file("direct" + out, "restored" + out), (source, out)
            if out == ".node":
                assert same_file("direct.ele", "restored.ele"), source


def test_every_format_keeps_its_order():
    points, cells = odd_surface(36, 18, largest=4)
    with open("odd.off", "w", encoding="utf-8") as file:
        file.write("OFF\n%d %d 0\n" % (len(points), len(cells)))
        file.writelines("%r %r %r\n" % point for point in points)
        file.writelines(" ".join(map(str, (len(cell), *cell))) + "\n" for cell in cells)
    run("convert", "odd.off", "odd.vsm", "--quiet")
    handles({"region": RIGHT, "translate": [0, 0, 1]}, {"region": LEFT, "fixed": True}, cycles=2)
    check_orders("odd.vsm", SURFACES)
    done = deform("odd.off", "moved.obj")
    assert "9 vertices belong to no cell: they stay where they are." in done.stdout, done.stdout
    moved, used = read_mesh("moved.obj"), {corner for cell in cells for corner in cell}
    assert moved.cells == cells and len(moved.points) == len(points)
    assert all(moved.points[i] == points[i] for i in range(len(points)) if i not in used)
    assert sum(a != b for a, b in zip(moved.points, points)) > len(points) / 2
    write_medit("odd.mesh", *odd_solid())
    run("convert", "odd.mesh", "odd.vsm", "--quiet")
    handles({"region": {"halfspace": [0, 0, -1, -1]}, "fixed": True},
            {"region": {"halfspace": [0, 0, 1, 4]}, "translate": [0, 0, 1]}, cycles=2)
    check_orders("odd.vsm", SOLIDS + (".node",))
    assert "tetrahedra" in deform("odd.mesh", "bad.obj", code=1).stderr


def test_orders_that_are_not_known():
    """Without the numbers of IN the result is in stream order, which is said, whatever its format."""
    handles({"region": RIGHT, "translate": [0, 0, 1]}, {"region": LEFT, "fixed": True})
    run("convert", "surface.vsm", "numbered.vtu", "--order", "keep", "--quiet")
    for command in (("numbered.vtu", "moved.obj"), ("numbered.vtu", "moved.vtu"),
                    ("surface.ply", "moved.off", "--weld", 0)):
        done = deform(*command)
        assert "The vertices are in stream order" in done.stdout, done.stdout
        assert "OriginalId names" not in done.stdout, done.stdout


def test_notes_on_the_order():
    """An output without the order of its input says so, and what happens to isolated vertices."""
    with open("surface.ply", encoding="utf-8") as file:
        lines = file.read().split("end_header\n")
    count = len(torus(60, 30)[0])
    with open("loose.ply", "w", encoding="utf-8") as file:
        file.write(lines[0].replace("vertex %d" % count, "vertex %d" % (count + 2)))
        file.write("end_header\n9 9 9\n8 8 8\n")
        points, quadrangles = torus(60, 30)
        file.writelines("%.9g %.9g %.9g\n" % point for point in points)
        file.writelines("4 %d %d %d %d\n" % tuple(i + 2 for i in face) for face in quadrangles)
    handles({"region": RIGHT, "translate": [0, 0, 1]}, {"region": LEFT, "fixed": True})
    loose = "2 vertices belong to no cell: they "
    done = deform("loose.ply", "moved.ply")
    assert loose + "stay where they are." in done.stdout, done.stdout
    assert "stream order" not in done.stdout
    done = deform("loose.ply", "moved.vtp")
    assert loose + "stay where they are." in done.stdout, done.stdout
    assert "stream order" not in done.stdout
    done = deform("loose.ply", "moved.vtkhdf")
    assert loose + "are left out, since" in done.stdout, done.stdout
    assert "stream order; OriginalId names their places in loose.ply." in done.stdout
    done = deform("loose.ply", "moved.smb", "--report", "report.json")
    assert "The vertices are in stream order." in load("report.json")["notes"]
    done = deform("surface.vsm", "moved.vtp")
    assert "stream order" not in done.stdout and "no cell" not in done.stdout
    assert ".msh" in run("deform", "--help").stdout


def test_solids():
    solid_file("solid.mesh")
    handles({"region": {"halfspace": [0, 0, -1, 0]}, "fixed": True},
            {"region": {"halfspace": [0, 0, 1, 5]}, "scale": 2, "center": [2.5, 2.5, 0],
             "rotate": {"axis": [0, 0, 1], "degrees": 90}})
    deform("solid.mesh", "solid.svb", "--quiet")
    deform("solid.mesh", "solid.vtu", "--quiet", "--report", "report.json")
    assert load("report.json")["converged"]
    result = read_vtk_xml("solid.vtu")
    for (x, y, z), place in zip(tetrahedra(6)[0], result["Points"]):
        if z in (0, 5):
            expected = (x, y, z) if z == 0 else (2.5 - 2 * (y - 2.5), 2.5 + 2 * (x - 2.5), 10)
            assert math.dist(place, expected) < 1e-12
    for name in ("solid.smb", "solid.ply", "solid.vtp"):
        deform("solid.mesh", "new-" + name, "--quiet", code=1)
        assert not os.path.exists("new-" + name)


def inverted(points, moved, cells):
    """Of the cells whose volume changes its sign or vanishes, the volumes over those at rest."""
    def volume(places, cell):
        a, b, c = ([x - y for x, y in zip(places[k], places[cell[0]])] for k in cell[1:])
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
    ratios = {i: volume(moved, cell) / volume(points, cell) for i, cell in enumerate(cells)}
    return {i: ratio for i, ratio in ratios.items() if ratio <= 0}


def test_inverted_cells():
    """The report counts them in the precision of OUT, and names the worst by its number in IN."""
    solid_file("solid.mesh")
    points, cells = tetrahedra(6)
    bottom = {"region": {"halfspace": [0, 0, -1, 0]}, "fixed": True}
    top = {"halfspace": [0, 0, 1, 5]}
    handles(bottom, {"region": top, "translate": [0, 0, 1]})
    done = deform("solid.mesh", "moved.mesh", "--report", "report.json")
    assert load("report.json")["inverted"] == {"cells": 0, "share": 0}
    assert "inverts" not in done.stdout and done.stderr == ""
    handles(bottom, {"region": top, "translate": [0, 0, -5.5]})
    done = deform("solid.mesh", "moved.mesh", "--report", "report.json")
    moved = read_mesh("moved.mesh")
    expected = inverted(points, moved.points, cells)
    worst = min(expected, key=expected.get)
    report = load("report.json")
    found = report["inverted"]
    assert found["cells"] == len(expected) > 5
    assert math.isclose(found["share"], len(expected) / len(cells))
    assert math.isclose(found["worst"]["ratio"], expected[worst], rel_tol=1e-5)
    assert math.isclose(expected[found["worst"]["cell"]], expected[worst], rel_tol=1e-5)
    corners = [moved.points[k] for k in cells[found["worst"]["cell"]]]
    assert math.dist(found["worst"]["place"], [sum(x) / 4 for x in zip(*corners)]) < 1e-5
    note = [note for note in report["notes"] if "inverts" in note]
    assert len(note) == 1 and note[0] in done.stdout
    assert "%d of %d tetrahedra" % (len(expected), len(cells)) in note[0], note
    assert "cell %d of the original mesh" % found["worst"]["cell"] in note[0], note
    assert "smg: warning: %d of %d cells" % (len(expected), len(cells)) in done.stderr, done.stderr
    # The report does not depend on threads, the format of OUT or memory.
    for out in ("moved.vsm", "moved.vtu"):
        deform("solid.mesh", out, "--report", "again.json", "--threads", 1, "--quiet")
        again = load("again.json")["inverted"]
        assert again == found, again


def test_normals():
    """No normals are stale: they are those of the deformed mesh, or removed."""
    surface_file("normals.ply", normal=True)
    run("convert", "normals.ply", "normals.vsm", "--quiet")
    turned = {"rotate": {"axis": [0, 1, 0], "degrees": 90, "center": [0, 0, 0]}}
    handles({"region": RIGHT, **turned}, {"region": LEFT, **turned}, tolerance=1e-8)
    deform("normals.vsm", "normals.vtp", "--quiet")
    result = read_vtk_xml("normals.vtp")
    for (x, y, z), normal in zip(result["Points"], result["Normals"]):
        # The rest position is (-z, y, x); the normal points away from the circle in the middle.
        ring = math.hypot(z, y)
        assert math.dist(normal, (x, y * (1 - 2 / ring), z * (1 - 2 / ring))) < 0.1
    deform("normals.vsm", "dropped.vsm", "--normals", "drop", "--quiet")
    assert "Normals" not in columns("dropped.vsm") and "Normals" in columns("normals.vsm")


def test_bad_handles():
    sound = {"region": LEFT, "fixed": True}
    cases = [
        ({"region": {"sphere": [9, 9, 9, 1]}, "fixed": True}, "handles[1].region: no vertex"),
        ({"region": {"vertices": [7200]}, "fixed": True}, "number 7200"),
        ({"region": {"vertices": [-1]}, "fixed": True}, "handles[1].region.vertices[0]"),
        ({"region": {"cone": [1]}, "fixed": True}, "handles[1].region.cone"),
        ({"region": RIGHT, "translate": [0, math.nan, 0]}, "line 1"),
        ({"region": RIGHT, "translate": [0, None, 0]}, "handles[1].translate[1]"),
        ({"region": RIGHT, "scale": 0, "center": [0, 0, 0]}, "handles[1].scale"),
        ({"region": RIGHT, "scale": -2, "center": [0, 0, 0]}, "handles[1].scale"),
        ({"region": RIGHT, "scale": 2}, "add \"center\""),
        ({"region": RIGHT, "rotate": {"axis": [0, 0, 0], "degrees": 9}}, "handles[1].rotate.axis"),
        ({"region": RIGHT, "twist": 3}, "handles[1].twist"),
        ({"region": RIGHT}, "handles[1]: must be fixed"),
        ({"region": RIGHT, "fixed": True, "scale": 2}, "handles[1].fixed")]
    for handle, place in cases:
        handles(sound, handle)
        done = deform("torus.vsm", "bad.vsm", code=1)
        assert "handles.json" in done.stderr and place in done.stderr, (handle, done.stderr)
    for members, place in (({"sweeps": 1}, "sweeps"), ({"cycles": 0}, "cycles"),
                           ({"cycles": 2, "tolerance": 0.1}, "tolerance")):
        handles(sound, **members)
        assert place in deform("torus.vsm", "bad.vsm", code=1).stderr
    handles()
    assert "at least one handle" in deform("torus.vsm", "bad.vsm", code=1).stderr
    run("deform", "torus.vsm", "bad.vsm", "--handles", "missing.json", code=1)
    # The handles are read before the mesh.
    os.makedirs("folder.json", exist_ok=True)
    done = run("deform", "missing.ply", "bad.vsm", "--handles", "folder.json", code=1)
    assert "folder.json: this is a folder" in done.stderr, done.stderr
    assert not any(name.startswith("bad") for name in os.listdir("."))


def test_notes_on_handles():
    """Notes report handles without effect, and are empty if all have one."""
    everywhere = {"halfspace": [1, 0, 0, -9]}
    for out in ("out.vsm", "out.ply"):
        handles({"region": RIGHT, "translate": [0, 0, 1]}, {"region": everywhere, "fixed": True})
        done = deform("surface.ply", out, "--report", "report.json")
        notes = load("report.json")["notes"]
        assert "handles[0] holds nothing that a later handle does not hold." in notes, notes
        assert "No handle moves anything: OUT is IN." in notes, notes
        assert "OUT is IN" in done.stdout, done.stdout
    handles({"region": LEFT, "fixed": True}, {"region": RIGHT, "translate": [0, 0, 1]})
    deform("surface.ply", "out.ply", "--quiet", "--report", "report.json")
    assert not any("handle" in note for note in load("report.json")["notes"])


def test_help():
    shown = run("deform", "--help").stdout
    footer = shown.strip().split("\n\n")[-1]
    assert all(key in footer
               for key in ("handles", "region", "halfspace", "degrees", "tolerance")), shown
    for command in ("deform", "solve"):
        assert re.search(r"[=\[]1024", run(command, "--help").stdout)
    for command in ("convert", "info", "preview"):
        assert re.search(r"[=\[]256", run(command, "--help").stdout)


def test_errors():
    handles({"region": LEFT, "fixed": True})
    done = run("deform", "torus.vsm", "bad.vsm", code=2)
    assert "smg deform --help" in done.stderr, done.stderr
    assert "smg --help" in run("nothing", code=2).stderr
    for name, part in (("bad.xyz", ".vsm"), ("bad", ".vsm"),
                       ("bad.svb", "tri"), (os.path.join("nowhere", "bad.vsm"), "nowhere")):
        done = deform("torus.vsm", name, code=1)
        assert name in done.stderr and part in done.stderr, done.stderr
    deform("missing.vsm", "bad.vsm", code=1)
    done = deform("torus.vsm", "bad.vsm", "--memory", 1, code=1)
    assert "1 MiB" in done.stderr, done.stderr
    deform("torus.vsm", "bad.vsm", "--report", ".", code=1)
    assert not any(name.startswith("bad") for name in os.listdir("."))


def test_preview():
    """Every point of a preview is a vertex of the mesh and holds its number."""
    run("convert", "torus.obj", "shuffled.vsm", "--order", "axis", "--quiet")
    points = arrays("shuffled.vsm")["Points"]
    originals = torus(120, 60)[0]
    done = run("preview", "shuffled.vsm", "preview.vtp", "--points", 1000, "--report", "report.json")
    preview, report = read_vtk_xml("preview.vtp"), load("report.json")
    assert report["points"] == len(preview["Points"]) and 700 <= report["points"] <= 1000
    assert report["triangles"] == len(preview["offsets"]) and report["vertices"] == 7200
    assert str(report["points"]) + " points" in done.stdout
    assert preview["Points"] == [points[id] for id, in preview["StreamIndex"]]
    assert all(math.dist(point, originals[id]) < 1e-8
               for point, (id,) in zip(preview["Points"], preview["OriginalId"]))
    assert {i for i, in preview["connectivity"]} == set(range(report["points"]))
    run("preview", "shuffled.vsm", "preview.vtu", "--points", 1000, "--quiet")
    grid = read_vtk_xml("preview.vtu")
    assert grid.pop("types") == [(5,)] * report["triangles"] and grid == preview
    for name in ("preview.vsm", "preview.ply"):
        run("preview", "shuffled.vsm", name, "--points", 1000, "--quiet")
        result = arrays(name)
        assert [tuple(map(int, id)) for id in result["StreamIndex"]] == preview["StreamIndex"]
        assert result["Points"] == preview["Points"]
        assert result["connectivity"] == preview["connectivity"]
    assert set(columns("preview.vsm")) == {"OriginalId", "StreamIndex"}
    run("preview", "torus.obj", "whole.vsm", "--quiet", "--report", "report.json")
    assert load("report.json")["points"] <= 10000
    run("preview", "preview.vsm", "again.vsm", "--points", 100, "--quiet")
    again = arrays("again.vsm")
    assert again["Points"] == [arrays("preview.vsm")["Points"][id] for id, in again["StreamIndex"]]


def test_preview_of_solids():
    run("preview", "solid.mesh", "shell.vtp", "--points", 100000, "--quiet")
    shell = read_vtk_xml("shell.vtp")
    assert len(shell["Points"]) == 6 ** 3 - 4 ** 3 and len(shell["offsets"]) == 6 * 2 * 5 ** 2
    assert all(0 in point or 5 in point for point in shell["Points"])


def test_preview_errors():
    for name in ("p.smb", "p.xyz", os.path.join("nowhere", "p.vsm")):
        assert name in run("preview", "torus.vsm", name, code=1).stderr
    run("preview", "torus.vsm", code=2)
    run("preview", "torus.vsm", "p.vsm", "--points", 7, code=2)
    run("preview", "torus.vsm", "p.vsm", "--points", 1000001, code=2)
    run("preview", "torus.vsm", "p.vsm", "--threads", 1, code=2)
    with open("point.obj", "w", encoding="utf-8") as file:
        file.write("v 1 1 1\nv 2 1 1\nf 1 1 2\n")
    assert "point.obj: a preview" in run("preview", "point.obj", "p.vsm", code=1).stderr
    run("preview", "missing.ply", "p.vsm", code=1)
    assert not any(name.startswith("p.") for name in os.listdir("."))


for each in (test_rigid_motions, test_report_and_options, test_formats, test_order_of_files,
             test_every_format_keeps_its_order, test_orders_that_are_not_known,
             test_notes_on_the_order, test_solids, test_inverted_cells, test_normals, test_bad_handles,
             test_notes_on_handles, test_help, test_errors,
             test_preview, test_preview_of_solids, test_preview_errors):
    each()
    print("passed", each.__name__)
sys.exit(0)
