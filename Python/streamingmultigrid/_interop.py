# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of other packages: PyVista, meshio, trimesh, and whatever has points and cells or faces."""

from __future__ import annotations

from ctypes import byref
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ._arrays import counted, numbers, points_and_cells, table
from ._errors import Error, InputError, ReportWarning, warn
from ._library import call_reporting
from ._mesh import Mesh
from ._opening import mesh

_CORNERS = {3: "triangles", 4: "tetrahedra"}
_TRIANGLE, _POLYGON, _PIXEL, _QUAD, _TETRA = 5, 7, 8, 9, 10  # cell types of VTK
_OWN = ("OriginalId", "OriginalCellId", "CellFlags")
_FLAT = {"triangle": 3, "quad": 4, "polygon": None}  # of meshio


def _triangles(points: Any, corners: np.ndarray, offsets: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Polygons as triangles, cut as those of a file, and the polygon of each triangle."""
    sizes = np.diff(offsets)
    if (sizes < 3).any():
        raise InputError("cells: a polygon has less than three corners.")
    polygon = np.repeat(np.arange(len(sizes)), sizes - 2)
    if len(polygon) == len(sizes):
        return corners[offsets[0] : offsets[-1]].reshape(-1, 3), polygon
    simplices = np.empty((len(polygon), 3), np.int64)
    points, _ = points_and_cells(points, simplices)
    arrays = points, numbers(corners, "cells"), numbers(offsets, "cells")
    tables = tuple(byref(table(array)) for array in arrays)
    call_reporting("smg_triangulate", tables, None, simplices.ctypes.data)
    return simplices, polygon


def _counted(flat: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Cells as VTK writes them in one array, [3, i, j, k, 4, ...]: corners and offsets."""
    if flat.size and np.all(flat[:: flat[0] + 1] == flat[0]) and flat.size % (flat[0] + 1) == 0:
        corners = flat.reshape(-1, flat[0] + 1)[:, 1:].reshape(-1)
        return corners, np.arange(len(corners) // flat[0] + 1) * flat[0]
    starts: List[int] = []
    at = 0
    while at < len(flat):
        starts.append(at)
        at += int(flat[at]) + 1
    if at != len(flat):
        raise InputError("faces: the counts of corners do not fit the length of the array.")
    sizes = flat[starts]
    return np.delete(flat, starts), np.concatenate([[0], np.cumsum(sizes)])


def _of_vtk(dataset: Any, points: Any) -> Tuple[np.ndarray, Optional[np.ndarray]]:
    """Simplices of a dataset of PyVista, and the cell of each; None: they are its cells."""
    if hasattr(dataset, "celltypes"):  # UnstructuredGrid
        types = np.asarray(dataset.celltypes)
        corners = np.asarray(dataset.cell_connectivity)
        offsets = np.asarray(dataset.offset)
        if (types == _TETRA).all():
            return corners.reshape(-1, 4), None
        if (types == _TRIANGLE).all():
            return corners.reshape(-1, 3), None
        if np.isin(types, (_TRIANGLE, _POLYGON, _QUAD)).all():
            return _triangles(points, corners, offsets)
        raise InputError(
            "The cells are neither all tetrahedra nor all polygons: give dataset.triangulate(), or "
            "save it as .vtu and open that."
        )
    if getattr(dataset, "n_strips", 0):
        raise InputError("The cells have triangle strips: give dataset.triangulate().")
    simplices, polygon = _triangles(points, *_counted(numbers(dataset.faces, "faces")))
    # VTK numbers vertices and lines of a PolyData before its polygons.
    others = getattr(dataset, "n_verts", 0) + getattr(dataset, "n_lines", 0)
    _warn_of_others(others)
    return simplices, polygon + others


def _warn_of_others(cells: int) -> None:
    if cells > 0:
        words = ("cell of another type is", "cells of other types are")
        warn("%s left out." % counted(cells, *words), ReportWarning)


def _of_blocks(blocks: Any, points: Any) -> Tuple[np.ndarray, Optional[np.ndarray]]:
    """Simplices of meshio's list of cell blocks, tetrahedra if there are any, and the cell of each."""
    solid = any(block.type == "tetra" for block in blocks)
    used = {"tetra"} if solid else set(_FLAT)
    chosen: List[np.ndarray] = []
    cells: List[np.ndarray] = []
    first = 0
    for block in blocks:
        data = np.asarray(block.data)
        if block.type in used:
            if solid:
                simplices, of = data, np.arange(len(data))
            else:
                width = data.shape[1]
                simplices, of = _triangles(points, data.reshape(-1), np.arange(len(data) + 1) * width)
            chosen.append(simplices)
            cells.append(first + of)
        elif block.type not in ("vertex", "line", *(_FLAT if solid else ())):
            raise InputError(
                "cells: %r are neither triangles, polygons nor tetrahedra: write the mesh to a file and "
                "open that." % block.type
            )
        first += len(data)
    if not chosen:
        raise InputError("cells: there are neither triangles nor tetrahedra.")
    of_all = np.concatenate(cells)
    _warn_of_others(sum(len(block.data) for block in blocks if block.type not in used))
    plain = len(of_all) == first and np.array_equal(of_all, np.arange(first))
    return np.concatenate(chosen), None if plain else of_all


def _parts(thing: Any) -> Tuple[Any, np.ndarray, Optional[np.ndarray]]:
    """Points, simplices, and the cell of each simplex, of any object that has them."""
    points = getattr(thing, "points", None)
    if points is None:
        points = getattr(thing, "vertices", None)
    if points is None:
        raise InputError("%r has neither points nor vertices." % type(thing).__name__)
    if hasattr(thing, "celltypes") or hasattr(thing, "GetPolys"):
        return points, *_of_vtk(thing, points)
    cells = getattr(thing, "cells", None)
    are_faces = cells is None
    if are_faces:
        cells = getattr(thing, "faces", None)
    if cells is None:
        raise InputError("%r has neither cells nor faces." % type(thing).__name__)
    if isinstance(cells, (list, tuple)) and all(hasattr(block, "type") for block in cells):
        return points, *_of_blocks(cells, points)
    cells = numbers(cells, "cells")
    if cells.ndim == 1:
        return points, *_triangles(points, *_counted(cells))
    if are_faces and cells.ndim == 2 and cells.shape[1] > 3:  # as of quadrilaterals
        return points, *_triangles(points, cells.reshape(-1), np.arange(len(cells) + 1) * cells.shape[1])
    return points, cells, None


def _data(thing: Any, cells: Optional[np.ndarray]) -> Dict[Tuple[str, bool], np.ndarray]:
    """The numeric arrays that belong to vertices and cells; others stay behind, with a warning."""
    found: Dict[Tuple[str, bool], np.ndarray] = {}
    left: List[str] = []
    for attribute, of_cells in (
        ("point_data", False), ("cell_data", True), ("vertex_attributes", False), ("face_attributes", True)
    ):  # fmt: skip
        data: Any = getattr(thing, attribute, None)
        for name in list(data.keys()) if data is not None else []:
            values = data[name]
            if of_cells and isinstance(values, (list, tuple)):  # meshio: an array for each block
                values = np.concatenate([np.asarray(each) for each in values])
            values = np.asarray(values)
            if values.dtype.kind not in "biuf" or values.ndim not in (1, 2):
                left.append(repr(str(name)))
                continue
            if of_cells and cells is not None:
                values = values[cells]
            found[str(name), of_cells] = values
    if left:
        warn("Left out, since only numbers can be columns: %s." % ", ".join(left), ReportWarning)
    return found


def from_pyvista(dataset: Any, **options: Any) -> Mesh:
    """A mesh of an object in memory, with its data of points and cells as columns.

    Args:
        dataset: a pyvista.PolyData or UnstructuredGrid, a mesh of meshio or trimesh, or any object with
            `points` (or `vertices`), (n, 3), and `cells`: (m, 3) triangles, (m, 4) tetrahedra, or
            `faces`: (m, k) polygons; either may be counted as in VTK. Polygons are cut into triangles, whose cell data are
            those of the polygon; of meshio's meshes with tetrahedra these count. Columns with which
            this package numbers and marks meshes (OriginalId, OriginalCellId, CellFlags), and
            those of VTK itself (vtk...), stay behind.
        options: as of `smg.mesh`.
    """
    points, simplices, cells = _parts(dataset)
    made = mesh(points, simplices, **options)
    for (name, of_cells), values in _data(dataset, cells).items():
        if name.startswith("vtk") or name in _OWN:
            continue
        made.add(name, values, of_cells)
    return made


def to_pyvista(source: Any) -> Any:
    """A mesh or field as a pyvista.PolyData or UnstructuredGrid."""
    try:
        import pyvista
    except ImportError:
        raise Error("to_pyvista() needs PyVista: pip install pyvista.") from None
    points, cells = source.read("Position"), source.read("Corners", cells=True)
    with_counts = np.concatenate([np.full((len(cells), 1), cells.shape[1]), cells], axis=1).reshape(-1)
    if cells.shape[1] == 3:
        made = pyvista.PolyData(points, with_counts)
    else:
        made = pyvista.UnstructuredGrid(with_counts, np.full(len(cells), _TETRA, np.uint8), points)
    for place, data in (("vertices", made.point_data), ("cells", made.cell_data)):
        for name in source.columns[place]:
            if name != "Position":
                data[name] = source.read(name, cells=place == "cells")
    return made
