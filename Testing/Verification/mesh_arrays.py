# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with columns as NumPy arrays: written as legacy VTK files, which smg reads, and read from the
.vtp and .vtu files that smg writes."""
import base64
import xml.etree.ElementTree as xml

import numpy as np

XML_TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int16": "i2",
             "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}
LEGACY_TYPES = {"f4": "float", "f8": "double", "i4": "int"}


def read_arrays(name):
    """All arrays of a .vtp or .vtu file written by smg, by name; positions are `Points`."""
    arrays = {}
    for element in xml.parse(name).getroot().iter("DataArray"):
        text = element.text.strip()
        # The number of bytes is encoded separately.
        size = int(np.frombuffer(base64.b64decode(text[:12]), "u8")[0])
        data = base64.b64decode(text[12:])
        assert len(data) == size, (name, element.attrib, size, len(data))
        values = np.frombuffer(data, XML_TYPES[element.get("type")])
        components = int(element.get("NumberOfComponents", "1"))
        arrays[element.get("Name")] = values.reshape(-1, components) if components > 1 else values
    return arrays


def _write_big_endian(file, values):
    kind = values.dtype.newbyteorder(">")
    file.write(np.ascontiguousarray(values, dtype=kind).tobytes() + b"\n")


def _write_columns(file, columns):
    file.write(b"FIELD columns %d\n" % len(columns))
    for name, values in columns.items():
        values = np.asarray(values)
        components = 1 if values.ndim == 1 else values.shape[1]
        kind = LEGACY_TYPES[values.dtype.str[1:]]
        file.write(f"{name} {components} {len(values)} {kind}\n".encode())
        _write_big_endian(file, values)


def write_legacy_vtk(name, points, cells, vertex_columns=None, cell_columns=None):
    """A binary .vtk file of triangles or tetrahedra.

    points          (vertices, 3) of float or double
    cells           (cells, 3 or 4)
    vertex_columns  {name: (vertices,) or (vertices, components)} of float, double or int; the same
    cell_columns    of the cells
    """
    corners = cells.shape[1]
    rows = np.hstack([np.full((len(cells), 1), corners), cells]).astype("i4")
    with open(name, "wb") as file:
        file.write(b"# vtk DataFile Version 3.0\nmesh\nBINARY\nDATASET %s\n"
                   % (b"POLYDATA" if corners == 3 else b"UNSTRUCTURED_GRID"))
        file.write(f"POINTS {len(points)} {LEGACY_TYPES[points.dtype.str[1:]]}\n".encode())
        _write_big_endian(file, points)
        keyword = "POLYGONS" if corners == 3 else "CELLS"
        file.write(f"{keyword} {len(cells)} {rows.size}\n".encode())
        _write_big_endian(file, rows)
        if corners == 4:
            file.write(b"CELL_TYPES %d\n" % len(cells))
            _write_big_endian(file, np.full(len(cells), 10, "i4"))
        for keyword, count, columns in (("POINT_DATA", len(points), vertex_columns),
                                        ("CELL_DATA", len(cells), cell_columns)):
            if columns:
                file.write(f"{keyword} {count}\n".encode())
                _write_columns(file, columns)
