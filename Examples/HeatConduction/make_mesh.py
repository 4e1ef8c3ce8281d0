#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Generates Examples/Data/heat_sink.vtk: a heat sink on a chip, tetrahedra in a legacy VTK file.

    python3 make_mesh.py ../Data/heat_sink.vtk

A chip of 14 x 14 x 2 mm, a plate of 34 x 34 x 4 mm on it, and five fins of 2 x 34 x 12 mm on the
plate. Cubes of 2 mm, six tetrahedra each; lengths are in metres, z points up. The cell column
`Material` is 1 in the chip and 2 in the plate and the fins.
"""

import itertools
import sys

SIDE = 17  # of the plate, in cubes
PLATE, FINS = 1, 3  # their first layers of cubes
LAYERS = 9


def material(x, y, z):
    """The material of a cube by its indices; 0: no cube."""
    if z < PLATE:
        return int(5 <= x < 12 and 5 <= y < 12)
    return 2 if z < FINS or x % 4 == 0 else 0


def tetrahedra(cube):
    """The six tetrahedra around the diagonal of a cube, each a path along its edges; they conform to
    those of the adjacent cubes. Every other path is a mirror image of the previous one."""
    for axes in itertools.permutations(range(3)):
        corner, path = list(cube), [tuple(cube)]
        for axis in axes:
            corner[axis] += 1
            path.append(tuple(corner))
        if axes in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):
            path[1], path[2] = path[2], path[1]
        yield path


def main():
    cells, materials = [], []
    for z, y, x in itertools.product(range(LAYERS), range(SIDE), range(SIDE)):
        if material(x, y, z):
            cells += tetrahedra((x, y, z))
            materials += [material(x, y, z)] * 6
    points = sorted({corner for cell in cells for corner in cell}, key=lambda p: p[::-1])
    numbers = {point: number for number, point in enumerate(points)}
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\nA heat sink on a chip\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {len(points)} double\n")
        file.writelines("%g %g %g\n" % tuple(i / 500 for i in point) for point in points)
        file.write(f"CELLS {len(cells)} {5 * len(cells)}\n")
        file.writelines("4 %d %d %d %d\n" % tuple(numbers[p] for p in cell) for cell in cells)
        file.write(f"CELL_TYPES {len(cells)}\n" + "10\n" * len(cells))
        file.write(f"CELL_DATA {len(cells)}\nSCALARS Material int 1\nLOOKUP_TABLE default\n")
        file.writelines("%d\n" % number for number in materials)


main()
