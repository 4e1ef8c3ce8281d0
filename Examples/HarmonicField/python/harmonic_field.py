#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A harmonic field on the Stanford bunny, out of core, in Python.

The field is 0 at the feet and 1 at the tips of the ears; in between it is harmonic: each value is
the weighted mean of its neighbours, like the temperature of a thin shell whose ends are kept at two
temperatures.

What this lesson shows:
 1. A mesh of any format is opened with a memory limit. It stays on disk.
 2. A problem is a call with conditions: a region, and the value there.
 3. The field is on disk, too. It comes block after block, with the points and triangles of the
    block, so that a mesh of any size passes through a loop; NumPy finds the isolines in each.

Run it:

    python3 harmonic_field.py ../../Data/bunny.smb isolines.obj

    34834 vertices, 69451 cells: converged after 6 cycles, relative residual 7.4e-09
    isolines.obj: 7379 segments of 23 isolines
"""

import sys

import numpy as np

import streamingmultigrid as smg

FEET, EARS = 0.036, 0.18  # metres above the ground; y points up
BANDS = 24


def segments(points, values):
    """The segments (m, 2, 3) in which the isolines cut triangles, of whose corners these are the
    points (n, 3, 3) and values (n, 3)."""
    found = []
    for level in np.arange(1, BANDS) / BANDS:
        below = values < level
        crossed = below.any(axis=1) & ~below.all(axis=1)
        a, b = points[crossed], np.roll(points[crossed], -1, axis=1)  # the edges of the triangles
        from_, to = values[crossed], np.roll(values[crossed], -1, axis=1)
        cut = (from_ < level) != (to < level)  # two edges of each triangle
        share = ((level - from_[cut]) / (to[cut] - from_[cut]))[:, None]
        found.append((a[cut] + share * (b[cut] - a[cut])).reshape(-1, 2, 3))
    return np.concatenate(found)


def main():
    mesh = smg.open(sys.argv[1], memory="64MB")
    field = mesh.solve(dirichlet=[smg.below(y=FEET) >> 0.0, smg.above(y=EARS) >> 1.0])
    report = field.report
    print(
        f"{report.vertices} vertices, {report.cells} cells: "
        f"{'converged' if report.converged else 'not converged'} after {report.cycles} cycles, "
        f"relative residual {report.residuals[-1] if report.residuals else 0:.2g}"
    )
    total = 0
    with open(sys.argv[2], "w", encoding="ascii") as out:
        for block in field.blocks(max_points=20_000):
            corners = block.cells
            lines = segments(block.points[corners], block["Solution"][corners])
            for point in lines.reshape(-1, 3):
                out.write("v %.9g %.9g %.9g\n" % tuple(point))
            for first in range(2 * total + 1, 2 * (total + len(lines)) + 1, 2):
                out.write(f"l {first} {first + 1}\n")
            total += len(lines)
    print(f"{sys.argv[2]}: {total} segments of {BANDS - 1} isolines")


main()
