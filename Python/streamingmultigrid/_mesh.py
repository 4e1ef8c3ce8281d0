# SPDX-License-Identifier: BSD-3-Clause
"""A mesh on disk, and the jobs that are done on it."""

from __future__ import annotations

import contextlib
import functools
import os
import tempfile
from ctypes import byref, c_char_p, c_int64, c_void_p
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _jobs as jobs
from . import _types as types
from ._arrays import table
from ._columns import Column, Columns
from ._display import closed_html, mesh_html, mesh_lines, surface_svg
from ._errors import Error, InputError, NotConverged, ReportWarning, warn
from ._field import OF_EVERY_MESH, Block, Field, names_of, read_blocks, read_column, read_columns
from ._library import NativeHandle, call, call_reporting, encoded, json_text, library, parse
from ._merged import Merged
from ._process import HandleLock, close_at_exit, closing, forget, require_no_call
from ._solver import Solver
from .progress import part, reporting
from ._regions import as_region
from ._report import (
    Estimate,
    Report,
    not_converged,
    sentences_of_conversion,
    warn_of,
    warn_of_notes,
)

#: Meshes up to this size show a picture of themselves in notebooks, which reads them.
_PICTURE_VERTICES = 2_000_000


class _Folder:
    """A folder for a scratch file, removed with this object."""

    def __init__(self, place: Any) -> None:
        try:
            self.path = tempfile.mkdtemp(prefix="smg-simplified-", dir=place)
        except OSError as error:
            raise Error("scratch: %s: %s." % (error.filename, error.strerror)) from None
        self._token = closing(library().smg_remove_folder, encoded(self.path))
        close_at_exit(self)

    def finish(self) -> None:
        """Removes it."""
        self._token = None

    def inherit(self) -> None:
        """A forked child leaves it to its parent."""
        forget(self._token)


class Mesh:
    """A mesh of triangles or tetrahedra, on disk: made by `smg.open`, `smg.mesh`, `smg.from_pyvista`.

    ``print(mesh)`` describes it, ``mesh["Temperature"]`` reads a column of the vertices (else of the
    cells), ``mesh["heat"] = array`` adds one, which files then have, too. Columns and rows are in the
    original order, that of the file or arrays. Everything is read when it is asked for.
    """

    name: str  #: the file, or what the mesh was made of
    report: Optional[Report]  #: of a mesh made by `simplify`; else None

    def __init__(self, name: str, opener: Any, defaults: Dict[str, Any], progress: Any = None) -> None:
        self.name = name
        self._opener, self._defaults, self._progress = opener, defaults, progress
        self._opened: Optional[NativeHandle] = None
        self._opening = HandleLock()
        self._file: Tuple[Any, ...] = ()  # path and options as smg_estimate_file() takes them
        self._own: Dict[Tuple[str, bool], np.ndarray] = {}
        self._folder: Optional[_Folder] = None  # of a scratch file of its own
        self._source: Optional[str] = None  # the file whose conversion this is
        self._made_of: Tuple[str, ...] = ()  # the files of the mesh of which this was made
        self._reopening: Optional[Dict[str, Any]] = None  # the arguments of `open`, if it is all of it
        self._facts: Dict[bool, Dict[str, Any]] = {}
        self._elements: Optional[np.ndarray] = None
        self._n_elements: Optional[int] = None
        self._merged: Optional[Merged] = None
        self.report = None

    # Opening, which is done at the first use.

    def _handle(self, report: Any = None) -> NativeHandle:
        require_no_call()
        with self._opening:
            opened: Any = self._opened
            is_first = opened is None
            if is_first:
                with contextlib.ExitStack() as stack:
                    if report is None:
                        report = stack.enter_context(reporting(self._progress, "opening"))
                    opened = self._opened = self._opener(report)
        if is_first:
            self._warn_of_conversion(opened)
        return opened

    def _warn_of_conversion(self, opened: NativeHandle) -> None:
        result = c_char_p()
        with opened as mesh:
            call("smg_conversion", mesh, byref(result))
            conversion: Any = parse(result)
        for sentence in sentences_of_conversion(conversion or {}):
            warn("%s: %s" % (self.name, sentence), ReportWarning)

    def _arrays(self) -> List[Any]:
        """What the library uses of the mesh as it is now: arrays, and its folder."""
        return [self._folder, *self._own.values()]

    @property
    def _files(self) -> Tuple[str, ...]:
        """The files that a result must not replace."""
        return (*self._made_of, *([] if self._source is None else [self._source]))

    def check_output(self, path: Any) -> None:
        """Raises InputError if the file would be written over that of the mesh."""
        for name in self._files:
            if os.path.exists(path) and os.path.exists(name) and os.path.samefile(path, name):
                raise InputError("%s: it is the file of the mesh: choose another name." % os.fspath(path))

    def defaults(self, *names: str) -> Dict[str, Any]:
        """Of `memory`, `threads`, `scratch`, `scratch_limit`: those that the mesh was opened with."""
        return {name: self._defaults[name] for name in names if self._defaults.get(name) is not None}

    def saving(self, memory: Any, threads: Optional[int], scratch: Any, as_text: bool) -> Dict[str, Any]:
        """The options with which a file is written."""
        given = {"memory": memory, "threads": threads, "scratch": scratch}
        own = {name: value for name, value in given.items() if value is not None}
        return {**self.defaults(*given), **own, "text": bool(as_text)}

    @property
    def _is_closed(self) -> bool:
        return self._opened is not None and self._opened.is_closed

    def close(self) -> None:
        """Removes scratch files; also done when nothing refers to the mesh any more. Fields that were
        made from it stay."""
        if self._opened is not None:
            self._opened.close()
        self._folder = None

    def __reduce__(self) -> Any:
        if self._reopening is None or self._folder or self._own:
            raise Error(
                "%s: a mesh is pickled as the name of its file: save it, and open that file." % self.name
            )
        from ._opening import reopen

        return reopen, (self._source, self._reopening)

    def __enter__(self) -> "Mesh":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    # What is known of it.

    def info(self, full: bool = False, progress: Optional[types.Progress] = None) -> Dict[str, Any]:
        """What is known of the mesh, as ``smg info --report``.

        Args:
            full: read the mesh for bodies, boundary, quality of cells, ranges of columns and more.
        """
        with reporting(progress, "reading") as report, self._handle() as mesh:
            if full not in self._facts:
                result = c_char_p()
                call_reporting("smg_info", (mesh, int(full)), report, byref(result))
                self._facts[full] = parse(result)
            return self._facts[full]

    def _counts(self) -> Tuple[int, int]:
        vertices, cells = c_int64(), c_int64()
        with self._handle() as mesh:
            call("smg_counts", mesh, byref(vertices), byref(cells))
        return vertices.value, cells.value

    @property
    def n_vertices(self) -> int:
        """The number of vertices, with those of no cell: of rows of `points`."""
        return self._counts()[0]

    @property
    def n_points(self) -> int:
        """The same, by the name of other packages."""
        return self._counts()[0]

    @property
    def n_cells(self) -> int:
        """The number of cells: of rows of `cells`."""
        return self._counts()[1]

    @property
    def n_corners(self) -> int:
        """3 of triangles, 4 of tetrahedra."""
        return 3 if self.info()["cell_type"] == "triangle" else 4

    @property
    def bounds(self) -> Tuple[float, ...]:
        """(xmin, xmax, ymin, ymax, zmin, zmax), in the unit of the mesh, of the vertices that cells have:
        `points` has those of no cell, too."""
        return tuple(self.info()["bounds"])

    @property
    def groups(self) -> Dict[str, Dict[str, Any]]:
        """What the mesher has named, for `group`: {name: {"of": "vertices", "facets" or "cells", "number"}};
        of several groups of one name the first. How large they are says ``info(full=True)``."""
        found: Dict[str, Dict[str, Any]] = {}
        for entry in self.info()["groups"]:
            found.setdefault(entry["name"], {key: entry.get(key) for key in ("of", "number")})
        return found

    @property
    def columns(self) -> Dict[str, Dict[str, Any]]:
        """The columns: {"vertices": {name: {"type", "components"}}, "cells": {...}}."""
        with self._handle() as mesh:
            return read_columns(mesh, None)

    def keys(self) -> List[str]:
        """The names of the columns, of the vertices first."""
        return names_of(self.columns)

    def __contains__(self, name: Any) -> bool:
        return name in self.keys() or name in OF_EVERY_MESH

    # What it holds.

    @property
    def points(self) -> np.ndarray:
        """All positions, (n, 3) float64, in the unit of the mesh."""
        return self.read("Position")

    @property
    def cells(self) -> np.ndarray:
        """All cells, (m, 3) or (m, 4) int64: rows of `points`."""
        return self.read("Corners", cells=True)

    @property
    def elements(self) -> np.ndarray:
        """Of each cell the number of the cell of the file that it is a part of, (m,) int64, from 0.

        Polygons are read as triangles; hexahedra, prisms and pyramids as tetrahedra. Elements of the file that are no cells
        of the mesh, as the faces of groups, do not count (the column `OriginalCellId` counts all). Where there are
        fewer elements than cells, arrays that are given may have a row for each of them instead. Means of a result by
        element: ``np.bincount(mesh.elements, values) / np.bincount(mesh.elements)``.
        """
        if self._elements is None:
            if "OriginalCellId" in self.columns["cells"]:
                numbers = self.read("OriginalCellId", cells=True)
                self._elements = np.unique(numbers, return_inverse=True)[1].reshape(-1).astype(np.int64, copy=False)
            else:
                self._elements = np.arange(self.n_cells)
            self._elements.setflags(write=False)
        return self._elements

    @property
    def n_elements(self) -> int:
        """The number of `elements`. Unless the conversion has told it, the cells are read once for that."""
        if self._n_elements is None:
            count = c_int64()
            with self._handle() as mesh:
                call_reporting("smg_elements", (mesh,), None, byref(count))
            self._n_elements = count.value
        return self._n_elements

    def merged(self) -> Merged:
        """The points that were merged with others, for which a mesh is read only where this was asked for."""
        if self._opened is None and (self._reopening or {}).get("weld") is None:
            return Merged(np.empty(0, np.int64), np.empty(0, np.int64))
        if self._merged is None:
            count = c_int64()
            with self._handle() as mesh:
                call_reporting("smg_merged", (mesh,), None, byref(count), None, None)
                rows, kept = np.empty(count.value, np.int64), np.empty(count.value, np.int64)
                pointers = rows.ctypes.data_as(c_void_p), kept.ctypes.data_as(c_void_p)
                call_reporting("smg_merged", (mesh,), None, byref(count), *pointers)
            self._merged = Merged(rows, kept)
        return self._merged

    def read(
        self, name: str, cells: Optional[bool] = None, progress: Optional[types.Progress] = None
    ) -> np.ndarray:
        """A whole column.

        Args:
            name: of a column; "Position" and "Corners" are those of `points` and `cells`.
            cells: True: of the cells, False: of the vertices; default: of the vertices if they have it.

        Returns:
            (n,), or (n, k) of k components, of the type of the column.
        """
        with reporting(progress, "reading") as report, self._handle() as mesh:
            return read_column(
                mesh, None, name, cells, read_columns(mesh, None), self._counts(), self.n_corners, report
            )

    def __getitem__(self, name: str) -> np.ndarray:
        return self.read(name)

    __iter__ = None  # of numbers, as Python would try them

    def __setitem__(self, name: str, values: npt.ArrayLike) -> None:
        self.add(name, values)

    def add(
        self, name: str, values: npt.ArrayLike, cells: Optional[bool] = None, *, copy: bool = True
    ) -> None:
        """Adds a column, in place of one of this name; files that are written have it.

        Args:
            name: any but those with a meaning of their own, as Position and OriginalId.
            values: (n,) or (n, k), a row for each vertex, each cell or each of the `elements`; booleans
                become uint8.
            cells: True, False, or by the number of rows, which must tell.
            copy: False: the array is used where it is. Do not change it while the mesh or a field of it
                is used.
        """
        if not isinstance(name, str) or not name:
            raise InputError("%r: the name of a column is a text, of one character at least." % (name,))
        column = Columns(self).add(values, name, cells, name=name)
        if copy:  # also of what only lends its memory, as other libraries' arrays do
            column = column._replace(values=np.array(column.values))
        with self._handle() as mesh:
            self._add_column(mesh, column)
            self._own[name, column.cells] = column.values
            self._facts.clear()

    def blocks(
        self, max_points: int = 1_000_000, columns: Optional[Sequence[str]] = None
    ) -> Iterator[Block]:
        """The mesh in blocks of consecutive cells, with all their vertices.

        Args:
            max_points: the most vertices of a block.
            columns: names of columns of vertices and cells; by default all.
        """
        return read_blocks(self._handle(), None, self._arrays(), self.columns, max_points, columns)

    def save(
        self,
        path: types.Path,
        *,
        memory: Optional[types.Size] = None,
        threads: Optional[int] = None,
        scratch: Optional[types.Path] = None,
        text: bool = False,
        progress: Optional[types.Progress] = None,
    ) -> None:
        """Writes the mesh with its columns to a file, in the format of its suffix.

        Args:
            path: of a format that is written (docs/formats.md).
            text: True: text where the format has a binary and a text form; numbers read back exactly.
            memory, threads, scratch: as of `smg.open`; default: those of the mesh.

        What the format cannot hold is left out, with a ReportWarning.
        """
        self.check_output(path)
        result = c_char_p()
        options = self.saving(memory, threads, scratch, text)
        with reporting(progress, "writing") as report, self._handle() as mesh:
            call_reporting(
                "smg_save_mesh", (mesh, encoded(path), json_text(options)), report, byref(result)
            )
            notes = parse(result)
        for note in notes:
            warn(note, ReportWarning)

    # Jobs.

    def estimate(
        self, job: types.Job, *arguments: Any, path: Optional[types.Path] = None, **options: Any
    ) -> Estimate:
        """What a job is expected to cost, before it starts: memory, scratch, passes and seconds.

        Args:
            job: the name of its method, as "solve".
            arguments, options: as of the method of this name.
            path: where the result is to be written; default: nowhere.

        A file that has not been read yet is not read for it, unless arrays, names of columns or planes
        are arguments: then counts are estimated from its size where its header does not say them.
        """
        if job not in jobs.JOBS:
            raise InputError("There is no job %r; there are %s." % (job, ", ".join(jobs.JOBS)))
        columns = Columns(self)
        described = jobs.JOBS[job](columns, *arguments, **options)[0]
        description = json_text(self._with_defaults(described))
        result = c_char_p()
        if self._opened is None:  # what is said of the job did not need it
            call(
                "smg_estimate_file", *self._file, encoded(job), description, encoded(path), byref(result)
            )
            return Estimate(parse(result))
        with self.with_columns(columns) as mesh:
            call("smg_estimate", mesh, encoded(job), description, encoded(path), byref(result))
            return Estimate(parse(result))

    def _with_defaults(self, description: Dict[str, Any]) -> Dict[str, Any]:
        given = {key: value for key, value in description.items() if value is not None}
        return {**self.defaults("memory", "threads", "scratch", "scratch_limit"), **given}

    @contextlib.contextmanager
    def with_columns(self, columns: Columns) -> Iterator[Any]:
        """The pointer of the handle; the mesh has these columns as long as this is entered."""
        with self._handle() as pointer:
            have = self.columns if columns.added else {}
            for column in columns.added:
                if column.name in have["cells" if column.cells else "vertices"]:
                    raise InputError(
                        "The mesh has a column %r: give the array another name." % column.name
                    )
            try:
                for column in columns.added:
                    self._add_column(pointer, column)
                yield pointer
            finally:
                for column in columns.added:
                    call("smg_remove_column", pointer, encoded(column.name), int(column.cells))

    @staticmethod
    def _add_column(pointer: Any, column: Column) -> None:
        call_reporting(
            "smg_add_argument" if column.is_argument else "smg_add_column",
            (pointer, encoded(column.name), int(column.cells), byref(table(column.values))),
            None,
        )

    def _run(self, job: str, progress: Any, strict: bool, arguments: tuple, options: dict) -> Field:
        jobs.JOBS[job].bind(*arguments, **options)  # before a mesh is opened for it
        columns = Columns(self)
        with reporting(progress, job) as report:
            opening = 0.0 if self._opened else 0.3
            self._handle(part(report, 0, opening))
            described, names = jobs.JOBS[job](columns, *arguments, **options)
            description = json_text(self._with_defaults(described))
            arrays = [*self._arrays(), *(column.values for column in columns.added)]
            handle = NativeHandle("field", *arrays)
            with self.with_columns(columns) as mesh:
                call_reporting(
                    "smg_run",
                    (mesh, encoded(job), description),
                    part(report, opening, 1),
                    byref(handle.pointer),
                )
        field = Field(self, handle, job, names(), self._counts(), self.n_corners, columns.is_matrix)
        found = field._read_report(False)
        if strict and not found.get("converged", True):
            raise NotConverged(not_converged(found), field)
        warn_of(found, field._said)
        return field

    @jobs.with_arguments_of("simplify")
    def simplify(
        self,
        *arguments: Any,
        path: Optional[types.Path] = None,
        progress: Optional[types.Progress] = None,
        **options: Any,
    ) -> "Mesh":
        """The surface with fewer vertices, out of core; see docs/simplify.md.

        Args:
            {arguments}
            path: where to write the result; default: a scratch file, removed with the new mesh.
            progress: as of `solve`.

        With `vertices` and `error`, what comes first ends it. All vertices of `hold` on the surface are
        in the result, also if they are more than `vertices`.

        Returns:
            The simplified surface, whose column OriginalId has the numbers of its vertices in this
            mesh, or, if this one has such a column of a larger mesh, those in that one; each triangle has the columns of one of this mesh whose corners have moved. Its
            `report` says more.
        """
        simplified = self._simplified(path, progress, arguments, options)
        assert simplified.report is not None
        warn_of(simplified.report, set())
        warn_of_notes(simplified.report)
        return simplified

    def _simplified(self, path: Any, progress: Any, arguments: tuple, options: Dict[str, Any]) -> "Mesh":
        description = self._with_defaults(jobs.JOBS["simplify"](Columns(self), *arguments, **options)[0])
        folder = None
        if path is None:
            folder = _Folder(description.get("scratch"))
            path = os.path.join(folder.path, "simplified.vsm")
        self.check_output(path)
        result = c_char_p()
        try:
            with reporting(progress, "simplify") as report:
                opening = 0.0 if self._opened else 0.3
                with self._handle(part(report, 0, opening)) as mesh:
                    call_reporting(
                        "smg_simplify",
                        (mesh, json_text(description), encoded(path)),
                        part(report, opening, 1),
                        byref(result),
                    )
                    facts = Report(parse(result))
        except BaseException:  # whose traceback would keep the folder
            if folder:
                folder.finish()
            raise
        from ._opening import open

        simplified = open(path, **self._defaults)
        simplified.report = facts
        simplified._made_of = self._files
        if folder:
            simplified.name = "%s, simplified" % self.name
            simplified._folder = folder
        return simplified

    def select(self, region: types.Where, progress: Optional[types.Progress] = None) -> np.ndarray:
        """Where a region is, as a mask: (n,) bool of the vertices; of a column of the cells (m,) bool."""
        return as_region(region).selected(self, progress)[0]

    def select_vertices(self, where: Dict[str, Any], progress: Any = None) -> np.ndarray:
        """The mask of the vertices, (n,) bool, of WHERE of a problem file."""
        selected = np.empty(self.n_vertices, np.uint8)
        pointer = selected.ctypes.data_as(c_void_p)
        with reporting(progress, "selecting") as report, self._handle() as mesh:
            call_reporting("smg_select", (mesh, json_text(where)), report, pointer)
        return selected.view(bool)

    @jobs.with_arguments_of("solve", jobs.OF_MATRIX)
    def solver(
        self, *, on_disk: bool = False, progress: Optional[types.Progress] = None, **options: Any
    ) -> Solver:
        """The equations of a problem with their hierarchy, in memory, for many right-hand sides.

        The arguments are those of `solve` that say what the matrix is; `on_disk=True` keeps the hierarchy
        on scratch files, within the limit `memory`, for meshes that are too large for memory. See
        `streamingmultigrid.Solver`.
        """
        return Solver(self, progress, {**options, "on_disk": on_disk})

    def to_pyvista(self) -> Any:
        """The mesh with its columns as a pyvista.PolyData or UnstructuredGrid, all in memory."""
        from ._interop import to_pyvista

        return to_pyvista(self)

    # How it shows itself.

    def __repr__(self) -> str:
        state = ", closed" if self._is_closed else "" if self._opened else ", not read yet"
        return "<Mesh %s%s>" % (self.name, state)

    def __str__(self) -> str:
        return "\n".join(
            [self.name] + ["  %-12s %s" % row for row in mesh_lines(self.info(full=True))]
        )

    def _repr_html_(self) -> str:
        if self._is_closed:
            return closed_html(self)
        rows = mesh_lines(self.info())
        return mesh_html(self.name, rows, self.preview_svg())

    def preview_svg(self, field: Optional[Field] = None) -> str:
        """A picture of the mesh as SVG, coloured by a field; empty if the mesh is large or has none."""
        try:
            if self.n_vertices > _PICTURE_VERTICES:
                return ""
            with self._simplified(None, None, (1500,), {}) as small:
                points, cells, ids = small.points, small.cells, small["OriginalId"]
        except Error:
            return ""
        values = None
        if field is not None:
            found = field.to_numpy()
            if field.name == "Position":
                points = found[ids]
            elif found.ndim == 1 or found.shape[1] == 1:
                values = found.reshape(-1)[ids].astype(np.float64)
        return surface_svg(points, cells, values)


def _job(job: str) -> Any:
    """The method of a mesh that does a job whose result is a field."""

    @jobs.with_arguments_of(job)
    def method(
        self: Mesh, *arguments: Any, progress: Optional[types.Progress] = None, strict: bool = False, **options: Any
    ) -> Field:
        return self._run(job, progress, strict, arguments, options)

    method.__name__, method.__qualname__ = job, "Mesh." + job
    return method


for _name in jobs.OF_FIELDS:
    setattr(Mesh, _name, _job(_name))


def _on_result(name: str) -> Any:
    """The method of this name of a mesh, for fields."""

    @functools.wraps(getattr(Mesh, name))
    def method(self: Field, *arguments: Any, **options: Any) -> Any:
        return getattr(self.as_mesh(), name)(*arguments, **options)

    return method


for _name in (*jobs.JOBS, "solver", "estimate", "select"):
    setattr(Field, _name, _on_result(_name))
