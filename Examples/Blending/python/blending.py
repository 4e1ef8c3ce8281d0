#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The light on the Stanford bunny, recorded in four scans of different brightness, becomes
seamless, out of core, in Python.

Scans of a real object have such columns in their file. Here NumPy computes them: the number of the
scan, and the light, to which each scan adds 32 more than the one before.

What this lesson shows:
 1. An array becomes a column of the vertices by assigning it to a name. It is not copied.
 2. `blend` removes the steps of the light between the scans and keeps its gradients inside them.

Run it:

    python3 blending.py ../../Data/bunny.smb bunny-blended.vsm

    34834 vertices: converged in 9 passes
      Light: the largest step between scans was 64.7098 and is 0.968176
"""

import sys

import streamingmultigrid as smg


def main():
    mesh = smg.open(sys.argv[1], memory="128MB")
    points = mesh.points
    mesh["Scan"] = 1.0 * (points[:, 0] > -0.02) + 2.0 * (points[:, 1] > 0.1)
    mesh["Light"] = 128.0 + 512.0 * points[:, 2] + 32.0 * mesh["Scan"]
    report = mesh.blend("Light", patch="Scan").save(sys.argv[2])
    print(
        f"{report.vertices} vertices: {'converged' if report.converged else 'not converged'} "
        f"in {report.passes} passes"
    )
    for seam in report.seams:
        print(
            f"  {seam['column']}: the largest step between scans was {seam['before']:g} and is "
            f"{seam['after']:g}"
        )


main()
