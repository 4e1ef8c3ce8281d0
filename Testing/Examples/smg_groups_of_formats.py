#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A problem stated by names, on one body in files of several formats: the same solution, and that of a direct solve
that knows neither names nor formats.

Written by this script: Gmsh 2.2 and 4.1, Medit, Abaqus, Netgen, Nastran, and a .vtu with the labels of meshio. Skipped
where the system's Python has no SciPy."""

import itertools
import json
import os
import subprocess
import sys

SYSTEM = "/usr/bin/python3"

N = 5
SIDE = N - 1
NUMBERS = {"core": 1, "shell": 2, "cold": 11, "hot": 12, "film": 13}
CONDUCTIVITY = {"core": 4.0, "shell": 1.0}
SOURCE, COLD, HOT, COEFFICIENT, FILM = 1.5, 2.0, 7.0, 0.5, 3.0


def body():
    """A box of tetrahedra: points, cells with their materials, and faces in groups. The film lies between cells."""
    def number(x, y, z):
        return (x * N + y) * N + z

    points = [(x + 0.125 * (x % 3) * y / SIDE, float(y), 1.5 * z) for x, y, z in itertools.product(range(N), repeat=3)]
    cells, materials = [], []
    for corner in itertools.product(range(SIDE), repeat=3):
        for axes in itertools.permutations(range(3)):
            path, place = [number(*corner)], list(corner)
            for axis in axes:
                place[axis] += 1
                path.append(number(*place))
            odd = axes in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
            cells.append([path[1], path[0], *path[2:]] if odd else path)
            materials.append("core" if corner[2] >= 2 else "shell")
    levels = {0: "cold", SIDE: "hot", 2: "film"}
    faces = {}
    for cell in cells:
        for left_out in range(4):
            face = tuple(v for k, v in enumerate(cell) if k != left_out)
            z = {v % N for v in face}
            if len(z) == 1 and min(z) in levels:
                faces.setdefault(tuple(sorted(face)), (face, levels[min(z)]))
    return points, cells, materials, [face for face, _ in faces.values()], [name for _, name in faces.values()]


POINTS, CELLS, MATERIALS, FACES, CONDITIONS = body()


# The writers: each of the points, the cells with the numbers of their materials, the faces with those of their groups.


def gmsh_names():
    names = "".join("%d %d \"%s\"\n" % (2 if number > 10 else 3, number, name) for name, number in NUMBERS.items())
    return "$PhysicalNames\n%d\n%s$EndPhysicalNames\n" % (len(NUMBERS), names)


def gmsh2():
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + gmsh_names() + "$Nodes\n%d\n" % len(POINTS)
    text += "".join("%d %r %r %r\n" % (v + 1, *point) for v, point in enumerate(POINTS)) + "$EndNodes\n"
    elements = [(2, NUMBERS[name], face) for name, face in zip(CONDITIONS, FACES)]
    elements += [(4, NUMBERS[name], cell) for name, cell in zip(MATERIALS, CELLS)]
    text += "$Elements\n%d\n" % len(elements)
    for k, (kind, label, corners) in enumerate(elements):
        text += "%d %d 2 %d 1 %s\n" % (k + 1, kind, label, " ".join(str(v + 1) for v in corners))
    return text + "$EndElements\n"


def gmsh4():
    """An entity for each group."""
    text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + gmsh_names()
    surfaces = [name for name, number in NUMBERS.items() if number > 10]
    volumes = [name for name, number in NUMBERS.items() if number <= 10]
    text += "$Entities\n0 0 %d %d\n" % (len(surfaces), len(volumes))
    for name in (*surfaces, *volumes):
        text += "%d 0 0 0 9 9 9 1 %d 0\n" % (NUMBERS[name], NUMBERS[name])
    text += "$EndEntities\n$Nodes\n1 %d 1 %d\n3 1 0 %d\n" % (len(POINTS), len(POINTS), len(POINTS))
    text += "".join("%d\n" % (v + 1) for v in range(len(POINTS)))
    text += "".join("%r %r %r\n" % point for point in POINTS) + "$EndNodes\n"
    count = len(FACES) + len(CELLS)
    text += "$Elements\n%d %d 1 %d\n" % (len(NUMBERS), count, count)
    tag = 0
    for dimension, kind, names, entities, labels in ((2, 2, surfaces, FACES, CONDITIONS),
                                                     (3, 4, volumes, CELLS, MATERIALS)):
        for name in names:
            those = [corners for corners, label in zip(entities, labels) if label == name]
            text += "%d %d %d %d\n" % (dimension, NUMBERS[name], kind, len(those))
            for corners in those:
                tag += 1
                text += "%d %s\n" % (tag, " ".join(str(v + 1) for v in corners))
    return text + "$EndElements\n"


def medit():
    text = "MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(POINTS)
    text += "".join("%r %r %r 0\n" % point for point in POINTS)
    for title, entities, labels in (("Triangles", FACES, CONDITIONS), ("Tetrahedra", CELLS, MATERIALS)):
        text += "%s\n%d\n" % (title, len(entities))
        text += "".join("%s %d\n" % (" ".join(str(v + 1) for v in corners), NUMBERS[label])
                        for corners, label in zip(entities, labels))
    return text + "End\n"


def abaqus():
    """Sets of elements, and surfaces of their sides."""
    text = "*NODE\n" + "".join("%d, %r, %r, %r\n" % (v + 1, *point) for v, point in enumerate(POINTS))
    text += "*ELEMENT, TYPE=C3D4\n"
    text += "".join("%d, %d, %d, %d, %d\n" % (c + 1, *(v + 1 for v in cell)) for c, cell in enumerate(CELLS))
    for name in ("core", "shell"):
        text += "*ELSET, ELSET=%s\n" % name
        text += "".join("%d,\n" % (c + 1) for c, label in enumerate(MATERIALS) if label == name)
    sides = {}
    for c, cell in enumerate(CELLS):
        # S1: 1 2 3, S2: 1 4 2, S3: 2 4 3, S4: 3 4 1
        for side, left_out in ((1, 3), (2, 2), (3, 0), (4, 1)):
            sides.setdefault(tuple(sorted(v for k, v in enumerate(cell) if k != left_out)), (c, side))
    for name in ("cold", "hot", "film"):
        text += "*SURFACE, NAME=%s, TYPE=ELEMENT\n" % name
        for face, label in zip(FACES, CONDITIONS):
            if label == name:
                text += "%d, S%d\n" % (sides[tuple(sorted(face))][0] + 1, sides[tuple(sorted(face))][1])
    return text


def netgen():
    text = "mesh3d\ndimension\n3\ngeomtype\n0\n\nsurfaceelements\n%d\n" % len(FACES)
    text += "".join("%d %d 1 0 3 %d %d %d\n" % (NUMBERS[label] - 10, NUMBERS[label] - 10, *(v + 1 for v in face))
                    for face, label in zip(FACES, CONDITIONS))
    text += "\nvolumeelements\n%d\n" % len(CELLS)
    text += "".join("%d 4 %d %d %d %d\n" % (NUMBERS[label], *(v + 1 for v in cell))
                    for cell, label in zip(CELLS, MATERIALS))
    text += "\npoints\n%d\n" % len(POINTS) + "".join("%r %r %r\n" % point for point in POINTS)
    text += "\nmaterials\n2\n1 core\n2 shell\n\nbcnames\n3\n1 cold\n2 hot\n3 film\n\nendmesh\n"
    return text


def nastran():
    text = "BEGIN BULK\n"
    for v, point in enumerate(POINTS):
        text += "GRID*,%d,,%r,%r\n*,%r\n" % (v + 1, *point)
    for c, (cell, label) in enumerate(zip(CELLS, MATERIALS)):
        text += "CTETRA,%d,%d,%d,%d,%d,%d\n" % (c + 1, NUMBERS[label], *(v + 1 for v in cell))
    for f, (face, label) in enumerate(zip(FACES, CONDITIONS)):
        text += "CTRIA3,%d,%d,%d,%d,%d\n" % (len(CELLS) + f + 1, NUMBERS[label], *(v + 1 for v in face))
    return text + "ENDDATA\n"


def vtu():
    """As meshio writes it: triangles and tetrahedra with a column of labels."""
    def array(kind, name, numbers, more=""):
        return '<DataArray type="%s" Name="%s" format="ascii"%s>%s</DataArray>\n' % (
            kind, name, more, " ".join(repr(number) for number in numbers))

    entities = [*FACES, *CELLS]
    ends = list(itertools.accumulate(map(len, entities)))
    text = '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n'
    text += '<UnstructuredGrid>\n<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<Points>\n' % (
        len(POINTS), len(entities))
    text += array("Float64", "Points", itertools.chain(*POINTS), ' NumberOfComponents="3"') + "</Points>\n<Cells>\n"
    text += array("Int64", "connectivity", itertools.chain(*entities)) + array("Int64", "offsets", ends)
    text += array("Int64", "types", [5 if len(e) == 3 else 10 for e in entities]) + "</Cells>\n<CellData>\n"
    text += array("Int64", "gmsh:physical", [NUMBERS[label] for label in (*CONDITIONS, *MATERIALS)])
    return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"


#: Format: the text of its file, and what it calls a group: formats without names know numbers.
FORMATS = {"2.msh": (gmsh2, str), "4.msh": (gmsh4, str), "b.mesh": (medit, NUMBERS.get), "b.inp": (abaqus, str),
           "b.vol": (netgen, str), "b.bdf": (nastran, NUMBERS.get), "b.vtu": (vtu, NUMBERS.get)}


def problem(named):
    return {
        "conductivity": [{"group": named(name), "value": value} for name, value in CONDUCTIVITY.items()],
        "source": [{"group": named("core"), "value": SOURCE}],
        "dirichlet": [{"group": named("cold"), "value": COLD}],
        "robin": [{"group": named("hot"), "coefficient": COEFFICIENT, "ambient": HOT}],
        "flux": [{"group": named("film"), "value": FILM}],
        "integrals": [named("core"), named("shell")],
    }


# The direct solve, in the system's Python: its output is the solution, and the flows through the conditions.
DIRECT = """
import json, sys
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
given = json.load(open(sys.argv[1]))
points, cells = np.array(given["points"]), np.array(given["cells"])
k = np.array([given["conductivity"][name] for name in given["materials"]])
edges = points[cells[:, 1:]] - points[cells[:, :1]]
volume = np.abs(np.linalg.det(edges)) / 6
slopes = np.linalg.inv(edges).transpose(0, 2, 1)
slopes = np.concatenate([-slopes.sum(1, keepdims=True), slopes], axis=1)
local = k[:, None, None] * volume[:, None, None] * slopes @ slopes.transpose(0, 2, 1)
n = len(points)
rows, columns = np.repeat(cells, 4, axis=1).ravel(), np.tile(cells, (1, 4)).ravel()
matrix = coo_matrix((local.ravel(), (rows, columns)), (n, n)).tocsr()
load, transfer = np.zeros(n), np.zeros(n)
core = np.array(given["materials"]) == "core"
np.add.at(load, cells[core], given["source"] * volume[core, None] / 4)
held = np.zeros(n, bool)
area = {}
for face, name in zip(given["faces"], given["conditions"]):
    a, b, c = points[face]
    own = np.linalg.norm(np.cross(b - a, c - a)) / 2
    area[name] = area.get(name, 0) + own
    if name == "cold":
        held[face] = True
    elif name == "hot":
        transfer[face] += given["coefficient"] * own / 3
        load[face] += given["coefficient"] * given["hot"] * own / 3
    else:
        load[face] += given["film"] * own / 3
full = matrix + coo_matrix((transfer, (range(n), range(n))), (n, n)).tocsr()
u = np.full(n, given["cold"])
free = ~held
u[free] = spsolve(full[free][:, free].tocsc(), load[free] - full[free][:, held] @ u[held])
means = u[cells].mean(1) * volume
json.dump({"u": u.tolist(), "area": area,
           "flux": {"cold": float((full @ u - load)[held].sum()), "film": given["film"] * area["film"],
                    "hot": float((transfer * (given["hot"] - u)).sum())},
           "integral": {name: float(means[np.array(given["materials"]) == name].sum()) for name in ("core", "shell")},
           "measure": {name: float(volume[np.array(given["materials"]) == name].sum()) for name in ("core", "shell")}},
          sys.stdout)
"""


def direct():
    given = {"points": POINTS, "cells": CELLS, "materials": MATERIALS, "faces": FACES, "conditions": CONDITIONS,
             "conductivity": CONDUCTIVITY, "source": SOURCE, "cold": COLD, "hot": HOT, "coefficient": COEFFICIENT,
             "film": FILM}
    with open("direct.json", "w", encoding="utf-8") as file:
        json.dump(given, file)
    return json.loads(subprocess.run([SYSTEM, "-c", DIRECT, "direct.json"], check=True, capture_output=True,
                                     text=True).stdout)


def near(found, expected, accuracy=1e-7):
    return abs(found - expected) <= accuracy * max(1.0, abs(expected))


def main():
    if not os.path.exists(SYSTEM) or subprocess.run([SYSTEM, "-c", "import scipy"], capture_output=True).returncode:
        sys.exit(77)
    from program import load, read_vtk_xml, run
    exact = direct()
    at_point = {tuple("%.9f" % x for x in point): u for point, u in zip(POINTS, exact["u"])}
    solutions = []
    for name, (write, named) in FORMATS.items():
        with open(name, "w", encoding="utf-8") as file:
            file.write(write())
        with open("problem.json", "w", encoding="utf-8") as file:
            json.dump(problem(named), file)
        run("solve", name, "out.vtu", "--problem", "problem.json", "--report", "report.json", "--tolerance", 1e-13,
            "--quiet")
        report, arrays = load("report.json"), read_vtk_xml("out.vtu")
        values = {tuple("%.9f" % x for x in point): u for point, (u,) in zip(arrays["Points"], arrays["Solution"])}
        assert values.keys() == at_point.keys(), name
        solutions.append(values)
        for place, value in values.items():
            assert near(value, at_point[place]), (name, place, value, at_point[place])
            assert near(value, solutions[0][place], 1e-12), (name, place, value, solutions[0][place])
        for condition, group in zip(report["conditions"], ("cold", "film", "hot")):
            assert condition["name"].endswith("(%s)" % named(group)), (name, condition)
            assert near(condition["area"], exact["area"][group], 1e-12), (name, condition, exact["area"][group])
            assert near(condition["flux"][0], exact["flux"][group]), (name, condition, exact["flux"][group])
        for part, group in zip(report["integrals"], ("core", "shell")):
            assert part["name"] == str(named(group)), (name, part)
            assert near(part["measure"], exact["measure"][group], 1e-12), (name, part)
            assert near(part["integral"][0], exact["integral"][group]), (name, part, exact["integral"][group])


if __name__ == "__main__":
    main()
