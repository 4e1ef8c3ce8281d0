# SPDX-License-Identifier: BSD-3-Clause
"""A torus of any size, written as a binary PLY file with vertices and triangles in no useful order."""

import math
import struct


def coprime(near, count):
    """A number from `near` on without a common factor with `count`."""
    while math.gcd(near, count) != 1:
        near += 1
    return near


def write_large_torus(name, nu, nv):
    """nu x nv vertices and twice as many triangles; takes the memory of a few thousand of them."""
    vertices, cells = nu * nv, 2 * nu * nv
    # Row r of the file has vertex r * step modulo the number of vertices; likewise the cells.
    step = coprime(int(0.618 * vertices), vertices)
    back, cell_step = pow(step, -1, vertices), coprime(int(0.382 * cells), cells)
    circle = [(math.cos(2 * math.pi * i / nu), math.sin(2 * math.pi * i / nu)) for i in range(nu)]
    tube = [(2 + math.cos(2 * math.pi * k / nv), math.sin(2 * math.pi * k / nv)) for k in range(nv)]

    def point(row):
        (x, y), (r, z) = circle[(row * step % vertices) // nv], tube[(row * step % vertices) % nv]
        return r * x, r * y, z

    def corners(row):
        quadrangle, half = divmod(row * cell_step % cells, 2)
        i, k = divmod(quadrangle, nv)
        i1, k1 = (i + 1) % nu, (k + 1) % nv
        places = (i * nv + k, i1 * nv + k1, i * nv + k1) if half else (
            i * nv + k, i1 * nv + k, i1 * nv + k1)
        return 3, *(place * back % vertices for place in places)

    with open(name, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n"
                    "property float x\nproperty float y\nproperty float z\n"
                    f"element face {cells}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        for count, row_of, pack in ((vertices, point, struct.Struct("<3f").pack),
                                    (cells, corners, struct.Struct("<B3i").pack)):
            for first in range(0, count, 4096):
                file.write(b"".join(pack(*row_of(row))
                                    for row in range(first, min(first + 4096, count))))
