# SPDX-License-Identifier: BSD-3-Clause
"""A writer of HDF5 files by the C library, for formats that ParaView cannot write."""

import ctypes
import ctypes.util

import numpy

library = ctypes.CDLL(ctypes.util.find_library("hdf5_serial") or "libhdf5_serial.so.103")
handle = ctypes.c_int64
for name in ("H5Fcreate", "H5Gcreate2", "H5Dcreate2", "H5Acreate2", "H5Screate_simple", "H5Screate", "H5Tcopy"):
    getattr(library, name).restype = handle
library.H5open()
TYPES = {name: handle.in_dll(library, f"H5T_NATIVE_{kind}_g").value
         for name, kind in (("float64", "DOUBLE"), ("int64", "INT64"), ("uint8", "UINT8"))}


def h(number):
    return handle(number)


class HdfFile:
    """Groups and datasets under one root group, with the attributes that VTKHDF wants."""

    def __init__(self, path, root, kind):
        self.file = library.H5Fcreate(path.encode(), ctypes.c_uint(2), h(0), h(0))
        self.root = root
        self.group("")
        self.attribute("", "Version", [2, 0])
        self.text("", "Type", kind)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        library.H5Fclose(h(self.file))

    def path(self, name):
        return (self.root + ("/" + name if name else "")).encode()

    def group(self, name):
        made = library.H5Gcreate2(h(self.file), self.path(name), h(0), h(0), h(0))
        library.H5Gclose(h(made))

    def dataset(self, name, values):
        values = numpy.ascontiguousarray(values)
        kind = TYPES[values.dtype.name]
        extents = (ctypes.c_uint64 * values.ndim)(*values.shape)
        space = library.H5Screate_simple(values.ndim, extents, None)
        made = library.H5Dcreate2(h(self.file), self.path(name), h(kind), h(space), h(0), h(0), h(0))
        assert library.H5Dwrite(h(made), h(kind), h(0), h(0), h(0), values.ctypes.data_as(ctypes.c_void_p)) >= 0
        library.H5Dclose(h(made))
        library.H5Sclose(h(space))

    def attribute(self, name, key, values):
        values = numpy.asarray(values, dtype="int64")
        extents = (ctypes.c_uint64 * max(values.ndim, 1))(*values.shape)
        space = library.H5Screate_simple(values.ndim, extents, None) if values.ndim else library.H5Screate(0)
        self.write(name, key, TYPES["int64"], space, values.ctypes.data_as(ctypes.c_void_p))

    def text(self, name, key, text):
        kind = library.H5Tcopy(handle.in_dll(library, "H5T_C_S1_g"))
        library.H5Tset_size(h(kind), ctypes.c_size_t(len(text)))
        self.write(name, key, kind, library.H5Screate(0), ctypes.c_char_p(text.encode()))

    def write(self, name, key, kind, space, values):
        library.H5Gopen2.restype = handle
        group = library.H5Gopen2(h(self.file), self.path(name), h(0))
        made = library.H5Acreate2(h(group), key.encode(), h(kind), h(space), h(0), h(0))
        assert library.H5Awrite(h(made), h(kind), values) >= 0
        library.H5Aclose(h(made))
        library.H5Gclose(h(group))
        library.H5Sclose(h(space))
