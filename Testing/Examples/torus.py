# SPDX-License-Identifier: BSD-3-Clause
"""A torus of nu x nv vertices and as many quadrangles, for the scripts of this folder."""

import math


def torus(nu, nv):
    """The points, and the quadrangles as vertex numbers from 0."""
    points, quadrangles = [], []
    for i in range(nu):
        for k in range(nv):
            u, v = 2 * math.pi * i / nu, 2 * math.pi * k / nv
            r = 2 + math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), math.sin(v)))
            i1, k1 = (i + 1) % nu, (k + 1) % nv
            quadrangles.append(tuple(p * nv + q for p, q in ((i, k), (i1, k), (i1, k1), (i, k1))))
    return points, quadrangles
