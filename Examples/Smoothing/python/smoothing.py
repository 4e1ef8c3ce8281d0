#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Stanford bunny becomes smooth except for its head, out of core, in Python.

The fur is a detail of a few millimetres: two implicit steps halve waves of 1 cm. The head is held.

What this lesson shows:
 1. What a job costs is known before it starts.
 2. A part of the mesh is a region, or a mask: an array of booleans, one a vertex.
 3. Saving writes the mesh with the smoothed points, and returns the report.

Run it:

    python3 smoothing.py ../../Data/bunny.smb bunny-smooth.vsm

    34834 vertices: converged in 18 passes
"""

import sys

import streamingmultigrid as smg

HEAD = smg.sphere([-0.07, 0.14, 0.01], 0.04)  # metres


def main():
    mesh = smg.open(sys.argv[1], memory="128MB")
    print(mesh.estimate("smooth", size=0.01, steps=2, hold=HEAD), file=sys.stderr)
    smooth = mesh.smooth(size=0.01, steps=2, hold=HEAD)
    report = smooth.save(sys.argv[2])
    print(
        f"{report.vertices} vertices: {'converged' if report.converged else 'not converged'} "
        f"in {report.passes} passes"
    )


main()
