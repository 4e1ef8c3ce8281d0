# SPDX-License-Identifier: BSD-3-Clause
"""Sparse symmetric positive definite systems of meshes, solved by SuperLU."""
import numpy as np
from scipy.sparse import linalg

SMALL = 64  # vertices that are not divided further
REFINEMENTS = 3


def nested_dissection(matrix, points):
    """An order of the rows with little fill: nested dissection of the points along the longest side of
    their bounds; the interior of both halves comes first, then their separator.

    matrix  of the graph, in CSR form with n rows
    points  (n, 3)
    """
    isLeft = np.zeros(matrix.shape[0], dtype=bool)

    def ordered(rows):
        x = points[rows]
        axis = np.argmax(np.ptp(x, axis=0))
        left = x[:, axis] < np.median(x[:, axis])
        if len(rows) <= SMALL or not left.any():
            return [rows]
        isLeft[rows] = left
        right = rows[~left]
        graph = matrix[right]
        touches = np.add.reduceat(isLeft[graph.indices], graph.indptr[:-1]) > 0
        isLeft[rows] = False
        return ordered(rows[left]) + ordered(right[~touches]) + [right[touches]]

    return np.concatenate(ordered(np.arange(matrix.shape[0])))


def direct_solve(matrix, rhs, residual, points=None):
    """The solution (n, columns) of a system in CSR form, with steps of iterative refinement.

    residual  of a solution (n, columns), more accurately than rhs - matrix @ solution
    points    (n, 3): for nested dissection, efficient in three dimensions; otherwise minimum degree
    """
    if matrix.shape[0] == 0:
        return np.zeros_like(rhs)
    order = np.arange(matrix.shape[0]) if points is None else nested_dissection(matrix, points)
    ordered = matrix[order][:, order].tocsc()
    factors = linalg.splu(ordered, diag_pivot_thresh=0.0, options={"SymmetricMode": True},
                          permc_spec="MMD_AT_PLUS_A" if points is None else "NATURAL")
    x = np.empty_like(rhs)
    x[order] = factors.solve(rhs[order])
    for _ in range(REFINEMENTS):
        x[order] += factors.solve(residual(x)[order])
    return x
