# SPDX-License-Identifier: BSD-3-Clause
"""Arrays that are given by value: columns of the mesh for one job."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ._arrays import numbers
from ._errors import InputError


class _Said(np.ndarray):
    """An array of which is said what its rows are of; arrays that are made of it say nothing."""

    rows_of_cells: Optional[bool] = None


def said_of(values: Any) -> Optional[bool]:
    """Whether an array, or a field, is said to be of the cells (True) or of the vertices (False); None:
    neither."""
    return getattr(values, "rows_of_cells", None)


def saying(values: Any, rows_of_cells: Optional[bool]) -> np.ndarray:
    """The values as an array of which that is said."""
    said = np.asarray(values).view(_Said)
    said.rows_of_cells = rows_of_cells
    return said


def of_vertices(values: npt.ArrayLike) -> np.ndarray:
    """An array with a row for each vertex: says so where a mesh has as many cells, or cells of its file.

    ::

        mesh.solve(source=smg.of_vertices(heat), dirichlet=smg.boundary >> 0)
    """
    numbers(values, "of_vertices")
    return saying(values, False)


def of_cells(values: npt.ArrayLike) -> np.ndarray:
    """An array with a row for each cell, or each of the `Mesh.elements`: says so where a mesh has as many
    vertices. As `of_vertices`."""
    numbers(values, "of_cells")
    return saying(values, True)


class Column(NamedTuple):
    """A column that a job needs besides those of the mesh."""

    name: str
    cells: bool  # of the cells, else of the vertices
    values: np.ndarray
    is_argument: bool  # of the job alone, no part of its result


class Columns:
    """The columns that the description of a job adds to a mesh, while it is made."""

    def __init__(self, mesh: Any) -> None:
        self.mesh = mesh
        self.added: List[Column] = []
        self.is_matrix = False  # whether values of the result were given as an array (n, 1)

    def shape_as(self, values: np.ndarray) -> None:
        """The result has the shape of values that were given."""
        self.is_matrix = self.is_matrix or values.ndim == 2 and values.shape[1] == 1

    def diagonal(self) -> float:
        """The diagonal of the bounds of the mesh."""
        bounds = np.reshape(self.mesh.bounds, (3, 2))
        return float(np.linalg.norm(bounds[:, 1] - bounds[:, 0]))

    @staticmethod
    def side(values: Any, what: str, cells: Optional[bool]) -> Optional[bool]:
        """Whether values are of the cells (True) or of the vertices (False), as they say or as `cells` says;
        None: neither does."""
        said = said_of(values)
        if said is None or said == cells:
            return cells
        if cells is not None:
            nouns = ("cells", "vertices") if cells else ("vertices", "cells")
            raise InputError("%s: the array is said to be of the %s; one of the %s is needed." % (what, *nouns[::-1]))
        return said

    def has_rows(self, values: np.ndarray, cells: Optional[bool], elements: bool = True) -> bool:
        """Whether an array has a row for each vertex, or for each cell.

        Args:
            elements: whether a row for each element (`Mesh.elements`) counts, for which the cells may be
                read.
        """
        count = values.shape[0] if values.ndim else -1
        return (
            (cells is not True and count == self.mesh.n_vertices)
            or (cells is not False and count == self.mesh.n_cells)
            or (elements and self._are_elements(count, cells))
        )

    def _are_elements(self, count: int, cells: Optional[bool]) -> bool:
        return cells is not False and 0 < count < self.mesh.n_cells and count == self.mesh.n_elements

    def _rows(self, values: np.ndarray, what: str, cells: Optional[bool]) -> Optional[bool]:
        """Whether an array has a row for each cell (True) or vertex (False), or neither (None)."""
        count = values.shape[0] if values.ndim else -1
        of_vertices_ = cells is not True and count == self.mesh.n_vertices
        noun = "cells" if count == self.mesh.n_cells else "elements" if self._are_elements(count, cells) else ""
        if of_vertices_ and noun and cells is None:
            raise InputError(
                "%s: the mesh has %d vertices and as many %s: say of which the array is, by "
                "smg.of_vertices(array) or smg.of_cells(array)." % (what, count, noun)
            )
        return False if of_vertices_ else True if noun and cells is not False else None

    def add(
        self,
        values: Any,
        what: str,
        cells: Optional[bool] = None,
        components: Sequence[int] = (),
        name: Optional[str] = None,
    ) -> Column:
        """Adds an array as a column.

        Args:
            values: (n,) or (n, k), a row for each vertex, cell or element (`Mesh.elements`).
            what: the argument, for messages.
            cells: True, False, or as the array says (`of_cells`), or else by the number of rows.
            components: those that are allowed; empty: any.
            name: for a column of the result; default: it is an argument of the job alone.
        """
        cells = self.side(values, what, cells)
        array = numbers(values, what)
        of_cells = self._rows(array, what, cells)
        if of_cells is None or array.ndim > 2:
            wanted = [
                "%d %s" % (count, noun)
                for of, count, noun in (
                    (False, self.mesh.n_vertices, "vertices"),
                    (True, self.mesh.n_cells, "cells"),
                )
                if cells in (None, of)
            ]
            if cells is not False and self.mesh.n_elements < self.mesh.n_cells:
                wanted.append("%d elements" % self.mesh.n_elements)
            raise InputError(
                "%s: the shape of the array is %s; it must have a row for each of the %s."
                % (what, array.shape, " or ".join(wanted))
            )
        width = array.shape[1] if array.ndim == 2 else 1
        if components and width not in components:
            raise InputError(
                "%s: an array of %d components; it must have %s."
                % (what, width, " or ".join(map(str, sorted(set(components)))))
            )
        if of_cells and len(array) != self.mesh.n_cells:
            array = array[self.mesh.elements]
        if name is None and not of_cells:
            if what == "mask":
                array = self.mesh.merged().mask(array)
            else:
                self.mesh.merged().warn_of(array, what)
        column = Column(name or self._free_name(what), of_cells, array, name is None)
        self.added.append(column)
        return column

    def _free_name(self, what: str) -> str:
        """A name that no column has, by which messages call an argument."""
        used = {column.name for column in self.added}.union(*self.mesh.columns.values())
        own = "#" + what
        while own in used:
            own += "'"
        return own

    def named(self, values: Any, what: str, default: str) -> List[str]:
        """Names of columns of the vertices: given as a name, names, {name: array}, or an array."""
        if isinstance(values, str):
            return [values]
        if isinstance(values, Mapping):
            return [self._result(array, what, name) for name, array in values.items()]
        if isinstance(values, (list, tuple)) and all(isinstance(each, str) for each in values):
            return list(values)
        return [self._result(values, what, default)]

    def _result(self, values: Any, what: str, name: str) -> str:
        column = self.add(values, what, cells=False, name=name)
        self.mesh.merged().warn_of(column.values, what)
        self.shape_as(column.values)
        return name

    def components(self, name: str) -> Optional[int]:
        """Of a column of the vertices of the mesh; None if there is none of this name."""
        specs: Dict[str, Any] = self.mesh.columns["vertices"]
        return specs[name]["components"] if name in specs else None
