#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg distance as a black box: results, orders of files, reports, errors and exit codes."""

import json
import math
import os
import re

from program import load, read_vtk_xml, run, write_medit, write_torus
from tetrahedra import tetrahedra
from torus import torus

POINTS, _ = torus(60, 30)


def distances(mesh, out, *arguments, **options):
    """Runs smg distance and returns the arrays of the result."""
    run("distance", mesh, out, *arguments, **options)
    return read_vtk_xml(out)


def flat(values):
    return [value[0] for value in values]


def test_columns_in_the_order_of_the_file():
    write_torus("torus.obj", 60, 30)
    done = run("distance", "torus.obj", "torus.vtp", "--from", '{"vertices": [7]}', "--source",
               "--direction", "--report", "report.json")
    assert done.stderr == "" and "1 source," in done.stdout and "maximum" in done.stdout
    arrays = read_vtk_xml("torus.vtp")
    distance, report = flat(arrays["Distance"]), load("report.json")
    assert distance[7] == 0 and min(distance[:7] + distance[8:]) > 0
    assert max(distance) == report["distance"]["maximum"]
    assert report["distance"]["sources"] == 1 and report["distance"]["unreached"] == 0
    assert report["converged"] and report["passes"] == 1 and report["vertices"] == 1800
    assert set(flat(arrays["DistanceSource"])) == {7}
    run("distance", "torus.obj", "groups.vtp", "--from", '[{"vertices": [7, 900]}, {"vertices": [1200]}]', "--from",
        '{"vertices": [30]}', "--group", "--source")
    found = read_vtk_xml("groups.vtp")
    assert all(group == {7: 0, 900: 0, 1200: 1, 30: 2}[source]
               for group, source in zip(flat(found["DistanceGroup"]), flat(found["DistanceSource"])))
    assert set(flat(found["DistanceGroup"])) == {0, 1, 2}
    for point, value, direction in zip(POINTS, distance, arrays["DistanceDirection"]):
        # No path is shorter than the straight line, nor longer than half around both circles.
        assert math.dist(point, POINTS[7]) <= value * (1 + 1e-6) < 15
        assert abs(math.hypot(*direction) - (value > 0)) < 1e-6


def test_sources_add_up():
    write_torus("torus.obj", 60, 30)
    with open("places.json", "w", encoding="utf-8") as file:
        json.dump([{"vertices": [900]}, {"nearest": [POINTS[33]]}], file)
    single = [flat(distances("torus.obj", "one.vtp", "--from", '{"vertices": [%d]}' % v)["Distance"])
              for v in (7, 900, 33)]
    both = flat(distances("torus.obj", "both.vtp", "--from", '{"vertices": [7]}', "--from",
                          "places.json")["Distance"])
    assert all(abs(a - min(b)) < 0.1 for a, b in zip(both, zip(*single)))
    assert both[7] == both[900] == both[33] == 0


def test_walls_of_a_box():
    points, cells = tetrahedra(5)
    write_medit("box.mesh", points, cells)
    wall = flat(distances("box.mesh", "box.vtu", "--wall")["Distance"])
    for point, value in zip(points, wall):
        expected = min(min(x, 4 - x) for x in point)
        assert abs(value - expected) < 1e-6, (point, value, expected)
    floor = flat(distances("box.mesh", "box.vtu", "--wall", "--from",
                           '{"halfspace": [0, 0, -1, 0]}')["Distance"])
    assert all(abs(value - point[2]) < 1e-6 for point, value in zip(points, floor))


def test_paths():
    write_torus("torus.obj", 60, 30)
    ends, source = [11, 900, 1700], ("--from", '{"vertices": [7]}')
    places = json.dumps({"vertices": ends})
    away = distances("torus.obj", "away.vtp", *source, "--to", places, "--path", "path.vtp", "--report", "report.json")
    run("distance", "torus.obj", "away.vtp", *source, "--to", places, "--path", "path.obj", "--quiet")
    found = load("report.json")["distance"]["paths"]
    assert sorted(path["to"] for path in found) == ends
    with open("path.vtp", encoding="utf-8") as file:
        text = file.read()
    values = {name: [float(x) for x in re.search(f'"{name}"[^>]*>([^<]*)<', text)[1].split()]
              for name in ("To", "From", "Length", "offsets")}
    assert values["To"] == [path["to"] for path in found] and values["From"] == [7] * 3
    assert values["offsets"][-1] == sum(len(path["points"]) for path in found)
    with open("path.obj", encoding="utf-8") as file:
        rows = [line.split() for line in file]
    points = [[float(x) for x in row[1:]] for row in rows if row[0] == "v"]
    lines = [[points[int(k) - 1] for k in row[1:]] for row in rows if row[0] == "l"]
    assert lines == [path["points"] for path in found]
    for path, length in zip(found, values["Length"]):
        assert length == path["length"]
        assert abs(sum(map(math.dist, path["points"], path["points"][1:])) - length) < 1e-12
        assert abs(flat(away["Distance"])[path["to"]] - length) < 1e-12
    assert "--path requires --to" in run("distance", "torus.obj", "away.vtp", *source, "--path", "p.vtp", code=2).stderr
    for file, to, sentence in (("path.txt", places, "the file of paths must be a .vtp or an .obj file"),
                               ("away.vtp", places, "the file of paths would overwrite it, which is the result"),
                               ("path.vtp", '{"halfspace": [0, 0, 1, -9]}', "more than 1,000 vertices"),
                               ("path.vtp", '{"vertices": [1800]}', "distance: to[0].vertices: the mesh has no vertex")):
        error = run("distance", "torus.obj", "away.vtp", *source, "--to", to, "--path", file, code=1).stderr
        assert sentence in error, error


def test_vertices_of_no_cell_are_not_reached():
    write_torus("loose.obj", 60, 30)
    with open("loose.obj", encoding="utf-8") as file:
        lines = file.read()
    with open("loose.obj", "w", encoding="utf-8") as file:
        file.write(lines + "v 0 0 7\nv 0 0 8\n")
    # Into the file, into a .vsm, and again over the distances of an earlier run.
    arguments = ("--from", '{"vertices": [7]}', "--source", "--direction", "--quiet")
    done = run("distance", "loose.obj", "loose.vtp", *arguments[:-1])
    assert "2 vertices belong to no cell: they are not reached." in done.stdout, done.stdout
    run("distance", "loose.obj", "loose.vsm", *arguments)
    run("distance", "loose.vsm", "again.vsm", *arguments)
    run("convert", "loose.vsm", "vsm.vtp", "--restore-order", "--quiet")
    run("convert", "again.vsm", "again.vtp", "--restore-order", "--quiet")
    # Other distances have neither these sources nor these directions.
    run("distance", "loose.vtp", "other.vtp", *arguments[:2], "--quiet")
    assert not {"DistanceSource", "DistanceGroup", "DistanceDirection"} & set(read_vtk_xml("other.vtp"))
    for name in ("loose.vtp", "vsm.vtp", "again.vtp"):
        arrays = read_vtk_xml(name)
        assert flat(arrays["Distance"])[-2:] == [math.inf] * 2, name
        assert math.isfinite(flat(arrays["Distance"])[-3]), name
        assert flat(arrays["DistanceSource"])[-3:] == [7, -1, -1], name
        assert arrays["DistanceDirection"][-2:] == [(0, 0, 0)] * 2, name


def test_errors():
    write_torus("torus.obj", 60, 30)
    usage = run("distance", "torus.obj", "out.vtp", code=2).stderr
    assert "--from or --wall is required" in usage
    for wrong, sentence in (("-form", "-form begins as an option does: a file of this name is ./-form, or comes after --"),
                            ("--form", "--form is not an option of smg distance: did you mean --from?"),
                            ("--nothing-like-it", "--nothing-like-it is not an option of smg distance (")):
        assert sentence in run("distance", "torus.obj", "out.vtp", wrong, "x", code=2).stderr
    places = ("--from", '{"vertices": [0]}', "--quiet")
    for size in ("64", "64M", "64MiB", "0.1G", "0.1 GiB", "200MB", "1e5kb"):
        run("distance", "torus.obj", "out.vtp", *places, "--memory", size, "--scratch-limit", size)
    run("distance", "torus.obj", "out.vtp", *places, "--memory", "20.5MB", "--dry-run", "--report", "dry.json")
    assert load("dry.json")["memory_limit"] == 20_500_000  # not whole MiB
    os.remove("out.vtp")
    for size, sentence in (("2000000T", "is no size from 1 to"), ("2X", "'2X' has another unit"), ("1K", "'1K' is not a size"), ("0", "is no size from 1 to"),
                           ("-3G", "'-3G' is not a size"), ("nanG", "'nanG' is not a size"), ("M", "M")):
        assert sentence in run("distance", "torus.obj", "out.vtp", *places, "--memory", size,
                               code=2).stderr
    assert "smg: --from: " in run("distance", "torus.obj", "out.vtp", "--from", "{", code=2).stderr
    with open("broken.json", "w", encoding="utf-8") as file:
        file.write("{")
    for arguments, sentence in (
            (("--from", "broken.json"), "broken.json: "),
            (("--from", "absent.json"), "absent.json: cannot be opened"),
            (("--from", '{"vertices": [1800]}'), "distance: from[0].vertices: the mesh has no vertex"),
            (("--from", '{"boundary": true}'), "distance: from[0]: no vertex of the mesh is on a boundary"),
            (("--wall",), "distance to walls is that of a tetrahedral mesh")):
        error = run("distance", "torus.obj", "out.vtp", *arguments, code=1).stderr
        assert sentence in error, error
    error = run("distance", "torus.obj", "out.obj", "--from", '{"vertices": [1]}', code=1).stderr
    assert "cannot hold a distance" in error, error


for each in (test_columns_in_the_order_of_the_file, test_sources_add_up, test_walls_of_a_box, test_paths,
             test_vertices_of_no_cell_are_not_reached, test_errors):
    each()
    print("passed", each.__name__)
