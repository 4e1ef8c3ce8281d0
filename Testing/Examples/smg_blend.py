#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg blend as a black box: results, orders of files, reports, errors and exit codes."""

import math
import os
import sys

from mesh_files import read_mesh
from program import load, read_vtk_xml, run
from torus import torus

POINTS, QUADRANGLES = torus(120, 60)
LOOSE = ((9, 9, 9), (8, 8, 8))


def patch(point):
    return (1 if point[0] > 0 else 2) + (2 if point[1] > 0 else 0)


def colour(point):
    """A smooth colour in the light of one of four scanners."""
    shade = [110 + 8 * math.sin(point[k]) for k in range(3)]
    gain, offset = (1, 0.9, 1.1, 0.95)[patch(point) - 1], (0, 20, -15, 25)[patch(point) - 1]
    return [round(gain * value + offset) for value in shade]


def scan_file(name, brightness=0):
    """A torus with colours and patches, and isolated points, as PLY."""
    points = list(LOOSE) + POINTS
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\ncomment of a scanner\nelement vertex %d\n" % len(points))
        file.writelines("property double %s\n" % axis for axis in "xyz")
        file.writelines("property uchar %s\n" % name for name in ("red", "green", "blue"))
        file.write("property int scan\nelement face %d\n" % len(QUADRANGLES))
        file.write("property list uchar int vertex_indices\nend_header\n")
        for point in points:
            light = [min(255, max(0, value + brightness)) for value in colour(point)]
            file.write("%r %r %r %d %d %d %d\n" % (*point, *light, patch(point)))
        file.writelines("4 %d %d %d %d\n" % tuple(i + 2 for i in face) for face in QUADRANGLES)


def colours(name):
    """The colours of the points of the torus, in the order of the file."""
    run("convert", name, "colours.vsm", "--quiet")
    run("convert", "colours.vsm", "colours.vtu", "--restore-order", "--quiet")
    return read_vtk_xml("colours.vtu")["Colors"]


def largest_step(values):
    return max(abs(values[a][k] - values[b][k])
               for face in QUADRANGLES for a, b in zip(face, face[1:] + face[:1])
               if patch(POINTS[a]) != patch(POINTS[b]) for k in range(3))


def blend(mesh, out, *arguments, **options):
    return run("blend", mesh, out, "--patch", "scan", "--columns", "Colors", *arguments, **options)


def test_seams_vanish():
    scan_file("scan.ply")
    done = blend("scan.ply", "blended.ply", "--report", "report.json")
    report = load("report.json")
    assert report["converged"] and done.stderr == "" and report["clipped"] == 0
    (seam,) = report["seams"]
    before, after = colours("scan.ply"), colours("blended.ply")
    assert seam["column"] == "Colors" and seam["before"] == largest_step(before[2:])
    # Rounding to whole numbers adds up to one step of a colour.
    assert seam["after"] <= 0.05 * seam["before"] and largest_step(after[2:]) <= seam["after"] + 1
    assert "Colors: the largest step between patches was" in done.stdout
    assert "2 vertices belong to no cell: they keep their values." in done.stdout, done.stdout
    assert after[:2] == before[:2]
    mesh, result = read_mesh("scan.ply"), read_mesh("blended.ply")
    assert mesh.points == result.points and mesh.cells == result.cells


def test_every_format_of_columns():
    """Each has the bits of the way through .vsm and --restore-order."""
    run("convert", "scan.ply", "scan.vsm", "--quiet")
    blend("scan.vsm", "blended.vsm", "--quiet")
    for suffix in (".ply", ".vtk", ".vtp", ".vtu"):
        done = blend("scan.ply", "direct" + suffix)
        assert "stream order" not in done.stdout, done.stdout
        run("convert", "blended.vsm", "restored" + suffix, "--restore-order", "--quiet")
        with open("direct" + suffix, "rb") as one, open("restored" + suffix, "rb") as two:
            assert one.read() == two.read(), suffix
    # OBJ and OFF have places for colours alone.
    for suffix in (".obj", ".off"):
        done = blend("scan.ply", "direct" + suffix)
        assert "are left out, since %s files have no place" % suffix in done.stdout, done.stdout
        unit = 255 if suffix == ".obj" else 1
        assert all(abs(unit * a - b) < 1e-3
                   for found, wanted in zip(colours("direct" + suffix), colours("direct.ply"))
                   for a, b in zip(found, wanted)), suffix
    mesh, result = read_mesh("scan.ply"), read_mesh("direct.obj")
    assert mesh.points == result.points and mesh.cells == result.cells
    # From a .vsm file with the original numbers, too, in their order.
    before = read_mesh("direct.obj")
    blend("scan.vsm", "direct.obj", "--quiet")
    again = read_mesh("direct.obj")
    assert before.points == again.points and before.cells == again.cells
    blend("scan.vsm", "again.vsm", "--in-core", "--threads", 1, "--quiet")
    with open("blended.vsm", "rb") as one, open("again.vsm", "rb") as two:
        assert one.read() == two.read(), "streaming and in-core results differ"


def test_options():
    """Held vertices keep their values; an anchor pulls."""
    right = '{"halfspace": [1, 0, 0, 2]}'
    blend("scan.ply", "held.ply", "--hold", right, "--hold", '{"sphere": [-3, 0, 0, 0.5]}',
          "--anchor", 0, "--quiet", "--report", "report.json")
    before, after = colours("scan.ply")[2:], colours("held.ply")[2:]
    held = [i for i, p in enumerate(POINTS)
            if p[0] >= 2 or math.dist(p, (-3, 0, 0)) <= 0.5]
    assert load("report.json")["prescribed"] == len(held)
    assert all(before[i] == after[i] for i in held) and before != after
    blend("scan.ply", "pulled.ply", "--anchor", 1e7, "--quiet")
    assert colours("pulled.ply")[2:] == before
    # With averaged gradients, colours rise across seams as beside them: closer to those before the
    # scanners, up to a constant.
    errors = {}
    for seam in ("zero", "average"):
        blend("scan.ply", seam + ".ply", "--seam", seam, "--quiet")
        red = [light[0] - 8 * math.sin(p[0]) for light, p in zip(colours(seam + ".ply")[2:], POINTS)]
        mean = sum(red) / len(red)
        errors[seam] = math.sqrt(sum((x - mean) ** 2 for x in red) / len(red))
    assert errors["average"] < errors["zero"], errors


def test_clipping():
    scan_file("bright.ply", brightness=124)
    done = blend("bright.ply", "clipped.ply", "--anchor", 0, "--hold",
                 '{"sphere": [-3, 0.1, 0, 0.2]}', "--report", "report.json")
    report = load("report.json")
    assert report["clipped"] > 0
    assert "%d values were outside the range" % report["clipped"] in done.stdout, done.stdout
    result = colours("clipped.ply")[2:]
    assert max(max(light) for light in result) == 255


def test_errors():
    for arguments, part in ((("--patch", "nothing", "--columns", "Colors"), "no column 'nothing'"),
                            (("--patch", "scan", "--columns", "Colours"), "no column 'Colours'"),
                            (("--patch", "scan", "--columns", "Colors,scan"), "numbers the patches"),
                            (("--patch", "Colors", "--columns", "scan"), "has 3 components"),
                            (("--patch", "scan", "--columns", "Colors", "--hold",
                              '{"sphere": [99, 0, 0, 1]}'), "hold[0]: no vertex")):
        done = run("blend", "scan.ply", "bad.ply", *arguments, code=1)
        assert part in done.stderr, done.stderr
    for name, columns in (("bad.smb", "Colors"), ("bad.obj", "height"), ("bad.off", "Colors,height")):
        done = run("blend", "scan.ply", name, "--patch", "scan", "--columns", columns, code=1)
        assert "cannot hold these columns of vertices" in done.stderr, done.stderr
    run("blend", "scan.ply", "bad.ply", "--columns", "Colors", code=2)
    done = blend("scan.ply", "bad.ply", "--memory", 8, code=1)
    assert "scan.ply: a conversion needs a memory limit of at least 16 MiB, but it is 8" in done.stderr
    assert "1 MiB" in blend("scan.vsm", "bad.ply", "--memory", 1, code=1).stderr
    assert not any(name.startswith("bad") for name in os.listdir("."))


for each in (test_seams_vanish, test_every_format_of_columns, test_options, test_clipping,
             test_errors):
    each()
    print("passed", each.__name__)
sys.exit(0)
