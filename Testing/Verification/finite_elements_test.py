#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""finite_elements_test.py [SMG MESH...] : compares finite_elements.py with GetFEM. Two independent codes
yield the same matrices and vectors, on generated meshes and on those files, which smg reads.

Skipped (77) where GetFEM (Debian: python3-getfem) is not installed."""
import os
import sys
import tempfile

import numpy as np
from scipy import sparse

import meshes
from finite_elements import FiniteElements, tensor_matrices
from streamed_mesh import read_with_smg

try:
    import getfem
except ImportError:
    print("skipped: there is no GetFEM")
    sys.exit(77)

TENSOR = [2.0, 1.0, 0.5, 0.3, 0.2, 0.1]


class GetFem:
    """Integrals over a mesh by linear elements of GetFEM, in the order of the mesh's vertices."""

    def __init__(self, points, cells):
        corners = cells.shape[1]
        self.mesh = getfem.Mesh("empty", 3)
        self.mesh.add_convex(getfem.GeoTrans(f"GT_PK({corners - 1},1)"),
                             np.transpose(points[cells], (2, 1, 0)))
        self.space = getfem.MeshFem(self.mesh, 1)
        self.space.set_classical_fem(1)
        degree = {3: "IM_TRIANGLE(4)", 4: "IM_TETRAHEDRON(5)"}[corners]
        self.rule = getfem.MeshIm(self.mesh, getfem.Integ(degree))
        nodes = self.space.basic_dof_nodes().T
        at = {tuple(point): i for i, point in enumerate(np.round(points, 12) + 0.0)}
        self.vertex = np.array([at[tuple(node)] for node in np.round(nodes, 12) + 0.0])
        self.mesh.set_region(1, self.mesh.outer_faces(corners - 1))

    def _assemble(self, order, expression, region):
        unknown = np.zeros(self.space.nbdof())
        return getfem.asm("generic", self.rule, order, expression, region,
                          "u", 1, self.space, unknown)

    def matrix(self, expression, region=-1):
        found = self._assemble(2, expression, region)
        starts, rows = found.csc_ind()
        matrix = sparse.csc_matrix((found.csc_val(), rows, starts)).tocoo()
        return sparse.coo_matrix((matrix.data, (self.vertex[matrix.row], self.vertex[matrix.col])),
                                 matrix.shape).tocsr()

    def vector(self, expression, region=-1):
        result = np.empty(len(self.vertex))
        result[self.vertex] = np.ravel(self._assemble(1, expression, region))
        return result


def expect_equal(name, ours, theirs):
    difference = abs(ours - theirs).max() / abs(theirs).max()
    print(f"  {name:12} {difference:.1e}")
    assert difference < 1e-12, name


def compare(name, points, cells):
    print(name, len(points), "vertices")
    ours, theirs = FiniteElements(points, cells), GetFem(points, cells)
    tensor = tensor_matrices(np.tile(TENSOR, (len(cells), 1)))
    text = "[" + ";".join(",".join(map(str, row)) for row in tensor[0]) + "]"
    expect_equal("stiffness", ours.stiffness(), theirs.matrix("Grad_u.Grad_Test_u"))
    expect_equal("tensor", ours.stiffness(tensor),
                 theirs.matrix(f"({text}*Grad_u).Grad_Test_u"))
    expect_equal("mass", ours.lumped(), np.ravel(theirs.matrix("u*Test_u").sum(axis=1)))
    field = np.array([0.3, -1.0, 2.0])
    expect_equal("field", ours.divergence(np.tile(field, (len(cells), 1))),
                 theirs.vector("[0.3,-1.0,2.0].Grad_Test_u"))
    facets, _ = ours.boundary(np.ones(len(cells), dtype=bool))
    if len(facets):
        expect_equal("boundary", ours.boundary_lumped(facets), theirs.vector("Test_u", 1))


def curved(points, cells):
    """The flat mesh as part of a curved surface."""
    x, y = points[:, 0], points[:, 1]
    return np.stack([x, y, 0.3 * np.sin(4 * x) * (1 + y)], axis=1), cells


compare("a graded, curved surface", *curved(*meshes.square(12, graded=2.0)))
compare("a sphere", *meshes.sphere(6))
compare("a box", *meshes.box(5))
compare("a ball", *meshes.ball(3))
for mesh in sys.argv[2:]:
    with tempfile.TemporaryDirectory() as folder:
        read = read_with_smg(sys.argv[1], folder, mesh)
        compare(os.path.basename(mesh), read[0].astype(float), read[1])
