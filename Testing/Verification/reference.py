# SPDX-License-Identifier: BSD-3-Clause
"""An independent implementation of the problem files of smg: assembled with finite_elements.py and solved
directly."""
from typing import NamedTuple

import numpy as np

from finite_elements import facet_measure, free_components, free_means, solve
from placed_data import PlacedData


class Condition(NamedTuple):
    """The results for a Dirichlet, flux or Robin condition; flux is positive into the body."""
    area: float
    mean: np.ndarray  # of the solution, a column; NaN without area
    flux: np.ndarray


class Answer(NamedTuple):
    """A problem's solution by finite elements."""
    u: np.ndarray         # (vertices, columns)
    gradient: np.ndarray  # (cells, 3 * columns) if it is an output, otherwise None
    flux: np.ndarray      # the same of -K grad u
    conditions: dict      # Condition by name, such as dirichlet[0]
    energy: np.ndarray    # a column: half the integral of grad u . K grad u + s u^2, where the
                          # weights of soft constraints are part of s
    mean: np.ndarray      # a column: weighted by the mass
    load: np.ndarray      # (vertices, columns): of sources, less the removed means of components
                          # without any condition; this and all fluxes sum to the loss by screening
    screened: np.ndarray  # (vertices,): screening integrals; times u, the loss by screening
    traffic: np.ndarray   # a column: the magnitudes of all inflow, by vertex; without any flow,
                          # the inflow for a value of the whole range
    residual: np.ndarray  # a column: the largest sum of a residual with the initial one's norm


class BoundaryTerm(NamedTuple):
    """The contribution of a flux or Robin condition: share * value at each corner of its facets, less
    share * u with Robin."""
    name: str
    facets: np.ndarray  # numbers of its facets
    share: np.ndarray   # (facets, corners, 1)
    value: np.ndarray   # (facets, corners, columns)
    isRobin: bool


class System:
    """A problem, given as the content of its JSON file, assembled on a PlacedData."""

    def __init__(self, data, problem):
        self.data, self.columns = data, problem.get("columns", 1)
        self.conductivity = data.cell_values(problem.get("conductivity"), 1.0)
        self.stiffness = data.elements.stiffness(self.conductivity)
        self.screened = data.screening(problem.get("screening", 0.0)).copy()
        self.load = data.density(problem.get("source", [0.0] * self.columns), self.columns).copy()
        if "field" in problem:
            field = data.elements.divergence(data.cell_columns[problem["field"]])
            self.load += field.reshape(self.load.shape)
        for soft in problem.get("soft", []):
            weight = data.vertices_in(soft) * data.screening(soft["weight"])
            self.screened += weight
            self.load += weight[:, None] * data.vertex_values(soft["value"], self.columns)
        self.diagonal, self.rhs = self.screened.copy(), self.load.copy()
        self.boundary = [*self._boundary_terms(problem.get("flux", []), False),
                         *self._boundary_terms(problem.get("robin", []), True)]
        for term in self.boundary:
            corners = data.facets[term.facets]
            self.rhs += data.elements.at_corners(corners, term.share * term.value)
            if term.isRobin:
                self.diagonal += data.elements.at_corners(corners, term.share)[:, 0]
        self._hold(problem)

    def _boundary_terms(self, entries, isRobin):
        data = self.data
        owner = np.full(len(data.facets), -1)
        for k, entry in enumerate(entries):
            owner[data.facets_in(entry)] = k  # later entries win
        for k, entry in enumerate(entries):
            mine = np.flatnonzero(owner == k)
            area = facet_measure(data.points, data.facets[mine])
            share = (area / data.facets.shape[1])[:, None, None] * np.ones((1, data.facets.shape[1], 1))
            if isRobin:
                share = share * data.facet_values(mine, entry["coefficient"], 1)
            value = data.facet_values(mine, entry["ambient" if isRobin else "value"], self.columns)
            yield BoundaryTerm(f"{'robin' if isRobin else 'flux'}[{k}]", mine, share, value, isRobin)

    def _hold(self, problem):
        """The Dirichlet condition that holds a vertex (-1: none), and held and initial values."""
        entries = problem.get("dirichlet", [])
        start = problem.get("initial")
        if start is None:
            moves = any(entry["value"] == "position" for entry in entries)
            start = "position" if moves else [0.0] * self.columns
        self.owner = np.full(len(self.data.points), -1)
        self.initial = self.data.vertex_values(start, self.columns).copy()
        self.dirichlet = len(entries)
        for k, entry in enumerate(entries):
            inside = self.data.vertices_in(entry)
            self.owner[inside] = k
            self.initial[inside] = self.data.vertex_values(entry["value"], self.columns)[inside]

    def solution(self):
        """(vertices, columns)"""
        return solve(self.data.elements, self.stiffness, self.diagonal, self.rhs, self.owner >= 0,
                     self.initial)

    def removed(self):
        """(vertices, columns): of the right-hand side, in components without any condition."""
        component, mass = self.data.elements.components(), self.data.elements.lumped()
        free = free_components(component, self.owner >= 0, self.diagonal)
        return mass[:, None] * free_means(component, free, self.rhs, mass)


    def first_residual(self):
        """(columns,): the largest sum of a residual with the norm of the initial one: the norm times the root
        of the number of its entries (Cauchy-Schwarz)."""
        matrix_u = self.stiffness @ self.initial + self.diagonal[:, None] * self.initial
        residual = self.rhs - self.removed() - matrix_u
        free = residual[self.owner < 0]
        return np.sqrt(len(free)) * np.linalg.norm(free, axis=0)


class Reference:
    """A mesh with its columns, see StreamedMesh, on which problems are solved directly."""

    def __init__(self, points, cells, vertex_columns=None, cell_columns=None):
        self.data = PlacedData(points, cells, vertex_columns, cell_columns)

    @property
    def elements(self):
        return self.data.elements

    def solve(self, problem):
        """The Answer to a problem, given as the content of its JSON file."""
        system = System(self.data, problem)
        u = system.solution()
        gradient, flow = self._outputs(system, u) if "outputs" in problem else (None, None)
        conditions, magnitude = self._conditions(system, u)
        load = system.load - system.removed()
        mass = self.elements.lumped()
        traffic = magnitude + np.abs(load - system.screened[:, None] * u).sum(axis=0)
        possible = system.stiffness.diagonal()[system.owner >= 0].sum() * np.ptp(u)
        return Answer(
            u, gradient, flow, conditions,
            0.5 * (np.einsum("vk,vk->k", u, system.stiffness @ u) + system.screened @ u**2),
            mass @ u / mass.sum(), load, system.screened,
            np.where(traffic > 1e-9 * possible, traffic, possible), system.first_residual())

    def _outputs(self, system, u):
        """Gradient and flux (cells, 3 * columns)."""
        gradient = np.stack([self.elements.gradient(column) for column in u.T], axis=1)
        flow = -np.einsum("cde,cke->ckd", system.conductivity, gradient)
        return gradient.reshape(len(flow), -1), flow.reshape(len(flow), -1)

    def _conditions(self, system, u):
        """The Conditions by name, and the magnitudes of all inflow (columns,)."""
        reaction = system.stiffness @ u + system.diagonal[:, None] * u - system.rhs
        magnitude = np.abs(reaction[system.owner >= 0]).sum(axis=0)
        conditions = {}
        for k in range(system.dirichlet):
            held = system.owner == k
            facets = np.flatnonzero(held[self.data.facets].all(axis=1))
            conditions[f"dirichlet[{k}]"] = self._condition(facets, u, reaction[held].sum(axis=0))
        for term in system.boundary:
            known = u[self.data.facets[term.facets]] if term.isRobin else 0.0
            flow = term.share * (term.value - known)
            conditions[term.name] = self._condition(term.facets, u, flow.sum(axis=(0, 1)))
            magnitude += np.abs(flow).sum(axis=(0, 1))
        return conditions, magnitude

    def _condition(self, facets, u, flux):
        corners = self.data.facets[facets]
        area = facet_measure(self.data.points, corners)
        mean = area @ u[corners].mean(axis=1) / area.sum() if len(facets) else np.nan
        return Condition(area.sum(), mean, flux)
