#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg smooth as a black box: results, options, formats, reports and errors."""

import json
import math
import random
import sys

from mesh_files import read_mesh
from program import load, read_vtk_xml, run, write_medit, write_ply
from tetrahedra import tetrahedra
from torus import torus


def obj(name, noise=0.0, keep=lambda k: True):
    """A torus of squares as OBJ, with each coordinate moved by up to `noise`."""
    numbers = random.Random(5)
    points, quadrangles = torus(120, 60)
    with open(name, "w", encoding="utf-8") as file:
        for point in points:
            file.write("v %r %r %r\n" % tuple(x + numbers.uniform(-noise, noise) for x in point))
        for k, quadrangle in enumerate(quadrangles):
            if keep(k):
                file.write("f %d %d %d %d\n" % tuple(corner + 1 for corner in quadrangle))


def smooth(mesh, out, *arguments, **options):
    done = run("smooth", mesh, out, "--report", "report.json", *arguments, **options)
    return done if "code" in options else load("report.json")


def points_of(name):
    return read_mesh(name)[0]


def deviation(name):
    """The root mean square of the distance of the points from the torus."""
    squares = [(math.hypot(math.hypot(x, y) - 2, z) - 1)**2 for x, y, z in points_of(name)]
    return math.sqrt(sum(squares) / len(squares))


def test_noise_goes_and_volume_stays():
    obj("noisy.obj", 0.03)
    report = smooth("noisy.obj", "smooth.obj")
    assert deviation("smooth.obj") < 0.5 * deviation("noisy.obj")
    volume = report["volume"]
    assert math.isclose(volume["before"], volume["after"], rel_tol=1e-9), volume
    assert 2 * math.pi**2 * 2 * 0.97 < volume["before"] < 2 * math.pi**2 * 2, volume
    assert [step["name"] for step in report["steps"]] == ["step 1"] and report["converged"]
    report = smooth("noisy.obj", "shrunk.obj", "--no-keep-volume", "--size", "1.5", "--steps", "2")
    volume = report["volume"]
    assert volume["after"] < 0.98 * volume["before"], volume
    assert math.isclose(volume["after"] - volume["before"], volume["swept"], rel_tol=1e-9)
    assert len(report["steps"]) == 2


def test_what_would_leave_nothing_of_the_shape_is_refused():
    for size in ("1000%", "1000", "1e9edges"):
        said = smooth("noisy.obj", "x.obj", "--size", size, code=1).stderr
        assert "larger than the mesh" in said and ("in the unit of the mesh" in said) == (size == "1000"), said
    mesh = read_mesh("noisy.obj")
    points, faces = mesh.points, mesh.cells
    with open("soup.obj", "w", encoding="utf-8") as file:
        corners = [corner for face in faces for corner in face]
        for corner in corners:
            file.write("v %r %r %r\n" % tuple(points[corner]))
        for face in range(0, len(corners), 4):
            file.write("f %d %d %d %d\n" % tuple(range(face + 1, face + 5)))
    assert "merge those of equal coordinates, or within a distance, first (option --weld 0" in smooth("soup.obj", "x.obj", code=1).stderr
    pairs = smooth("soup.obj", "x.vsm", "--weld", "0")
    assert pairs["vertices"] == len(points), pairs["vertices"]


def test_the_order_and_the_polygons_of_the_input_stay():
    before, after = read_mesh("noisy.obj"), read_mesh("smooth.obj")
    assert before[1] == after[1]
    assert max(math.dist(a, b) for a, b in zip(before[0], after[0])) < 0.3


def test_every_way_gives_the_same_points():
    expected = points_of("smooth.obj")
    for options in (("--in-core",), ("--size", "4edges"), ("--size", "4edge"), ("--size", "4 edges")):
        smooth("noisy.obj", "again.obj", *options)
        assert points_of("again.obj") == expected, options
    run("convert", "noisy.obj", "noisy.vsm", "--quiet")
    smooth("noisy.vsm", "again.vsm")
    run("convert", "again.vsm", "again.obj", "--restore-order", "--quiet")
    smooth("noisy.vsm", "direct.obj")
    other = points_of("again.obj")
    assert points_of("direct.obj") == other and read_mesh("direct.obj")[1] == read_mesh("again.obj")[1]
    assert max(math.dist(a, b) for a, b in zip(other, expected)) < 1e-6


def test_sizes():
    """The diagonal of the bounds of the exact torus is known."""
    obj("torus.obj")
    diagonal = math.sqrt(36 + 36 + 4)
    smooth("torus.obj", "a.obj", "--size", "10%")
    smooth("torus.obj", "b.obj", "--size", repr(diagonal / 10))
    assert max(math.dist(a, b) for a, b in zip(points_of("a.obj"), points_of("b.obj"))) < 1e-3


def test_what_is_held_does_not_move():
    obj("open.obj", 0.03, keep=lambda k: k >= 1200)
    held = '{"halfspace": [1, 0, 0, 1.5]}'
    with open("hold.json", "w", encoding="utf-8") as file:
        json.dump([{"halfspace": [0, 0, 1, 0.9]}, {"boundary": True}], file)
    report = smooth("open.obj", "held.obj", "--hold", held, "--hold", "hold.json")
    assert report["volume"]["before"] is None and report["prescribed"] > 1000
    moved = 0
    for a, b in zip(points_of("open.obj"), points_of("held.obj")):
        isHeld = a[0] >= 1.5 or a[2] >= 0.9
        assert not isHeld or math.dist(a, b) < 1e-6, (a, b)
        moved += a != b
    assert moved > 1000
    rims = {}
    for boundary in ("smooth", "fixed", "free"):
        report = smooth("open.obj", boundary + ".obj", "--boundary", boundary)
        rims[boundary] = (report["prescribed"], points_of(boundary + ".obj"))
    assert rims["smooth"][0] == rims["fixed"][0] > 0 == rims["free"][0]
    assert rims["smooth"][1] != rims["fixed"][1] != rims["free"][1]


def test_a_column_keeps_its_type():
    points, cells = tetrahedra(6)
    write_medit("solid.mesh", points, cells)
    run("convert", "solid.mesh", "solid.vsm", "--quiet")
    with open("heat.json", "w", encoding="utf-8") as file:
        json.dump({"source": [{"value": 0}, {"halfspace": [1, 0, 0, 0.5], "value": 1}],
                   "screening": 100}, file)
    run("solve", "solid.vsm", "heat.vsm", "--problem", "heat.json", "--quiet")
    report = smooth("heat.vsm", "even.vsm", "--column", "Solution", "--size", "50%")
    assert "volume" not in report
    arrays = {}
    for name in ("heat", "even"):
        run("convert", name + ".vsm", name + ".vtu", "--order", "keep", "--quiet")
        arrays[name] = read_vtk_xml(name + ".vtu")
    spread = {name: max(all["Solution"])[0] - min(all["Solution"])[0]
              for name, all in arrays.items()}
    assert spread["even"] < 0.8 * spread["heat"], spread
    assert arrays["heat"]["Points"] == arrays["even"]["Points"]


def test_whole_numbers_are_rounded():
    side = 12
    with open("levels.ply", "w", encoding="utf-8") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {side * side}\n"
                   "property float x\nproperty float y\nproperty float z\nproperty int level\n"
                   f"element face {(side - 1)**2}\nproperty list uchar int vertex_indices\n"
                   "end_header\n")
        for k in range(side * side):
            file.write(f"{k % side} {k // side} 0 {100 * (k % side > 5)}\n")
        for k in range((side - 1)**2):
            a = k // (side - 1) * side + k % (side - 1)
            file.write(f"4 {a} {a + 1} {a + side + 1} {a + side}\n")
    report = smooth("levels.ply", "rounded.vtp", "--column", "level", "--size", "4")
    assert "clipped" not in report
    levels = [level for level, in read_vtk_xml("rounded.vtp")["level"]]
    assert all(isinstance(level, int) for level in levels)
    assert 0 <= min(levels) and max(levels) <= 100 and len(set(levels)) > 4, levels


def test_errors():
    def says(text, *arguments, code=1):
        error = run("smooth", *arguments, code=code).stderr
        assert text in error, error

    says("has no column 'x'", "torus.obj", "c.vsm", "--column", "x")
    says("'OriginalId' numbers the vertices", "torus.obj", "c.vsm", "--column", "OriginalId")
    says("name a column of the vertices", "solid.vsm", "c.vsm")
    says("hold[0]: no vertex", "torus.obj", "c.vsm", "--hold", '{"sphere": [9, 9, 9, 1]}')
    says("cannot be opened", "torus.obj", "c.vsm", "--hold", "missing.json")


def test_edges_are_kept():
    report = smooth("noisy.obj", "sharp.obj", "--steps", "5", "--size", "8edges", "--keep-edges", "30")
    assert report["steps"][0]["name"] == "presmoothing 1" and len(report["steps"]) == 10
    smooth("noisy.obj", "round.obj", "--steps", "5", "--size", "8edges")
    assert points_of("sharp.obj") != points_of("round.obj")


def test_the_winding_is_mended():
    """The smoothed points do not depend on it, and with --orient the winding of OUT not either."""
    points, quadrangles = torus(60, 30)
    triangles = [cell for a, b, c, d in quadrangles for cell in ((a, b, c), (a, c, d))]
    numbers = random.Random(3)
    wound = [cell[::-1] if numbers.random() < 0.4 else cell for cell in triangles]
    write_ply("wound.ply", points, wound, {name: ("float", [0] * len(points)) for name in ("nx", "ny", "nz")})
    plain = smooth("wound.ply", "plain.ply", "--size", "0.5")
    assert read_mesh("plain.ply").cells == wound, plain["notes"]
    run("convert", "wound.ply", "wound.vsm", "--quiet")
    for mesh, outs in (("wound.ply", ("o.ply", "o.obj", "o.vsm")), ("wound.vsm", ("o.ply", "o.vsm", "o.vtp"))):
        for out in outs:
            report = smooth(mesh, out, "--size", "0.5", "--orient")
            assert any("turned." in note for note in report["notes"]), report["notes"]
            assert math.isclose(report["volume"]["after"], plain["volume"]["after"], rel_tol=1e-12)
            run("info", out, "--full", "--quiet", "--report", "info.json")
            facts = load("info.json")["description"]
            assert facts["consistently_wound"] and facts["turned_volume"] == 0, (mesh, out)
            if mesh == "wound.ply" and out != "o.vsm":
                found = read_mesh(out)
                assert max(math.dist(a, b) for a, b in zip(found.points, points_of("plain.ply"))) < 1e-6
                assert [sorted(cell) for cell in found.cells] == [sorted(cell) for cell in wound]
    arrays = read_vtk_xml("o.vtp")
    outside = [sum(n * (x - c) for n, x, c in zip(normal, p, centre_of(p)))
               for normal, p in zip(arrays["Normals"], arrays["Points"])]
    assert min(outside) > 0 or max(outside) < 0, (min(outside), max(outside))
    assert smooth("o.vsm", "again.vsm", "--orient")["notes"] == smooth("o.vsm", "again.vsm")["notes"]


def centre_of(point):
    """The nearest point of the circle in the torus."""
    x, y, _ = point
    return 2 * x / math.hypot(x, y), 2 * y / math.hypot(x, y), 0.0


for each in (test_noise_goes_and_volume_stays, test_what_would_leave_nothing_of_the_shape_is_refused,
             test_the_order_and_the_polygons_of_the_input_stay, test_every_way_gives_the_same_points, test_sizes,
             test_what_is_held_does_not_move, test_a_column_keeps_its_type, test_whole_numbers_are_rounded,
             test_errors, test_edges_are_kept,
             test_the_winding_is_mended):
    each()
    print("passed", each.__name__)
sys.exit(0)
