# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, reference solutions and the program smg, for the scripts of this folder."""

import atexit
import importlib
import json
import os
import shutil
import subprocess
import sys
import tempfile

SOURCE = os.environ["SMG_SOURCE_DIR"]
BUNNY = os.path.join(SOURCE, "Examples", "Data", "bunny.smb")
SINK = os.path.join(SOURCE, "Examples", "Data", "heat_sink.msh")

# Each run begins with an empty folder.
_FOLDER = tempfile.mkdtemp(dir=".")
atexit.register(shutil.rmtree, os.path.abspath(_FOLDER), True)
os.chdir(_FOLDER)


def need(*modules):
    """Ends the script as skipped where a module is missing."""
    for module in modules:
        try:
            importlib.import_module(module)
        except ImportError:
            print("SKIPPED: the module %s is not installed" % module)
            sys.exit(77)


need("numpy")
import numpy as np  # noqa: E402

import streamingmultigrid as smg  # noqa: E402


def run(*arguments):
    """Runs smg, quietly."""
    command = [os.environ["SMG_PROGRAM"], *map(str, arguments), "--quiet"]
    if arguments[0] not in ("info", "simplify"):
        command.append("--no-sync")
    subprocess.run(command, check=True, timeout=1000)


def write_json(name, value):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(value, file)
    return name


def sphere(splits=4):
    """The unit sphere as an icosahedron whose triangles are split: points (n, 3), triangles (m, 3)."""
    g = (1 + 5**0.5) / 2
    points = np.array([(0, a, b * g) for a in (-1, 1) for b in (-1, 1)])
    points = np.concatenate([np.roll(points, k, axis=1) for k in range(3)])
    distances = np.linalg.norm(points[:, None] - points[None], axis=2)
    near = distances < 2.1
    triangles = [
        (i, j, k)
        for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
        if near[i, j] and near[j, k] and near[i, k]
    ]  # fmt: skip
    triangles = np.array(triangles)
    for _ in range(splits):
        edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, inverse = np.unique(edges, axis=0, return_inverse=True)
        middle = inverse.reshape(-1, 3) + len(points)
        points = np.concatenate([points, points[edges].sum(axis=1) / 2])
        a, b, c = triangles.T
        ab, bc, ca = middle.T
        triangles = np.stack(
            [a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1
        ).reshape(-1, 3)
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    corners = points[triangles]
    inside = np.einsum(
        "ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), corners[:, 0]
    )
    triangles[inside < 0] = triangles[inside < 0][:, ::-1]
    return points, triangles


def cube(n=6):
    """The unit cube in tetrahedra, six in each of n^3 cubes: points, cells (m, 4)."""
    k = np.arange(n + 1)
    points = np.stack(np.meshgrid(k, k, k, indexing="ij"), axis=-1).reshape(-1, 3) / n
    corner = np.stack(np.meshgrid(k[:-1], k[:-1], k[:-1], indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.array([(n + 1) ** 2, n + 1, 1])
    steps = np.eye(3, dtype=int)
    cells = []
    for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
        path = np.cumsum([np.zeros(3, int), *(steps[axis] for axis in order)], axis=0)
        tetrahedron = (corner[:, None] + path[None]) @ number
        if order in ((0, 2, 1), (2, 1, 0), (1, 0, 2)):  # an odd order turns it over
            tetrahedron = tetrahedron[:, [0, 1, 3, 2]]
        cells.append(tetrahedron)
    return points, np.concatenate(cells)


def stiffness_and_mass(points, triangles):
    """Linear elements on a surface: the sparse stiffness and the lumped mass (n,)."""
    from scipy.sparse import coo_matrix

    n = len(points)
    stiffness = coo_matrix((n, n)).tocsr()
    corners = points[triangles]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    for k in range(3):
        i, j = triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
        a, b = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        weight = np.einsum("ij,ij->i", a, b) / (4 * areas)
        values = np.concatenate([-weight, -weight, weight, weight])
        rows = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
        stiffness = stiffness + coo_matrix((values, rows), (n, n)).tocsr()
    mass = np.bincount(triangles.ravel(), np.repeat(areas / 3, 3), n)
    return stiffness, mass


def write_off(name, points, cells):
    """A surface as an OFF file, whose numbers are those of the arrays to the last bit."""
    with open(name, "w", encoding="utf-8") as file:
        file.write("OFF\n%d %d 0\n" % (len(points), len(cells)))
        file.writelines("%r %r %r\n" % tuple(map(float, point)) for point in points)
        file.writelines("3 %d %d %d\n" % tuple(cell) for cell in cells)
    return name


def file_result(name, column):
    """A column of a file that smg has written, in the original order."""
    with smg.open(name) as mesh:
        return mesh.read(column)


def bits(values):
    return np.ascontiguousarray(values).tobytes()
