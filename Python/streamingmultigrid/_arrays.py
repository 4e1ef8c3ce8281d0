# SPDX-License-Identifier: BSD-3-Clause
"""NumPy arrays as tables of numbers that the library reads where they are."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from ._errors import InputError

TYPES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64")


class Array(ctypes.Structure):
    """`smg_array` of the C interface."""

    _fields_ = [
        ("data", ctypes.c_void_p),
        ("type", ctypes.c_int),
        ("rows", ctypes.c_int64),
        ("columns", ctypes.c_int64),
        ("row_stride", ctypes.c_int64),
        ("column_stride", ctypes.c_int64),
    ]


def _real(values: Any, name: str) -> np.ndarray:
    """`values` as an array of booleans or real numbers of any type; else raises InputError."""
    if isinstance(values, np.ma.MaskedArray):
        if np.ma.is_masked(values):
            raise InputError(
                "%s: %d values are masked: fill them, for example with .filled(0), or leave their "
                "vertices out of the region." % (name, np.count_nonzero(np.ma.getmaskarray(values)))
            )
        values = values.data
    try:
        array = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise InputError("%s: not an array of numbers: %s." % (name, error)) from None
    if array.dtype.kind not in "biuf":
        kind = {"c": "complex numbers", "O": "objects (or rows of different lengths)"}.get(
            array.dtype.kind, "of type %s" % array.dtype
        )
        raise InputError("%s: the values are %s; only real numbers can be used." % (name, kind))
    return array


def numbers(values: Any, name: str) -> np.ndarray:
    """`values` as an array of a type that the library knows, without a copy where it is one.

    Booleans become 0 and 1, other kinds of floating-point numbers and byte orders are converted.
    Raises InputError for what are not real numbers: masked, complex, text, objects, ragged lists.
    """
    array = _real(values, name)
    if array.dtype.kind == "b":
        return array.view(np.uint8)
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    if array.dtype.name not in TYPES:  # float16, longdouble
        array = array.astype(np.float64)
    return array


def table(values: np.ndarray) -> Array:
    """The array, of one or two dimensions, as the library takes it. Keep the array while it is used."""
    rows, columns = values.shape if values.ndim == 2 else (len(values), 1)
    return Array(
        values.ctypes.data,
        TYPES.index(values.dtype.name),
        rows,
        columns,
        values.strides[0],
        values.strides[1] if values.ndim == 2 else 0,
    )


def points_and_cells(points: Any, cells: Any) -> tuple:
    """The arrays of a mesh, checked: (n, 3) numbers and (m, 3) or (m, 4) integers. Points (n, 2) have
    z = 0."""
    points, cells = numbers(points, "points"), _real(cells, "cells")
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError("points: the shape is %s; it must be (n, 3), or (n, 2) with z = 0." % (points.shape,))
    if points.shape[1] == 2:
        points = np.concatenate([points, np.zeros((len(points), 1), points.dtype)], axis=1)
    if cells.ndim != 2 or cells.shape[1] not in (3, 4):
        raise InputError(
            "cells: the shape is %s; it must be (m, 3), triangles, or (m, 4), tetrahedra."
            % (cells.shape,)
        )
    if cells.dtype.kind not in "iu":
        raise InputError(
            "cells: the corners are of type %s; they must be integers, rows of points." % cells.dtype
        )
    return points, numbers(cells, "cells")


def copy(array: Array) -> np.ndarray:
    """A copy of a table of the library: (rows,) of one column, else (rows, columns)."""
    type_ = np.dtype(TYPES[array.type])
    if array.rows == 0 or array.columns == 0:
        values = np.empty((array.rows, array.columns), type_)
    else:
        strides = (array.row_stride, array.column_stride)
        reach = (array.rows - 1) * strides[0] + (array.columns - 1) * strides[1] + type_.itemsize
        memory = (ctypes.c_char * reach).from_address(array.data)
        values = np.ndarray((array.rows, array.columns), type_, memory, 0, strides).copy()
    return shaped(values, array.columns)


def vector(values: Any, name: str, rows: int) -> np.ndarray:
    """A right-hand side or initial values: (rows,) or (rows, k) numbers."""
    array = numbers(values, name)
    if array.ndim not in (1, 2) or array.shape[0] != rows:
        raise InputError(
            "%s: the shape is %s; it must be (%d,) or (%d, k)." % (name, array.shape, rows, rows)
        )
    return array


def counted(number: int, one: str, several: str = "") -> str:
    """"1 cell" or "2,034 cells"."""
    return "{:,} {}".format(number, one if number == 1 else several or one + "s")


def plain(value: Any) -> Any:
    """For JSON: what NumPy has a type of its own for."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise InputError("%r is neither a number, nor a text, nor a list of these." % (value,))


def shaped(values: np.ndarray, components: int) -> np.ndarray:
    """Values of the library: (n,) of one component, else (n, components)."""
    return values.reshape(-1) if components == 1 else values.reshape(-1, components)
