# SPDX-License-Identifier: BSD-3-Clause
"""A cube of n x n x n vertices, six tetrahedra per unit cube, for the scripts of this folder."""


def tetrahedra(n):
    """The points, and the tetrahedra as vertex numbers from 0."""
    points = [(x, y, z) for x in range(n) for y in range(n) for z in range(n)]
    cells = []
    for x in range(n - 1):
        for y in range(n - 1):
            for z in range(n - 1):
                corner = [((x + (i >> 2)) * n + y + (i >> 1 & 1)) * n + z + (i & 1)
                          for i in range(8)]
                cells += [tuple(corner[i] for i in tet) for tet in (
                    (0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7),
                    (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))]
    return points, cells
