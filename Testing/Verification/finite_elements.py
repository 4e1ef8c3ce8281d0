# SPDX-License-Identifier: BSD-3-Clause
"""Linear finite elements on triangles in space and on tetrahedra, assembled with NumPy and solved
directly, independent of smg: -div(K grad u - q) + s u = f with Dirichlet, flux and Robin conditions.

Integrals of s, f, fluxes and Robin terms are lumped at the corners, as in smg: measure over
number of corners at each. Stiffness and the integral of q . grad phi are exact.
"""
import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from direct_solve import direct_solve

FLAT = 1e-14  # cells of less measure than this share of (longest edge)^dimension are ignored


def tensor_matrices(conductivity):
    """(n, 3, 3) from numbers (n,), diagonals (n, 3) or components xx, yy, zz, xy, yz, xz (n, 6)."""
    values = np.asarray(conductivity, dtype=float)
    if values.ndim == 1:
        return values[:, None, None] * np.eye(3)
    if values.shape[1] == 3:
        return values[:, :, None] * np.eye(3)
    return values[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)


def facet_measure(points, facets):
    """Lengths of edges (n, 2) or areas of triangles (n, 3)."""
    sides = points[facets[:, 1:]] - points[facets[:, :1]]
    if facets.shape[1] == 2:
        return np.linalg.norm(sides[:, 0], axis=1)
    return 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)


class FiniteElements:
    """A mesh of triangles or tetrahedra with the contributions of its elements.

    points   (vertices, 3)
    cells    (cells, 3 or 4), corners from 0
    ignored  (cells,) of bool: cells without weight, such as duplicates; flat ones join them
    """

    def __init__(self, points, cells, ignored=None):
        self.points = np.asarray(points, dtype=float)
        self.cells = np.asarray(cells)
        self.gradients, self.measure = self._geometry()
        if ignored is not None:
            self.measure[ignored] = 0.0
        self.gradients[self.measure == 0.0] = 0.0

    @property
    def corners(self):
        return self.cells.shape[1]

    def _geometry(self):
        """Gradients of the barycentric coordinates (cells, corners, 3), and the cells' measures."""
        p = self.points[self.cells]
        longest = np.max([np.linalg.norm(p[:, i] - p[:, j], axis=1)
                          for i in range(self.corners) for j in range(i)], axis=0)
        if self.corners == 3:
            opposite = np.stack([p[:, 2] - p[:, 1], p[:, 0] - p[:, 2], p[:, 1] - p[:, 0]], axis=1)
            normal = np.cross(opposite[:, 2], -opposite[:, 1])
            size = np.linalg.norm(normal, axis=1)  # twice the area
            flat = size <= FLAT * longest**2
            with np.errstate(divide="ignore", invalid="ignore"):
                gradients = np.cross(normal[:, None], opposite) / (size**2)[:, None, None]
            return gradients, np.where(flat, 0.0, size / 2)
        a, b, c = (p[:, i] - p[:, 0] for i in (1, 2, 3))
        areas = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
        six = np.einsum("cd,cd->c", a, areas[:, 0])
        flat = np.abs(six) <= FLAT * longest**3
        with np.errstate(divide="ignore", invalid="ignore"):
            inner = areas / six[:, None, None]
        gradients = np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1)
        return gradients, np.where(flat, 0.0, np.abs(six) / 6)

    def at_corners(self, facets, values):
        """Sums values (facets, corners) or (facets, corners, columns) at the vertices."""
        values = np.asarray(values)
        flat = values.reshape(facets.size, -1)
        result = np.stack([np.bincount(facets.ravel(), column, len(self.points))
                           for column in flat.T], axis=1)
        return result if values.ndim == 3 else result[:, 0]

    def stiffness(self, conductivity=None):
        """The sparse matrix of the integrals of grad phi_i . K grad phi_j.

        conductivity   (cells, 3, 3), see tensor_matrices(); 1 unless given
        """
        flux = self.gradients
        if conductivity is not None:
            flux = flux @ conductivity
        local = np.einsum("cid,cjd,c->cij", flux, self.gradients, self.measure)
        rows = np.repeat(self.cells, self.corners, axis=1).ravel()
        columns = np.tile(self.cells, (1, self.corners)).ravel()
        size = len(self.points)
        return sparse.coo_matrix((local.ravel(), (rows, columns)), (size, size)).tocsr()

    def lumped(self, density=None):
        """Integrals at the vertices of a density of the cells (cells,) or (cells, columns); 1 unless given."""
        share = self.measure / self.corners
        density = np.ones(len(self.cells)) if density is None else np.asarray(density)
        weighted = (share * density.T).T
        return self.at_corners(self.cells, np.stack([weighted] * self.corners, axis=1))

    def divergence(self, field):
        """The integrals of q . grad phi_i of a field (cells, 3) or (cells, 3 * columns)."""
        q = np.asarray(field).reshape(len(self.cells), -1, 3)
        values = np.einsum("ckd,cid,c->cik", q, self.gradients, self.measure)
        return self.at_corners(self.cells, values if q.shape[1] > 1 else values[..., 0])

    def gradient(self, u):
        """The gradient of u (vertices,) in each cell: (cells, 3)."""
        return np.einsum("cid,ci->cd", self.gradients, u[self.cells])

    def boundary(self, counted):
        """The facets (n, corners - 1) of exactly one of the cells counted (cells,), and their cells (n,)."""
        numbers = np.flatnonzero(counted)
        facets = np.concatenate([np.delete(self.cells[numbers], i, axis=1)
                                 for i in range(self.corners)])
        _, first, count = np.unique(np.sort(facets, axis=1), axis=0,
                                    return_index=True, return_counts=True)
        single = first[count == 1]
        return facets[single], numbers[single % len(numbers)]

    def boundary_lumped(self, facets):
        """The share of each vertex (vertices,) in the measure of the facets (n, corners - 1)."""
        share = facet_measure(self.points, facets) / facets.shape[1]
        return self.at_corners(facets, np.stack([share] * facets.shape[1], axis=1))

    def components(self):
        """(vertices,): the number of each vertex's component; cells without weight connect nothing."""
        cells = self.cells[self.measure > 0.0]
        rows = np.repeat(cells[:, 0], self.corners - 1)
        graph = sparse.coo_matrix((np.ones(len(rows)), (rows, cells[:, 1:].ravel())),
                                  (len(self.points),) * 2)
        return csgraph.connected_components(graph, directed=False)[1]


def solve(elements, stiffness, diagonal, rhs, held, initial):
    """The solution (vertices, columns) with held values. In a component of the mesh that neither
    held values nor the diagonal determine, the mass-weighted mean of the right-hand side is removed,
    and the solution has the mass-weighted mean of the initial values.

    stiffness  the sparse matrix of conduction
    diagonal   (vertices,): contributions of screening and Robin terms
    rhs        (vertices, columns)
    held       (vertices,) of bool
    initial    (vertices, columns): the held values, and the start values elsewhere
    """
    matrix = (stiffness + sparse.diags(diagonal)).tocsr()
    mass = elements.lumped()
    component = elements.components()
    free = free_components(component, held, diagonal)
    pinned = np.unique(component, return_index=True)[1][free]
    known = held | (matrix.diagonal() <= 0.0)  # vertices of cells without weight keep their values
    known[pinned] = True
    rhs = rhs - mass[:, None] * free_means(component, free, rhs, mass)
    u = initial.copy()
    unknown = np.flatnonzero(~known)
    rows = matrix[unknown]
    right = rhs[unknown] - rows[:, np.flatnonzero(known)] @ u[known]
    edges = stiffness.tocoo()

    def residual(x):
        """By differences, so that the stiffness of a needle does not cancel the small terms that determine
        its level."""
        u[unknown] = x
        flow = edges.data[:, None] * (u[edges.col] - u[edges.row])
        taken = np.stack([np.bincount(edges.row, column, len(u)) for column in flow.T], axis=1)
        return (rhs - diagonal[:, None] * u - taken)[unknown]

    points = elements.points[unknown] if elements.corners == 4 else None
    u[unknown] = direct_solve(rows[:, unknown].tocsr(), right, residual, points)
    return u + free_means(component, free, mass[:, None] * (initial - u), mass)


def free_components(component, held, diagonal):
    """(components,) of bool: those that neither a held vertex nor the diagonal determines."""
    return np.bincount(component, held | (diagonal > 0.0)) == 0


def free_means(component, free, integrals, mass):
    """(vertices, columns): each free component's sum of integrals over its mass, 0 in the others."""
    total = np.bincount(component, mass)
    usable = free & (total > 0.0)
    sums = np.stack([np.bincount(component, column) for column in integrals.T], axis=1)
    return (usable[:, None] * sums / np.where(usable, total, 1.0)[:, None])[component]
