# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with all special cases of a conversion, for the scripts of this folder."""

import random

from mesh_files import rounded
from tetrahedra import tetrahedra
from torus import torus


def odd_surface(nu=40, nv=20, largest=6):
    """A torus with a hole, in random order: triangles, quadrangles, polygons of up to `largest` corners,
    duplicate cells, cells without area, and isolated points."""
    chance = random.Random(nu)
    points, quadrangles = torus(nu, nv)
    cells = []
    for i, (a, b, c, d) in enumerate(quadrangles[:-4]):
        middle = tuple(sum(points[k][x] for k in (a, b)) / 2 for x in range(3))
        if i % 4 == 0:
            cells += [(a, b, c), (a, c, d)]
        elif i % 4 == 1 and largest >= 5:
            points.append(middle)
            cells.append((a, len(points) - 1, b, c, d))
        elif i % 4 == 2 and largest >= 6:
            points += [middle, tuple(x + 1e-3 for x in middle)]
            cells.append((a, len(points) - 2, len(points) - 1, b, c, d))
        else:
            cells.append((a, b, c, d))
    cells += cells[5:8] + [(3, 4, 3), (7, 7, 7)]
    for k in range(9):
        points.append((k, -k, 0.1))
    return shuffled(points, cells, chance)


def odd_solid(n=6):
    """A cube of tetrahedra in random order, one of them duplicate, with isolated points."""
    chance = random.Random(n)
    points, cells = tetrahedra(n)
    points = [tuple(x + chance.random() / 4 for x in point) for point in points]
    points += [(k, -k, 0.1) for k in range(9)]
    return shuffled(points, cells + cells[7:8], chance)


def shuffled(points, cells, chance):
    """The mesh in random order, with random last digits of the points in single precision."""
    order = list(range(len(points)))
    chance.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    cells = [tuple(place[corner] for corner in cell) for cell in cells]
    chance.shuffle(cells)
    return rounded([points[old] for old in order]), cells


def fans(cells):
    """The polygons as triangles."""
    return [(cell[0], cell[k], cell[k + 1]) for cell in cells for k in range(1, len(cell) - 1)]


def area_of(triangles):
    """The sum of the areas of triangles of points, as vectors: that of a polygon, however it is cut."""
    total = [0.0, 0.0, 0.0]
    for a, b, c in triangles:
        e, f = ([p - q for p, q in zip(other, a)] for other in (b, c))
        for k in range(3):
            total[k] += (e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3]) / 2
    return total


def are_triangles_of(cells, points, corners):
    """Whether the corners are those of the triangles into which the polygons are cut, one after the other:
    points of each polygon, which together have its area."""
    if len(corners) != 3 * len(fans(cells)):
        return False
    begin = 0
    for cell in cells:
        triangles = corners[begin:begin + 3 * (len(cell) - 2)]
        begin += len(triangles)
        found = area_of(zip(triangles[0::3], triangles[1::3], triangles[2::3]))
        expected = area_of([points[k] for k in triangle] for triangle in fans([cell]))
        size = max(map(abs, expected)) + 1e-12
        if not {points[k] for k in cell} >= set(triangles) or any(
                abs(a - b) > 1e-5 * size for a, b in zip(found, expected)):
            return False
    return True
