# SPDX-License-Identifier: BSD-3-Clause
"""Regions and values of the data of problem files on a mesh, as specified in docs/problem.md."""
import numpy as np
from scipy.spatial import cKDTree

from finite_elements import FiniteElements, tensor_matrices


def duplicates(cells):
    """(cells,) of bool: cells with the corners of an earlier one."""
    _, first = np.unique(np.sort(cells, axis=1), axis=0, return_index=True)
    result = np.ones(len(cells), dtype=bool)
    result[first] = False
    return result


class PlacedData:
    """A mesh with its columns, see StreamedMesh, which supplies the data of problems."""

    def __init__(self, points, cells, vertex_columns=None, cell_columns=None):
        ignored = duplicates(cells)
        self.elements = FiniteElements(points, cells, ignored)
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
        """(vertices,) of bool, or None if a column selects the region."""
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
        elif "boundary" in where:
            result[self.facets] = True
        elif "tag" not in where and "mask" not in where:
            result[:] = True
        else:
            return None
        return result

    def _selected(self, where):
        """Vertices (vertices,) and cells (cells,) of bool that a column selects; None for the other kind."""
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
        """A coefficient in the cells, see tensor_matrices(): (cells, 3, 3)."""
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
        """The integrals of a density at the vertices (vertices, columns): numbers, or a column's name."""
        mass = self.elements.lumped()[:, None]
        if isinstance(given, str) and given in self.cell_columns:
            return self.elements.lumped(self.cell_columns[given].reshape(len(self.cells), -1))
        return mass * self.vertex_values(given, columns)

    def screening(self, given):
        """The contribution of a screening to the diagonal (vertices,). A list holds at the vertices, or in
        the cells if an entry names a column of the cells."""
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
