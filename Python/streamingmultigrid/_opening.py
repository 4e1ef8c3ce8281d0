# SPDX-License-Identifier: BSD-3-Clause
"""Where meshes come from: files, arrays, and results of jobs."""

from __future__ import annotations

import hashlib
import os
from ctypes import byref, c_char_p
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy.typing as npt

from . import _types as types
from ._arrays import counted, points_and_cells, table
from ._errors import Error
from ._field import Field
from ._library import NativeHandle, call, call_reporting, encoded, json_file, json_text, parse, version
from ._mesh import Mesh

_LIMITS = ("memory", "threads", "scratch", "scratch_limit")


def _files(path: str) -> List[str]:
    """The files of a mesh: `path`, and the other one of TetGen, or the pieces of VTK."""
    result = c_char_p()
    call("smg_files", encoded(path), byref(result))
    files: Any = parse(result)
    return [path, *(other for other in files[1:] if os.path.exists(other))]


def _cached(path: str, cache: Any, options: Dict[str, Any]) -> str:
    """Where the conversion of a file is kept: its name depends on the file and on the options."""
    if cache is True:
        home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
        cache = os.path.join(home, "streamingmultigrid")
    folder = os.path.dirname(path) if cache == "beside" else os.fspath(cache)
    states = [(name, os.stat(name)) for name in _files(path)]
    files = [(name, state.st_size, state.st_mtime_ns) for name, state in states]
    key = repr((files, version(), sorted(options.items())))
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise Error("cache: %s: %s." % (folder, error.strerror)) from None
    digest = hashlib.sha256(key.encode()).hexdigest()[:12]
    return os.path.join(folder, "%s.%s.vsm" % (os.path.basename(path), digest))


def open(  # noqa: A001, the word of the trade
    path: types.Path,
    *,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
    cells: Optional[types.Cells] = None,
    weld: Optional[float] = None,
    orient: Optional[bool] = None,
    time_step: Optional[int] = None,
    partition: Optional[int] = None,
    order: Optional[types.Order] = None,
    problem: Union[types.Path, Mapping[str, Any], None] = None,
    numbering: Optional[types.Numbering] = None,
    cache: Union[bool, types.Path, None] = None,
    progress: Optional[types.Progress] = None,
) -> Mesh:
    """A mesh file of any format; nothing is read before it is needed.

    A file that is no .vsm is converted at its first use, out of core, to a scratch file that is
    removed with the mesh, or with `cache` to a file that is found again.

    Args:
        path: of a format that is read (docs/formats.md).
        memory: the memory limit of the conversion and of jobs: bytes, or a text as "1GB" or "512MiB".
            Default: 256 MiB for conversions, 1 GiB for jobs.
        threads: 0 (default): one for each core. Results do not depend on it.
        scratch: the folder for scratch files; default: $TMPDIR, or /tmp.
        scratch_limit: the most bytes of scratch files at once, or a text; default: none.
        cells: "triangles" or "tets", of a file that has both.
        weld: merge points within this distance, in the unit of the mesh; 0: of equal coordinates. Arrays
            have rows for all points of the file; what a job finds at a point that was merged is what it
            finds at the one that stayed.
        orient: turn triangles so that those of a body are wound alike, and outwards if it is closed.
        time_step, partition: which of a VTKHDF file, from 0.
        order: "bfs" (default), "spectral", "axis", "keep": see docs/convert.md.
        problem: a problem file, or a dict as in one: the order keeps vertices near each other that
            its `periodic` sides and `interface` couple, so that `Mesh.solve` takes little memory.
        numbering: "columns" (default): rows of arrays are those that `int64` columns OriginalId and
            OriginalCellId of the file name, if it has them, as results in the order of the stream do; which is
            a `ReportWarning`. "rows": rows are those of the file, and such columns are called OriginalId_1 and
            OriginalCellId_1.
        cache: a folder for conversions; True: ~/.cache/streamingmultigrid; "beside": the folder of the
            file. From a cached conversion, results are written in the order of the file, but with
            polygons cut into triangles; with `weld` it has an order of its own.
        progress: of the conversion, see `help(streamingmultigrid.progress)`.

    Raises:
        FileNotFoundError: there is no such file. Error, at the first use: it cannot be read.
    """
    name = os.path.abspath(os.fspath(path))
    encoded(name)  # InputError
    os.stat(name)  # FileNotFoundError at once, not at the first use
    given: Dict[str, Any] = {
        "cells": cells,
        "weld": weld,
        "orient": orient,
        "time_step": time_step,
        "partition": partition,
        "order": order,
        "problem": problem if problem is None or isinstance(problem, Mapping) else json_file(problem, "problem"),
        "numbering": numbering,
    }
    own = {key: value for key, value in given.items() if value is not None}
    defaults: Dict[str, Any] = {
        "memory": memory,
        "threads": threads,
        "scratch": scratch,
        "scratch_limit": scratch_limit,
    }
    options = {**own, **defaults}

    def opener(report: Any) -> NativeHandle:
        file = name
        if cache is not None and cache is not False and not name.endswith(".vsm"):
            file = _cached(name, cache, own)
            if not os.path.exists(file):
                call_reporting(
                    "smg_convert", (encoded(name), encoded(file), json_text(options)), report, None
                )
        how = options if file == name else {**defaults, "welded": weld}
        handle = NativeHandle("mesh")
        call_reporting("smg_open", (encoded(file), json_text(how)), report, byref(handle.pointer))
        return handle

    opened = Mesh(name, opener, defaults, progress)
    opened._file = encoded(name), json_text(options)
    opened._source = name
    opened._reopening = {**options, "cache": cache}
    return opened


def reopen(path: str, options: Dict[str, Any]) -> Mesh:
    """The mesh of a file again, in another process."""
    return open(path, **options)


def mesh(
    points: npt.ArrayLike,
    cells: npt.ArrayLike,
    *,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
    weld: Optional[float] = None,
    orient: Optional[bool] = None,
    order: Optional[types.Order] = None,
    progress: Optional[types.Progress] = None,
) -> Mesh:
    """A mesh of arrays, which are read during this call: they may change or go afterwards.

    Args:
        points: (n, 3) numbers of any type, in any unit of length.
        cells: (m, 3), triangles, or (m, 4), tetrahedra: integers of any type, rows of `points`.
        memory, threads, scratch, scratch_limit, weld, orient, order, progress: as of `smg.open`.
    """
    places, corners = points_and_cells(points, cells)
    defaults: Dict[str, Any] = {
        "memory": memory,
        "threads": threads,
        "scratch": scratch,
        "scratch_limit": scratch_limit,
    }
    options = {**defaults, "weld": weld, "orient": orient, "order": order}
    arrays = table(places), table(corners)

    def opener(report: Any) -> NativeHandle:
        handle = NativeHandle("mesh")
        arguments = (byref(arrays[0]), byref(arrays[1]), json_text(options))
        call_reporting("smg_open_arrays", arguments, report, byref(handle.pointer))
        return handle

    made = Mesh(
        "arrays of %s and %s" % (counted(len(places), "point"), counted(len(corners), "cell")),
        opener,
        defaults,
        progress,
    )
    made._handle()
    made._opener = None  # which has the arrays
    return made


def mesh_of(field: Field, handle: NativeHandle, job: str, progress: Any) -> Mesh:
    """The mesh with the result of a job; see `Field.as_mesh`."""

    def opener(report: Any) -> NativeHandle:
        opened = NativeHandle("mesh")
        with handle as pointer:
            call_reporting("smg_open_field", (pointer,), report, byref(opened.pointer))
        return opened

    of = field.mesh
    made = Mesh("%s, %s" % (of.name, job), opener, of.defaults(*_LIMITS), progress)
    made._source, made._made_of = of._source, of._made_of
    made._handle()
    made._opener = None  # which has the field
    return made
