#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg solve with every datum of the grammar of problems, on a cube of tetrahedra whose exact
solutions are linear: linear finite elements find them up to the tolerance."""

import json
import os
import re
import sys

from program import load, read_vtk_xml, run
from tetrahedra import tetrahedra

N = 7
SIDE = N - 1
MIDDLE = SIDE / 2
POINTS, CELLS = tetrahedra(N)


def is_upper(cell):
    return min(POINTS[i][2] for i in cell) >= MIDDLE


def write_vtk(name, **changed):
    """The cube with columns; `changed` replaces columns of the cells."""
    vertices = {"bottom": [int(p[2] == 0) for p in POINTS], "z": [p[2] for p in POINTS],
                "four": [4] * len(POINTS)}
    cells = {"k": [10 if is_upper(c) else 1 for c in CELLS], "layer": [2 if is_upper(c) else 1 for c in CELLS],
             "upper": [int(is_upper(c)) for c in CELLS], "two": [2] * len(CELLS),
             "q": [(1, 2, 3)] * len(CELLS), "K": [(4, 2, 1, 0, 0, 0)] * len(CELLS)}
    cells.update(changed)
    with open(name, "w", encoding="utf-8") as file:
        file.write("# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write("POINTS %d double\n" % len(POINTS))
        file.writelines("%g %g %g\n" % point for point in POINTS)
        file.write("CELLS %d %d\n" % (len(CELLS), 5 * len(CELLS)))
        file.writelines("4 %d %d %d %d\n" % cell for cell in CELLS)
        file.write("CELL_TYPES %d\n" % len(CELLS) + "10\n" * len(CELLS))
        for kind, columns in (("POINT_DATA", vertices), ("CELL_DATA", cells)):
            rows = len(next(iter(columns.values())))
            file.write("%s %d\nFIELD data %d\n" % (kind, rows, len(columns)))
            for column, values in columns.items():
                tuples = [v if isinstance(v, tuple) else (v,) for v in values]
                file.write("%s %d %d double\n" % (column, len(tuples[0]), rows))
                file.writelines(" ".join("%g" % number for number in t) + "\n" for t in tuples)


def solve(mesh="cube.vsm", out="out.vtu", code=0, tolerance=1e-12, **members):
    """Solves and returns the report or, with another exit code, the error."""
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump(members, file)
    done = run("solve", mesh, out, "--problem", "problem.json", "--report", "report.json",
               "--tolerance", tolerance, *(["--quiet"] if code == 0 else []), code=code)
    return load("report.json") if code == 0 else done.stderr


def expect(function, columns=1, accuracy=1e-7, **members):
    """The report of a problem whose solution is a function of x, y, z; weights are single precision."""
    report = solve(columns=columns, **members)
    assert report["converged"], report
    arrays = read_vtk_xml("out.vtu")
    for point, value in zip(arrays["Points"], arrays["Solution"]):
        exact = function(*point)
        exact = exact if isinstance(exact, tuple) else (exact,)
        assert max(abs(a - b) for a, b in zip(value, exact)) < accuracy, (members, point, value)
    assert all(abs(balance) < 1e-8 for balance in report["balance"]), report["balance"]
    return report


BOTTOM = {"halfspace": [0, 0, -1, 0], "value": [0]}
TOP = {"halfspace": [0, 0, 1, SIDE], "value": [1]}


def test_what_is_unknown():
    """A flux that the digits of the values do not give is null in the report, and unknown in words."""
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{**BOTTOM, "value": [1e14]}, {**TOP, "value": [1e14 + 1]}]}, file)
    for report in "report.json", "report.html":
        said = run("solve", "cube.vsm", "out.vtu", "--problem", "problem.json", "--report", report).stdout
        lines = [line for line in said.splitlines() if "flux into the body" in line]
        assert len(lines) == 2 and all(line.endswith("flux into the body unknown") for line in lines), said
    assert all(condition["flux"] == [None] for condition in load("report.json")["conditions"])
    with open("report.html", encoding="utf-8") as file:
        page = file.read()
    assert "unknown" in page and "not a number" not in page


def test_cells_without_a_conductivity():
    """They have 1, which is said."""
    for others, says in ([], True), ([{"value": 1}], False):
        problem = {"conductivity": [*others, {"tag": ["layer", 2], "value": 10}], "dirichlet": [BOTTOM, TOP]}
        with open("problem.json", "w", encoding="utf-8") as file:
            json.dump(problem, file)
        said = run("solve", "cube.vsm", "out.vtu", "--problem", "problem.json").stdout
        line = r"^the conductivity is 1 in [0-9]+ % of the mesh, where none of its entries holds$"
        assert bool(re.search(line, said, re.M)) == says, said


def test_two_materials():
    """Layers of conductivity 1 and 10: the flux is the area over the sum of the resistances."""
    flux = SIDE ** 2 / (MIDDLE + MIDDLE / 10)
    gradient = flux / SIDE ** 2

    def exact(_x, _y, z):
        return gradient * min(z, MIDDLE) + gradient / 10 * max(z - MIDDLE, 0)

    solutions = set()
    upper = {"box": [0, 0, MIDDLE, SIDE, SIDE, SIDE]}
    for conductivity in ("k", [{"value": 1}, {"tag": ["layer", 2], "value": 10}],
                         [{"tag": ["layer", 1], "value": 1}, {"mask": "upper", "value": "k"}],
                         [{"value": 10}, {"value": 1}, {**upper, "value": 10}],
                         [{"value": 1}, {**upper, "value": [10, 10, 10, 0, 0, 0]}]):
        report = expect(exact, conductivity=conductivity, dirichlet=[BOTTOM, TOP],
                        outputs=["gradient", "flux"])
        bottom, top = report["conditions"]
        assert bottom["name"] == "dirichlet[0]" and top["area"] == SIDE ** 2
        assert bottom["vertices"] == sum(point[2] == 0 for point in POINTS)
        assert abs(top["flux"][0] - flux) < 1e-7 and abs(bottom["flux"][0] + flux) < 1e-7
        assert abs(top["mean"][0] - 1) < 1e-12
        arrays = read_vtk_xml("out.vtu")
        for (layer,), slope, flow in zip(arrays["layer"], arrays["Gradient"], arrays["Flux"]):
            assert abs(slope[2] * (10 if layer == 2 else 1) - gradient) < 1e-7, slope
            assert abs(flow[2] + gradient) < 1e-7 and abs(flow[0]) < 1e-7, flow
        solutions.add(tuple(arrays["Solution"]))
        assert POINTS[report["minimum"][0]["vertex"]][2] == 0
        assert POINTS[report["maximum"][0]["vertex"]][2] == SIDE
    # The weights of the tensor are rounded differently, all others are equal.
    assert len(solutions) <= 2, len(solutions)


def test_where():
    """The solution is the same for every way to name the vertices at both ends."""
    ends = [i for i, p in enumerate(POINTS) if p[2] == 0]
    solutions = set()
    for where in ({"halfspace": [0, 0, -1, 0]}, {"box": [0, 0, 0, SIDE, SIDE, 0.5]},
                  {"vertices": ends}, {"mask": "bottom"}, {"tag": ["bottom", 1]}, {"tag": ["z", 0]},
                  {"nearest": [[p[0], p[1], -9] for p in POINTS if p[2] == 0]}):
        expect(lambda x, y, z: z / SIDE, dirichlet=[TOP, {**where, "value": [0]}])
        solutions.add(tuple(read_vtk_xml("out.vtu")["Solution"]))
    assert len(solutions) == 1
    # The vertices of cells: all of the upper layer is held at its height.
    for where in ({"tag": ["layer", 2]}, {"mask": "upper"}):
        expect(lambda x, y, z: z, dirichlet=[BOTTOM, {**where, "value": "z"}])


def test_boundary():
    h, ambient, k, slope = 2.0, 3.0, 0.5, 0.75
    exact = h * ambient / (k + h * SIDE)
    top = {"halfspace": [0, 0, 1, SIDE]}
    for robin in ({**top, "coefficient": h, "ambient": [ambient]},
                  {**top, "coefficient": "two", "ambient": [ambient]},
                  {"tag": ["z", SIDE], "coefficient": [{"value": 7}, {"mask": "upper", "value": 2}],
                   "ambient": [ambient]}):
        report = expect(lambda x, y, z: exact * z, conductivity=k, dirichlet=[BOTTOM], robin=[robin])
        assert abs(report["conditions"][1]["flux"][0] - k * exact * SIDE ** 2) < 1e-7
    for flux in ({**top, "value": [slope * k]}, {"tag": ["z", SIDE], "value": [slope * k]}):
        report = expect(lambda x, y, z: slope * z, conductivity=k, dirichlet=[BOTTOM],
                        flux=[{**top, "value": [9]}, flux])
        # The later entry overrides the earlier one everywhere.
        assert [c["area"] for c in report["conditions"]] == [SIDE ** 2, 0, SIDE ** 2]


def test_everywhere():
    """An entry without a region holds everywhere, like the conditions of the filters."""
    expect(lambda x, y, z: 2, robin=[{"coefficient": 1, "ambient": 2}])
    expect(lambda x, y, z: 5, soft=[{"weight": 3, "value": 5}])
    expect(lambda x, y, z: 7, dirichlet=[{"value": 4}, {"value": 7}])
    report = solve(dirichlet=[BOTTOM], flux=[{"value": 1}])
    assert abs(report["conditions"][1]["area"] - 6 * SIDE ** 2) < 1e-9, report["conditions"]


def test_densities():
    expect(lambda x, y, z: 2, screening=2, source=[4])
    expect(lambda x, y, z: 2, screening=2, source=4)
    expect(lambda x, y, z: 2, screening="two", source="four")
    expect(lambda x, y, z: 2, screening=[{"value": 9}, {"tag": ["layer", 1], "value": 2},
                                         {"tag": ["layer", 2], "value": "two"},
                                         {"tag": ["bottom", 7], "value": 1}][:1] + [{"value": "two"}],
           source=[{"mask": "bottom", "value": [1]}, {"value": "four"}])
    expect(lambda x, y, z: (2, 5), columns=2,
           soft=[{"sphere": [0, 0, 0, 99], "weight": 3, "value": [2, 5]},
                 {"mask": "bottom", "weight": "four", "value": [2, 5]}])
    # A gradient field yields its function, with the mean of the initial guess.
    expect(lambda x, y, z: x + 2 * y + 3 * z - 6 * MIDDLE + 1, field="q", initial=[1])
    expect(lambda x, y, z: (x - MIDDLE, y - MIDDLE, z - MIDDLE), columns=3, conductivity="K",
           field="eye", mesh="fields.vsm")


def test_earlier_solves():
    solve(out="first.vsm", dirichlet=[BOTTOM, TOP], outputs=["gradient"])
    report = solve(mesh="first.vsm", out="second.vsm", tolerance=1e-6, initial="Solution",
                   dirichlet=[{"mask": "bottom", "value": "Solution"}, TOP])
    # Only rounding errors remain.
    assert report["vertices"] == len(POINTS) and report["mean"] and abs(report["mean"][0] - 0.5) < 1e-8
    run("info", "second.vsm", "--report", "info.json", "--quiet")
    columns = load("info.json")["columns"]
    assert [c["name"] for c in columns["vertices"]].count("Solution") == 1
    assert "Gradient" not in [c["name"] for c in columns["cells"]]
    report = solve(mesh="first.vsm", out="third.vsm", screening=1, source="Solution")
    assert abs(report["mean"][0] - 0.5) < 1e-8


def test_errors():
    # A conductivity alone has the solution 0, which is not a useful problem.
    error = solve(conductivity=2, code=1)
    assert "says nothing to solve for" in error, error
    error = solve(conductivity="c", dirichlet=[BOTTOM], code=1)
    assert "conductivity: the mesh has no column 'c'; its vertices have 'bottom', 'z'" in error, error
    assert "'K' (6)" in error, error
    tensors = [(4, 2, 1, 0, 0, 0)] * len(CELLS)
    tensors[17] = (1, 1, 1, 2, 0, 0)
    write_vtk("bad.vtk", K=tensors)
    error = solve(mesh="bad.vtk", conductivity="K", dirichlet=[BOTTOM], code=1)
    assert "conductivity: the column 'K' must be" in error and "cell 17 of the original mesh" in error
    error = solve(conductivity=1e30, dirichlet=[BOTTOM], code=1)
    assert "the weights of cell " in error and " of the original mesh are outside" in error, error
    for members, words in (
            ({"conductivity": [{"tag": ["layer", 3], "value": 1}], "source": [1]}, "conductivity[0]: no cell"),
            ({"dirichlet": [{"tag": ["layer", 3], "value": [0]}]}, "dirichlet[0]: no vertex"),
            ({"dirichlet": [{"mask": "q", "value": [0]}]}, "dirichlet[0].mask: the column 'q' has 3"),
            ({"initial": "k"}, "initial: 'k' is a column of the cells"),
            ({"field": "k"}, "field: the components of the column 'k' are 1, but must have 3"),
            ({"flux": [{"vertices": [0], "value": [1]}]}, "flux[0]: no face")):
        error = solve(code=1, **members)
        assert words in error, error


GOOD = [
    {"dirichlet": [{"value": 3}]}, {"soft": [{"weight": 1, "value": 2}]},
    {"source": 0, "initial": [{"value": 1}], "dirichlet": [{"mask": "bottom", "value": 2}]},
    {"weights": "raw-cotangent", "columns": 1, "source": [0], "screening": 0, "conductivity": 2},
    {"conductivity": [1, 1, 1, 0, 0, 0.5], "source": 1},
    {"conductivity": [{"value": 1}, {"tag": ["layer", 2], "value": "K"}], "initial": 1},
    {"columns": 3, "dirichlet": [{"mask": "bottom", "value": "position"}], "initial": "position"},
    {"robin": [{"sphere": [0, 0, 0, 2], "coefficient": 1, "ambient": [0]}], "outputs": []},
    {"soft": [{"nearest": [[0, 0, 0]], "weight": [{"value": 2}], "value": "four"}]},
    {"source": [{"value": [1]}, {"mask": "upper", "value": "two"}], "field": "q"}]
BAD = [
    [], {}, {"conductivity": 2, "screening": 1, "weights": "uniform"}, {"weight": "uniform"}, {"weights": "heat"}, {"columns": 0}, {"columns": 65}, {"source": True},
    {"screening": -1}, {"screening": [1]}, {"conductivity": []}, {"conductivity": ""}, {"field": [1, 0, 0]},
    {"conductivity": 0}, {"conductivity": [1, 1, 1]}, {"conductivity": [{"tag": ["layer", 2]}]},
    {"dirichlet": [{"mask": "bottom"}]}, {"outputs": ["heat"]},
    {"dirichlet": [{"mask": "bottom", "box": [0, 0, 0, 1, 1, 1], "value": [0]}]},
    {"flux": [{"mask": "bottom", "value": [0], "ambient": [0]}]}, {"flux": {}},
    {"flux": [{"tag": ["layer"], "value": [0]}]}, {"flux": [{"nearest": [], "value": [0]}]},
    {"robin": [{"mask": "bottom", "ambient": [0]}]}, {"dirichlet": [{"vertices": [-1], "value": [0]}]},
    {"dirichlet": [{"sphere": [0, 0, 0, -1], "value": [0]}]},
    {"soft": [{"mask": "bottom", "weight": -1, "value": [0]}]}]


def test_schema():
    """The program accepts exactly what the schema accepts."""
    for example in GOOD:
        solve(tolerance=0.5, **example)
    for example in BAD:
        with open("problem.json", "w", encoding="utf-8") as file:
            json.dump(example, file)
        run("solve", "cube.vsm", "o.vsm", "--problem", "problem.json", code=1)
    try:
        from jsonschema import Draft202012Validator
    except ImportError:
        print("without python3-jsonschema, the schema itself is not looked at")
        return
    schema = load(os.path.join(os.environ["SMG_SOURCE_DIR"], "docs", "problem.schema.json"))
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    for example in GOOD:
        assert validator.is_valid(example), (example, list(validator.iter_errors(example)))
    for example in BAD:
        assert not validator.is_valid(example), example
    text = run("solve", "--help").stdout
    assert "problem.schema.json" in text
    assert all(key in text for key in schema["properties"]), text


write_vtk("cube.vtk")
run("convert", "cube.vtk", "cube.vsm", "--quiet")
# K applied to the unit vectors, a vector for each of three columns.
write_vtk("fields.vtk", eye=[(4, 0, 0, 0, 2, 0, 0, 0, 1)] * len(CELLS))
run("convert", "fields.vtk", "fields.vsm", "--quiet")
for each in (test_what_is_unknown, test_two_materials, test_where, test_boundary, test_everywhere, test_densities,
             test_earlier_solves, test_errors, test_schema):
    each()
    print("passed", each.__name__)
sys.exit(0)
