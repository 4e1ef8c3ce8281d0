#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The distance of all points of the Stanford bunny from the tip of an ear, along the surface, out
of core, in Python.

What this lesson shows:
 1. Sources are regions: here the vertex nearest to a point.
 2. The distances are on disk; NumPy gets the whole array when it asks for it.

Run it:

    python3 distances.py ../../Data/bunny.smb bunny-distance.vsm

    34834 vertices: settled in 1 pass
      the largest distance is 0.237836 m, the mean 0.142573 m
"""

import sys

import streamingmultigrid as smg


def main():
    mesh = smg.open(sys.argv[1], memory="128MB")
    field = mesh.distance(smg.nearest([-0.0175, 0.187, -0.02]))
    report = field.save(sys.argv[2])
    print(
        f"{report.vertices} vertices: {'settled' if report.converged else 'not settled'} "
        f"in {report.passes} {'pass' if report.passes == 1 else 'passes'}"
    )
    distance = field.to_numpy()
    print(f"  the largest distance is {distance.max():g} m, the mean {distance.mean():g} m")


main()
