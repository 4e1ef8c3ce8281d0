# SPDX-License-Identifier: BSD-3-Clause
"""Problem files as smg reads them, understood a second time: assembled with finite_elements.py."""
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from finite_elements import (FiniteElements, facet_measure, free_components, solve,
                             tensor_matrices)


class Condition(NamedTuple):
    """What is said of a Dirichlet, flux or Robin condition; flux is positive into the body."""
    area: float
    mean: np.ndarray  # of the solution, a column; NaN without area
    flux: np.ndarray


class Answer(NamedTuple):
    """A problem's solution by finite elements."""
    u: np.ndarray         # (vertices, columns)
    gradient: np.ndarray  # (cells, 3 * columns)
    flux: np.ndarray      # (cells, 3 * columns): -K grad u
    conditions: dict      # Condition by name, such as dirichlet[0]
    energy: np.ndarray    # a column: half the integral of grad u . K grad u + s u^2, where the
                          # weights of soft constraints are part of s
    mean: np.ndarray      # a column: weighted by the mass
    source: np.ndarray    # a column: what flows in by sources less what screening takes, where
                          # conditions determine the solution: with their fluxes it sums to zero
    traffic: np.ndarray   # a column: the magnitudes of the same and of what flows in, by vertex


def duplicates(cells):
    """(cells,) of bool: cells with the corners of an earlier one."""
    _, first = np.unique(np.sort(cells, axis=1), axis=0, return_index=True)
    result = np.ones(len(cells), dtype=bool)
    result[first] = False
    return result


class Reference:
    """A mesh with its columns, see StreamedMesh, on which problems are solved directly."""

    def __init__(self, points, cells, vertex_columns=None, cell_columns=None):
        ignored = duplicates(cells)
        self.elements = FiniteElements(points, cells, ignored)
        self.ignored = ignored
        self.vertex_columns, self.cell_columns = vertex_columns or {}, cell_columns or {}
        self.facets, self.facet_cells = self.elements.boundary(~ignored)

    @property
    def points(self):
        return self.elements.points

    @property
    def cells(self):
        return self.elements.cells

    # Where

    def _in_region(self, where):
        """(vertices,) of bool, or None if a column says where."""
        x = self.points
        if "halfspace" in where:
            a, b, c, d = where["halfspace"]
            return a * x[:, 0] + b * x[:, 1] + c * x[:, 2] >= d
        if "box" in where:
            box = np.array(where["box"])
            return np.all((x >= box[:3]) & (x <= box[3:]), axis=1)
        if "sphere" in where:
            *center, radius = where["sphere"]
            return np.sum((x - center)**2, axis=1) <= radius**2
        result = np.zeros(len(x), dtype=bool)
        if "vertices" in where:
            result[where["vertices"]] = True
        elif "nearest" in where:
            used = np.unique(self.cells)
            result[used[cKDTree(x[used]).query(where["nearest"])[1]]] = True
        elif "tag" not in where and "mask" not in where:
            result[:] = True
        else:
            return None
        return result

    def _selected(self, where):
        """Vertices (vertices,) and cells (cells,) of bool that a column selects; None: not its kind."""
        name = where["tag"][0] if "tag" in where else where["mask"]
        wanted = (lambda v: v == where["tag"][1]) if "tag" in where else (lambda v: v != 0)
        if name in self.vertex_columns:
            return wanted(self.vertex_columns[name]), None
        return None, wanted(self.cell_columns[name])

    def vertices_in(self, where):
        """(vertices,) of bool."""
        inside = self._in_region(where)
        if inside is None:
            inside, cells = self._selected(where)
            if inside is None:
                inside = np.zeros(len(self.points), dtype=bool)
                inside[self.cells[cells]] = True
        return inside

    def cells_in(self, where):
        """(cells,) of bool: a cell lies in a region if all its corners do."""
        inside = self._in_region(where)
        if inside is None:
            inside, cells = self._selected(where)
            if inside is None:
                return cells
        return inside[self.cells].all(axis=1)

    def facets_in(self, where):
        """(boundary facets,) of bool, in the same way; a cell's tag is that of its facets."""
        inside = self._in_region(where)
        if inside is None:
            inside, cells = self._selected(where)
            if inside is None:
                return cells[self.facet_cells]
        return inside[self.facets].all(axis=1)

    # Data

    def cell_values(self, given, default):
        """A coefficient in the cells, as of tensor_matrices(): (cells, 3, 3)."""
        if given is None:
            given = default
        if isinstance(given, str):
            return tensor_matrices(self.cell_columns[given])
        if isinstance(given, list) and isinstance(given[0], dict):
            result = self.cell_values(default, None)
            for entry in given:
                cells = self.cells_in(entry)
                result[cells] = self.cell_values(entry["value"], None)[cells]
            return result
        return tensor_matrices(np.broadcast_to(np.asarray(given, float),
                                               (len(self.cells),) + np.shape(given)))

    def density(self, given, columns):
        """What a density adds to the vertices (vertices, columns): numbers, or a column's name."""
        mass = self.elements.lumped()[:, None]
        if isinstance(given, str) and given in self.cell_columns:
            return self.elements.lumped(self.cell_columns[given].reshape(len(self.cells), -1))
        return mass * self.vertex_values(given, columns)

    def screening(self, given):
        """What a screening adds to the diagonal (vertices,). A list holds at the vertices, but in the
        cells if an entry names a column of these."""
        if not isinstance(given, list):
            return self.density(given, 1)[:, 0]
        named = {name for entry in given
                 for name in (entry["value"], entry.get("mask"), entry.get("tag", [None])[0])}
        if named & self.cell_columns.keys():
            values = np.zeros(len(self.cells))
            for entry in given:
                inside = self.cells_in(entry)
                values[inside] = self._means(entry["value"])[inside]
            return self.elements.lumped(values)
        values = np.zeros(len(self.points))
        for entry in given:
            inside = self.vertices_in(entry)
            values[inside] = self.vertex_values(entry["value"], 1)[inside, 0]
        return values * self.elements.lumped()

    def _means(self, given):
        """(cells,): a number, a column of the cells, or the corners' mean of one of the vertices."""
        if isinstance(given, str) and given in self.cell_columns:
            return self.cell_columns[given]
        return self.vertex_values(given, 1)[:, 0][self.cells].mean(axis=1)

    def vertex_values(self, given, columns):
        """(vertices, columns): numbers, `position`, or the name of a column of the vertices."""
        if isinstance(given, str):
            given = self.points if given == "position" else self.vertex_columns[given]
            return np.asarray(given, dtype=float).reshape(len(self.points), -1)
        return np.broadcast_to(np.asarray(given, float), (len(self.points), columns))

    def facet_values(self, facets, given, columns):
        """(facets, corners, columns): numbers, or a column of the vertices or the cells."""
        if isinstance(given, str) and given in self.cell_columns:
            values = np.asarray(self.cell_columns[given], float).reshape(len(self.cells), -1)
            return np.repeat(values[self.facet_cells[facets]][:, None], self.facets.shape[1], axis=1)
        return self.vertex_values(given, columns)[self.facets[facets]]

    # Systems

    def _facet_terms(self, entries, data):
        """Of boundary conditions: (name, facets, share of a corner, values by name of the datum)."""
        owner = np.full(len(self.facets), -1)
        for k, entry in enumerate(entries):
            owner[self.facets_in(entry)] = k  # later entries win
        for k, entry in enumerate(entries):
            mine = np.flatnonzero(owner == k)
            area = facet_measure(self.points, self.facets[mine])
            yield mine, area, {name: self.facet_values(mine, entry[name], columns)
                               for name, columns in data.items()}

    def solve(self, problem):
        """The Answer to a problem, given as what its JSON file says."""
        columns = problem.get("columns", 1)
        elements = self.elements
        conductivity = self.cell_values(problem.get("conductivity"), 1.0)
        stiffness = elements.stiffness(conductivity)
        diagonal = self.screening(problem.get("screening", 0.0)).copy()
        rhs = self.density(problem.get("source", [0.0] * columns), columns).copy()
        if "field" in problem:
            rhs += elements.divergence(self.cell_columns[problem["field"]]).reshape(rhs.shape)
        for soft in problem.get("soft", []):
            weight = self.vertices_in(soft) * self.screening(soft["weight"])
            diagonal += weight
            rhs += weight[:, None] * self.vertex_values(soft["value"], columns)

        sources, screened = rhs.copy(), diagonal.copy()
        robin, flux = {}, {}
        for k, (mine, area, values) in enumerate(self._facet_terms(
                problem.get("flux", []), {"value": columns})):
            share = (area / self.facets.shape[1])[:, None, None] * values["value"]
            rhs += elements.at_corners(self.facets[mine], share)
            flux[k] = mine, area, share
        for k, (mine, area, values) in enumerate(self._facet_terms(
                problem.get("robin", []), {"coefficient": 1, "ambient": columns})):
            share = (area / self.facets.shape[1])[:, None, None] * values["coefficient"]
            diagonal += elements.at_corners(self.facets[mine], share)[:, 0]
            rhs += elements.at_corners(self.facets[mine], share * values["ambient"])
            robin[k] = mine, area, share, values["ambient"]

        owner, initial = self._dirichlet(problem, columns)
        u = solve(elements, stiffness, diagonal, rhs, owner >= 0, initial)
        reaction = stiffness @ u + diagonal[:, None] * u - rhs
        conditions = self._reactions(problem, owner, u, reaction)
        traffic = np.abs(reaction[owner >= 0]).sum(axis=0)
        for k, (mine, area, share) in flux.items():
            conditions[f"flux[{k}]"] = self._facet_condition(mine, area, u, share)
            traffic += np.abs(share).sum(axis=(0, 1))
        for k, (mine, area, share, ambient) in robin.items():
            flow = share * (ambient - u[self.facets[mine]])
            conditions[f"robin[{k}]"] = self._facet_condition(mine, area, u, flow)
            traffic += np.abs(flow).sum(axis=(0, 1))
        component = elements.components()
        determined = ~free_components(component, owner >= 0, diagonal)[component]
        inflow = (sources - screened[:, None] * u)[determined]
        mass = elements.lumped()
        gradient = np.stack([elements.gradient(column) for column in u.T], axis=1)
        flow = -np.einsum("cde,cke->ckd", conductivity, gradient)
        return Answer(u, gradient.reshape(len(self.cells), -1), flow.reshape(len(self.cells), -1),
                      conditions,
                      0.5 * (np.einsum("vk,vk->k", u, stiffness @ u) + screened @ u**2),
                      mass @ u / mass.sum(), inflow.sum(axis=0),
                      traffic + np.abs(inflow).sum(axis=0))

    def _dirichlet(self, problem, columns):
        """Which Dirichlet condition holds a vertex (-1: none), and held and initial values."""
        entries = problem.get("dirichlet", [])
        start = problem.get("initial")
        if start is None:
            moves = any(entry["value"] == "position" for entry in entries)
            start = "position" if moves else [0.0] * columns
        owner = np.full(len(self.points), -1)
        initial = self.vertex_values(start, columns).copy()
        for k, entry in enumerate(entries):
            inside = self.vertices_in(entry)
            owner[inside] = k
            initial[inside] = self.vertex_values(entry["value"], columns)[inside]
        return owner, initial

    def _facet_condition(self, mine, area, u, flow):
        """Of facets with their areas and what flows in at their corners (facets, corners, columns)."""
        mean = (area @ u[self.facets[mine]].mean(axis=1)) / area.sum() if len(mine) else np.nan
        return Condition(area.sum(), mean, flow.sum(axis=(0, 1)))

    def _reactions(self, problem, owner, u, reaction):
        """The Dirichlet conditions: the reactions of the held vertices are what flows in."""
        conditions = {}
        for k in range(len(problem.get("dirichlet", []))):
            held = owner == k
            mine = np.flatnonzero(held[self.facets].all(axis=1))
            area = facet_measure(self.points, self.facets[mine])
            conditions[f"dirichlet[{k}]"] = self._facet_condition(
                mine, area, u, reaction[held][None])
        return conditions
