#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""distance_regions.py : approximate distances from curves and regions of a square, against exact ones.

Prints a table in Markdown. The square has 10,201 vertices, of which the inner ones are moved by up to a fifth of an edge. Needs the
package streamingmultigrid on PYTHONPATH.
"""
import numpy as np
import streamingmultigrid as smg

SIDE = 100  # edges of the grid


def square():
    """Points and triangles; the diagonals alternate."""
    grid = np.arange(SIDE + 1) / SIDE
    points = np.array([[x, y, 0.0] for y in grid for x in grid])
    inner = ((points[:, :2] > 0) & (points[:, :2] < 1)).all(axis=1)
    points[inner, :2] += np.random.default_rng(5).uniform(-0.2 / SIDE, 0.2 / SIDE, (inner.sum(), 2))
    triangles = []
    for row in range(SIDE):
        for column in range(SIDE):
            a = row * (SIDE + 1) + column
            b, c, d = a + 1, a + SIDE + 1, a + SIDE + 2
            triangles += [[a, b, d], [a, d, c]] if (row + column) % 2 == 0 else [[a, b, c], [b, d, c]]
    return points, np.array(triangles)


def main():
    points, triangles = square()
    x, y = points[:, 0], points[:, 1]
    bottom, left = (y == 0) & (x <= 0.5), (x == 0) & (y <= 0.5)
    middle = SIDE // 2 * (SIDE + 2)
    sources = {
        "one of its edges": y == 0,
        "half of an edge": bottom,
        "halves of two edges that meet": bottom | left,
        "two neighbours in the middle": np.isin(np.arange(len(points)), [middle, middle + 1]),
        "all vertices of a disc of radius 0.2, whose boundary is jagged": np.hypot(x - 0.5, y - 0.5) <= 0.2,
    }
    print("| source | mean error | longer by | shorter by |\n|---|---|---|---|")
    for name, source in sources.items():
        exact, found = (np.asarray(smg.distance(points, triangles, source, accuracy=accuracy))
                        for accuracy in ("exact", "approximate"))
        far = exact > 0
        mean = np.mean(np.abs(found - exact)[far] / exact[far])
        edges = (found - exact) * SIDE
        print(f"| {name} | {100 * mean:.2f} % | {edges.max():.2f} edges | {abs(edges.min()):.2f} edges |")


if __name__ == "__main__":
    main()
