#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Stanford bunny turns its head, out of core, in Python.

Its base is fixed, its head turned by 70 degrees and scaled by 1.3, an ear turned by 90 degrees; the
rest of the mesh follows and keeps its details. The same from the command line, with the handles in
a file:

    smg deform ../../Data/bunny.smb bunny-deformed.vsm --handles ../bunny.json

What this lesson shows:
 1. A handle is a region with its motion. The base is held where it is.
 2. Of the positions on disk only what NumPy is to look at is read: here block after block.
 3. Saving writes the deformed mesh, in the format of the suffix.

Run it:

    python3 deformation.py ../../Data/bunny.smb bunny-deformed.vsm

    34834 vertices, 69451 cells: converged in 11 passes
    points move by up to 125 mm
"""

import sys

import numpy as np

import streamingmultigrid as smg

HANDLES = [
    # Lengths are in metres; y points up.
    smg.handle(smg.below(y=0.05), fixed=True),
    smg.handle(  # the head
        smg.sphere([-0.068, 0.134, 0.027], 0.034),
        rotate=([0, 1, 0], 70),
        center=[-0.065, 0.11, 0.01],
        scale=1.3,
        translate=[-0.015, 0.012, 0.01],
    ),
    smg.handle(  # an ear
        smg.sphere([-0.068, 0.175, -0.055], 0.025),
        rotate=([-0.4, 0.8, 0.45], 90),
        center=[-0.065, 0.152, -0.008],
        scale=1.3,
        translate=[-0.037, 0.025, 0.02],
    ),
]


def main():
    mesh = smg.open(sys.argv[1], memory="128MB")
    bunny = mesh.deform(HANDLES)
    report = bunny.save(sys.argv[2])
    print(
        f"{report.vertices} vertices, {report.cells} cells: "
        f"{'converged' if report.converged else 'not converged'} in {report.passes} passes"
    )
    farthest = 0.0
    for rest, moved in zip(mesh.blocks(), bunny.blocks()):
        farthest = max(farthest, np.linalg.norm(moved.points - rest.points, axis=1).max())
    print(f"points move by up to {1000 * farthest:.0f} mm")


main()
