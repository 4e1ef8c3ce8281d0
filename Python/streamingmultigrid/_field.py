# SPDX-License-Identifier: BSD-3-Clause
"""What a job has found: values at the vertices, on disk until they are asked for; and blocks."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_int64, c_void_p
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from . import _types as types
from ._arrays import Array, copy, counted, shaped
from ._errors import Error, InputError
from ._library import NativeHandle, call, call_reporting, encoded, json_text, parse
from .progress import reporting
from ._report import Report, ShortestPath, warn_of

if TYPE_CHECKING:
    from ._mesh import Mesh

#: Of every mesh, beside its columns: name, whether of the cells, type, components (None: 3 or 4).
_OF_EVERY_MESH = (("Position", False, "float64", 3), ("Corners", True, "int64", None))
OF_EVERY_MESH = tuple(each[0] for each in _OF_EVERY_MESH)


class Block:
    """Consecutive cells of a mesh with all their vertices; valid until the next block is asked for.

    Attributes:
        points: (n, 3) float64, in the unit of the mesh.
        cells: (m, 3) or (m, 4) int64, rows of `points`.
        n_points, n_cells: n and m.
        rows, cell_rows: (n,) and (m,) int64, where the vertices and cells are in the original order:
            ``mesh.points[block.rows]`` is `points`.
        ghost: (n,) bool, the vertices that an earlier block has, too: leave these out to count each
            vertex once.

    ``block["Temperature"]`` is a column, (n,) or (n, k) of the vertices, else (m,) or (m, k) of the
    cells.
    """

    n_points: int
    n_cells: int

    def __init__(self, handle: NativeHandle, n_points: int, n_cells: int, of_cells: Sequence[str]) -> None:
        self.n_points, self.n_cells = n_points, n_cells
        self._handle: Optional[NativeHandle] = handle
        self._of_cells = set(of_cells)
        self._read: Dict[tuple, np.ndarray] = {}

    @property
    def points(self) -> np.ndarray:
        """The positions of the vertices, (n, 3) float64."""
        return self["Position"]

    @property
    def cells(self) -> np.ndarray:
        """The corners of the cells, (m, 3) or (m, 4) int64, as rows of `points`."""
        return self["Corners"]

    @property
    def rows(self) -> np.ndarray:
        """The rows of the vertices in the original order, (n,) int64."""
        return self._array("smg_block_rows", 0)

    @property
    def cell_rows(self) -> np.ndarray:
        """The rows of the cells in the original order, (m,) int64."""
        return self._array("smg_block_rows", 1)

    @property
    def ghost(self) -> np.ndarray:
        """Whether an earlier block has a vertex, too, (n,) bool."""
        return self._array("smg_block_ghosts").view(bool)

    def __getitem__(self, name: str) -> np.ndarray:
        return self._array("smg_block_array", encoded(name), int(name in self._of_cells))

    def _array(self, function: str, *arguments: Any) -> np.ndarray:
        """What a function of the library says of the block; read once."""
        key = (function, *arguments)
        if key not in self._read:
            if self._handle is None:
                raise Error(
                    "This block has passed: read what you need of it inside the loop over the blocks."
                )
            array = Array()
            with self._handle as blocks:
                call(function, blocks, *arguments, byref(array))
                self._read[key] = copy(array)
        return self._read[key]

    def __repr__(self) -> str:
        return "<Block of %s and %s>" % (counted(self.n_points, "vertex", "vertices"), counted(self.n_cells, "cell"))


def read_blocks(
    mesh: Any,
    field: Any,
    keep: Sequence[Any],
    columns: Dict[str, Dict[str, Any]],
    max_points: int,
    names: Optional[Sequence[str]],
) -> Iterator[Block]:
    """The blocks of a mesh, or of a field with its mesh; `mesh` and `field` are handles or None, `keep`
    has the arrays that they use."""
    if isinstance(max_points, bool) or not hasattr(max_points, "__index__") or max_points < 4:
        raise InputError(
            "max_points: %r: it must be an integer of at least 4, so that a block can have a cell."
            % (max_points,)
        )
    options: Dict[str, Any] = {"points": int(max_points)}
    if names is not None:
        unknown = [n for n in names if n not in columns["vertices"] and n not in columns["cells"]]
        if unknown:
            raise InputError(
                "columns: there is no column %r; there are %s."
                % (unknown[0], ", ".join([*columns["vertices"], *columns["cells"]]) or "none")
            )
        options["columns"] = [name for name in names if name in columns["vertices"]]
        options["cell_columns"] = [name for name in names if name in columns["cells"]]
    of_cells = ["Corners", *(set(columns["cells"]) - set(columns["vertices"]))]
    source = field or mesh
    handle = NativeHandle("blocks", *keep)
    with source as pointer:
        handles = (pointer, None) if field is None else (None, pointer)
        call_reporting(
            "smg_open_blocks", (*handles, json_text(options)), None, byref(handle.pointer)
        )
    vertices, cells = c_int64(), c_int64()
    block = None
    try:
        while True:
            with handle as blocks:
                if block is not None:
                    block._handle = None
                call("smg_next_block", blocks, byref(vertices), byref(cells))
            if cells.value == 0:
                return
            block = Block(handle, vertices.value, cells.value, of_cells)
            yield block
    finally:
        if block is not None:
            block._handle = None
        handle.close()


def read_columns(mesh: Optional[c_void_p], field: Optional[c_void_p]) -> Dict[str, Dict[str, Any]]:
    """The columns of a handle: {"vertices": {name: {"type", "components"}}, "cells": {...}}."""
    result = c_char_p()
    call("smg_columns", mesh, field, byref(result))
    return {
        place: {
            column["name"]: {"type": column["type"], "components": column["components"]}
            for column in specs
        }
        for place, specs in parse(result).items()
    }


def names_of(columns: Dict[str, Dict[str, Any]]) -> List[str]:
    """The names of columns, those of the vertices first, each once."""
    return list(dict.fromkeys([*columns["vertices"], *columns["cells"]]))


def read_column(
    mesh: Optional[c_void_p],
    field: Optional[c_void_p],
    name: str,
    cells: Optional[bool],
    columns: Dict[str, Dict[str, Any]],
    counts: Sequence[int],
    corners: int,
    report: Any,
) -> np.ndarray:
    """A whole column in the original order; `cells`: None: of the vertices if these have it."""
    places = [False, True] if cells is None else [cells]
    specs: Dict[Tuple[bool, str], Tuple[Any, int]] = {
        (of, name_): (spec["type"], spec["components"])
        for of, place in ((False, "vertices"), (True, "cells"))
        for name_, spec in columns[place].items()
    }
    for name_, of, type_, components in _OF_EVERY_MESH:
        specs.setdefault((of, name_), (type_, components or corners))
    for of_cells in places:
        if (of_cells, name) in specs:
            type_, components = specs[of_cells, name]
            values = np.empty((counts[of_cells], components), type_)
            pointer = values.ctypes.data_as(c_void_p)
            call_reporting("smg_read", (mesh, field, encoded(name), int(of_cells)), report, pointer)
            return shaped(values, components)
    names = sorted(name_ for of, name_ in specs if of in places)
    raise InputError("There is no column %r; there are %s." % (name, ", ".join(names)))


class Field(np.lib.mixins.NDArrayOperatorsMixin):
    """The result of a job: values at the vertices of a mesh, on disk until they are asked for.

    ``np.asarray(field)`` and `to_numpy` read them, and so does arithmetic, as ``field + 1``; `blocks`
    reads them with the mesh, part by part; `save` writes them with the mesh to a file. A field has the
    jobs of a mesh: they are done on the mesh with the result, as ``mesh.smooth().simplify(1000)``.

    Attributes:
        mesh: the mesh that the job was done on.
        names: the columns of the result; first that of the values, for example "Solution"; that of
            moved points is "Position".
    """

    mesh: Mesh
    names: Tuple[str, ...]
    rows_of_cells = False  # as an argument of another job

    def __init__(
        self,
        mesh: Mesh,
        handle: NativeHandle,
        job: str,
        names: Sequence[str],
        counts: Sequence[int],
        corners: int,
        is_matrix: bool,
    ) -> None:
        self.mesh, self.names, self._job = mesh, tuple(names), job
        self._handle = handle
        self._is_matrix = is_matrix  # the values are (n, k) even of k = 1, as those given
        self._counts, self._corners = counts, corners  # those of the mesh
        self._said: set = set()
        self._report: Optional[Report] = None
        self._as_mesh: Any = None  # made when it is asked for

    @property
    def name(self) -> str:
        """The name of the values: the first of `names`."""
        return self.names[0]

    @property
    def shape(self) -> tuple:
        """(n,) of one value at each vertex, else (n, k); (n, 1) if the job was given such values. n
        counts vertices of no cell, too."""
        vertices, columns = c_int64(), c_int64()
        with self._handle as field:
            call("smg_shape", field, byref(vertices), byref(columns))
        if columns.value == 1 and not self._is_matrix:
            return (vertices.value,)
        return vertices.value, columns.value

    @property
    def ndim(self) -> int:
        """1, or 2 of several values at each vertex."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """The number of values."""
        return int(np.prod(self.shape))

    @property
    def dtype(self) -> np.dtype:
        """The type of the values, as of `to_numpy`."""
        spec = self.columns["vertices"].get(self.name)
        return np.dtype(spec["type"] if spec else np.float64)

    def __len__(self) -> int:
        return self.shape[0]

    @property
    def n_vertices(self) -> int:
        """The number of vertices, with those of no cell."""
        return self._counts[0]

    n_points = n_vertices

    @property
    def n_cells(self) -> int:
        """The number of cells."""
        return self._counts[1]

    @property
    def columns(self) -> Dict[str, Dict[str, Any]]:
        """The columns of the result with its mesh, as `Mesh.columns`."""
        with self._handle as field:
            return read_columns(None, field)

    def keys(self) -> List[str]:
        """The names of the columns of the result and of its mesh, of the vertices first."""
        return names_of(self.columns)

    def __contains__(self, name: Any) -> bool:
        return name in self.keys() or name in OF_EVERY_MESH

    @property
    def report(self) -> Report:
        """What the job did and what it cost, with what follows from its result.

        The mesh is read once for that, the first time.
        """
        if self._report is None:
            self._report = self._read_report(True)
            warn_of(self._report, self._said)
        return self._report

    @property
    def paths(self) -> List[ShortestPath]:
        """The shortest paths that `distance` was asked for by `to`: ascending by their `to`, each once."""
        found = self._read_report(False).get("distance", {}).get("paths")
        if found is None:
            raise InputError("paths: only distances with `to` have paths.")
        return [ShortestPath.of(path) for path in found]

    def _read_report(self, full: bool) -> Report:
        result = c_char_p()
        with self._handle as field:
            call_reporting("smg_report", (field, int(full)), None, byref(result))
            return Report(parse(result))

    def to_numpy(self) -> np.ndarray:
        """The values at the vertices, in the order of the file or of the arrays.

        Returns:
            (n,), or (n, k) of k right-hand sides or components; at vertices of no cell a solution is
            NaN.
        """
        return self.read(self.name).reshape(self.shape)

    def read(
        self, name: str, cells: Optional[bool] = None, progress: Optional[types.Progress] = None
    ) -> np.ndarray:
        """A whole column of the result or of its mesh, as `Mesh.read`."""
        with reporting(progress, "reading") as report, self._handle as field:
            return read_column(
                None,
                field,
                name,
                cells,
                read_columns(None, field),
                self._counts,
                self._corners,
                report,
            )

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        if copy is False:
            raise ValueError("The values are on disk: an array of them is a copy.")
        values = self.to_numpy()
        return values if dtype is None else values.astype(dtype, copy=False)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        if any(isinstance(out, Field) for out in options.get("out", ())):
            raise InputError("out: the values of a field do not change: give an array.")
        values = [each.to_numpy() if isinstance(each, Field) else each for each in inputs]
        return getattr(ufunc, method)(*values, **options)

    __hash__ = object.__hash__  # == compares values, as that of arrays

    def __getitem__(self, name: Any) -> Any:
        """A column by its name; with anything else, as a slice or a mask, a part of the values."""
        return self.read(name) if isinstance(name, str) else self.to_numpy()[name]

    __iter__ = None  # of numbers, as Python would try them

    def as_mesh(self, progress: Optional[types.Progress] = None) -> Mesh:
        """The mesh with the result as a `Mesh`, for other jobs; its columns and order are those of this
        field. The first time it is written to a scratch file."""
        if self._as_mesh is None or self._as_mesh._is_closed:
            from ._opening import mesh_of

            self._as_mesh = mesh_of(self, self._handle, self._job, progress)
        return self._as_mesh

    def blocks(
        self, max_points: int = 1_000_000, columns: Optional[Sequence[str]] = None
    ) -> Iterator[Block]:
        """The mesh with the result in blocks of consecutive cells, with all their vertices.

        Args:
            max_points: the most vertices of a block.
            columns: names of columns; by default all.
        """
        return read_blocks(None, self._handle, self._handle.keep, self.columns, max_points, columns)

    def save(
        self,
        path: types.Path,
        *,
        memory: Optional[types.Size] = None,
        threads: Optional[int] = None,
        scratch: Optional[types.Path] = None,
        text: bool = False,
        progress: Optional[types.Progress] = None,
    ) -> Report:
        """Writes the mesh with the result to a file, in the format of its suffix.

        The order and everything else is as of the command line: from a mesh file to a format that is
        restored that of the file. Arrays that were arguments of the job are not part of it.

        Args:
            path: of a format that is written and has all columns (docs/formats.md).
            text: True: text where the format has a binary and a text form; numbers read back exactly.
            memory, threads, scratch: as of `Mesh.solve`.

        Returns:
            The report. What the format cannot hold is left out, with a ReportWarning.
        """
        self.mesh.check_output(path)
        result = c_char_p()
        options = self.mesh.saving(memory, threads, scratch, text)
        with reporting(progress, "writing") as report, self._handle as field:
            call_reporting(
                "smg_save", (field, encoded(path), json_text(options)), report, byref(result)
            )
            self._report = Report(parse(result))
        warn_of(self._report, set(self._said))
        return self._report

    def to_pyvista(self) -> Any:
        """The mesh with the result as a pyvista.PolyData or UnstructuredGrid, all in memory."""
        from ._interop import to_pyvista

        return to_pyvista(self)

    def close(self) -> None:
        """Removes the values from the disk; also done when nothing refers to the field any more."""
        self._handle.close()

    def __enter__(self) -> "Field":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        try:
            shape = " %s" % (self.shape,)
        except Error:  # closed, or lost as the process forked
            shape = ""
        state = ", closed" if self._handle.is_closed else ""
        return "<Field %r%s of %s, by %s%s>" % (self.name, shape, self.mesh.name, self._job, state)

    def _repr_html_(self) -> str:
        from ._display import closed_html, report_html

        if self._handle.is_closed:
            return closed_html(self)
        return report_html(self.report) + self.mesh.preview_svg(self)


__all__: List[str] = ["Block", "Field"]
