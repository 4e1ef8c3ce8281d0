# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of known shapes, as points (vertices, 3) and cells (cells, 3 or 4), at any refinement."""
import numpy as np


def square(n, graded=1.0):
    """The unit square of n x n cells, two triangles each; the lines of one side lie at t^graded."""
    t = np.linspace(0, 1, n + 1)
    x, y = np.meshgrid(t**graded, t, indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    b, c, d = a + n + 1, a + n + 2, a + 1
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def box(n):
    """The unit cube of n x n x n cells, six tetrahedra each, inner vertices moved off the grid."""
    t = np.linspace(0, 1, n + 1)
    grid = np.stack(np.meshgrid(t, t, t, indexing="ij"), axis=-1).reshape(-1, 3)
    bump = np.prod(np.sin(np.pi * grid), axis=1)  # smooth, so that refinements are similar
    points = grid + 0.1 * bump[:, None] * np.array([1.0, -0.7, 0.5])
    base = np.arange(n)
    first = (((base[:, None] * (n + 1) + base)[:, :, None]) * (n + 1) + base).ravel()
    corner = [first + (i >> 2) * (n + 1)**2 + (i >> 1 & 1) * (n + 1) + (i & 1) for i in range(8)]
    paths = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))
    return points, np.concatenate([np.stack([corner[i] for i in path], 1) for path in paths])


def half_cylinder(n, grading):
    """The half cylinder of radius 1 and height 1 around z, its lines at angles pi t^grading."""
    flat, cells = square(n, grading)
    angle = np.pi * flat[:, 0]
    return np.stack([np.cos(angle), np.sin(angle), flat[:, 1]], axis=1), cells


def welded(points, cells):
    """Merges points of equal coordinates, up to rounding."""
    _, first, number = np.unique(np.round(points, 9), axis=0, return_index=True,
                                 return_inverse=True)
    return points[first], number.reshape(-1)[cells]


def compacted(points, cells):
    """The mesh without isolated points."""
    used, number = np.unique(cells, return_inverse=True)
    return points[used], number.reshape(cells.shape)


def sphere(n):
    """The unit sphere: the faces of a cube of n x n cells each, moved outwards."""
    plane, triangles = square(n)
    u, v = np.tan((2 * plane[:, :2] - 1).T * np.pi / 4)  # cells of about the same size
    one = np.ones_like(u)
    sides = [np.stack(side, axis=1) for side in (
        (one, u, v), (-one, v, u), (v, one, u), (u, -one, v), (u, v, one), (v, u, -one))]
    points = np.concatenate([side / np.linalg.norm(side, axis=1)[:, None] for side in sides])
    return welded(points, np.concatenate([triangles + k * len(plane) for k in range(6)]))


def ball(n):
    """The unit ball: an octahedron of eight tetrahedra, each divided into n^3, with concentric
    shells moved onto spheres."""
    # Cubes divided along their diagonal divide the simplex 0 <= a <= b <= c <= n, too.
    cube, six = box(n)
    grid = np.round(n * np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"),
                                 axis=-1)).reshape(cube.shape)
    isInside = np.all(np.diff(grid, axis=1) >= 0, axis=1)
    simplex = six[isInside[six].all(axis=1)]
    octant = np.stack([grid[:, 2] - grid[:, 1], grid[:, 1] - grid[:, 0], grid[:, 0]], axis=1) / n
    signs = np.array([[i >> 2, i >> 1 & 1, i & 1] for i in range(8)]) * 2.0 - 1.0
    points, cells = welded(np.concatenate([octant * sign for sign in signs]),
                           np.concatenate([simplex + k * len(octant) for k in range(8)]))
    points, cells = compacted(points, cells)
    length = np.linalg.norm(points, axis=1)
    length[length == 0.0] = 1.0
    return points * (np.abs(points).sum(axis=1) / length)[:, None], cells
