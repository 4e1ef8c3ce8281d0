#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Groups of meshes that meshio writes, and that it reads from what smg writes: an independent reader and writer.

Skipped where the system's Python has no meshio."""

import collections
import os
import subprocess
import sys

SYSTEM = "/usr/bin/python3"

# A cube of 2^3 cells of six tetrahedra each, whose lower half is material 1 and whose upper half is 2; its bottom is
# condition 11, its top 12.
WRITE = """
import itertools, sys
import numpy as np, meshio
n = 2
number = lambda x, y, z: (x * (n + 1) + y) * (n + 1) + z
points = np.array(list(itertools.product(range(n + 1), repeat=3)), float)
cells, materials, faces, conditions = [], [], [], []
for corner in itertools.product(range(n), repeat=3):
    for axes in itertools.permutations(range(3)):
        path, at = [], list(corner)
        for axis in (None, *axes):
            if axis is not None:
                at[axis] += 1
            path.append(number(*at))
        odd = axes in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
        cells.append([path[1], path[0], *path[2:]] if odd else path)
        materials.append(1 + corner[2])
for x, y in itertools.product(range(n), repeat=2):
    for z, condition in ((0, 11), (n, 12)):
        a, b, c, d = number(x, y, z), number(x + 1, y, z), number(x + 1, y + 1, z), number(x, y + 1, z)
        faces += [[a, b, c], [a, c, d]]
        conditions += [condition] * 2
name, key = sys.argv[1:]
data = {key: [np.array(conditions), np.array(materials)]}
meshio.write(name, meshio.Mesh(points, [("triangle", np.array(faces)), ("tetra", np.array(cells))], cell_data=data))
"""
READ = """
import sys
import meshio
mesh = meshio.read(sys.argv[1])
for block, labels in zip(mesh.cells, mesh.cell_data[sys.argv[2]]):
    print(*("%s:%d" % (block.type, label) for label in labels))
"""
WRITTEN = (("vtu", "gmsh:physical"), ("vtk", "gmsh:physical"), ("mesh", "medit:ref"), ("meshb", "medit:ref"),
           ("vol", "netgen:index"), ("bdf", "nastran:ref"))
READ_BACK = (("msh", "gmsh:physical"), ("mesh", "medit:ref"))
EXPECTED = {"triangle:11": 8, "triangle:12": 8, "tetra:1": 24, "tetra:2": 24}


def meshio(script, *arguments):
    return subprocess.run([SYSTEM, "-c", script, *arguments], check=True, capture_output=True, text=True).stdout


def main():
    if not os.path.exists(SYSTEM) or subprocess.run([SYSTEM, "-c", "import meshio"], capture_output=True).returncode:
        sys.exit(77)
    from program import run
    for suffix, key in WRITTEN:
        meshio(WRITE, "in." + suffix, key)
        run("convert", "in." + suffix, "mesh.vsm")
        for out, label in READ_BACK:
            run("convert", "mesh.vsm", "out." + out)
            read = collections.Counter(meshio(READ, "out." + out, label).split())
            del read["vertex:1"]  # all vertices: meshio gives each a reference in files of Medit
            assert read == EXPECTED, (suffix, out, read)


if __name__ == "__main__":
    main()
