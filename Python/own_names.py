# SPDX-License-Identifier: BSD-3-Clause
"""Gives shared libraries names of their own, by which they are found among others of the same name.

The dynamic loader takes a library that a process has already for any other of the same SONAME: where
another package has loaded its libcholmod.so.3, ours would be ignored. A library that a wheel carries is
therefore called after its content. Names keep their length, so that they are replaced where they are.
"""

import base64
import hashlib
import struct

_LOAD, _DYNAMIC = 1, 2  # types of segments
_NEEDED, _TABLE, _SIZE, _SONAME = 1, 5, 10, 14  # tags of dynamic entries: names, and their table


def own_name(name, data):
    """A name of the same length for a library of this content: libcholmod-oqtd for libcholmod.so.3."""
    digest = base64.b32encode(hashlib.sha256(data).digest()).decode().lower()
    return (name.split(".so")[0] + "-" + digest)[: len(name)]


class _Dynamic:
    """The dynamic section of a shared library in the ELF format."""

    def __init__(self, data):
        if data[:4] != b"\x7fELF":
            raise ValueError("not a shared library")
        is_64, order = data[4] == 2, "<" if data[5] == 1 else ">"
        header = struct.Struct(order + ("32xQ14xHH" if is_64 else "28xI10xHH"))
        offset, size, count = header.unpack_from(data)  # of the segments
        # Type, offset in the file, address, size in the file.
        segment = struct.Struct(order + ("I4xQQ8xQ" if is_64 else "III4xI"))
        segments = [segment.unpack_from(data, offset + i * size) for i in range(count)]
        entry = struct.Struct(order + ("qQ" if is_64 else "iI"))
        _, begin, _, length = next(each for each in segments if each[0] == _DYNAMIC)
        entries = list(entry.iter_unpack(data[begin : begin + length - length % entry.size]))
        values = dict(entries)
        _, at, address, _ = next(
            each for each in segments if each[0] == _LOAD and 0 <= values[_TABLE] - each[2] < each[3]
        )
        self.begin = at + values[_TABLE] - address  # of the table of names in the file
        self.end = self.begin + values[_SIZE]

        def name(place):
            start = self.begin + place
            return data[start : data.index(b"\0", start)].decode()

        self.soname = name(values[_SONAME]) if _SONAME in values else None
        self.needed = [name(value) for tag, value in entries if tag == _NEEDED]


def renamed(data, names):
    """The library with these {old: new} names of its own and of those that it needs.

    Raises ValueError if a name cannot be replaced.
    """
    before = _Dynamic(data)
    table = data[before.begin : before.end]
    for old, new in names.items():
        if len(old) != len(new):
            raise ValueError("%s and %s are not of one length" % (old, new))
        # Also where the versions of symbols name their library.
        table = table.replace(b"\0%s\0" % old.encode(), b"\0%s\0" % new.encode())
    changed = data[: before.begin] + table + data[before.end :]
    after = _Dynamic(changed)
    wanted = [names.get(name, name) for name in before.needed]
    if after.needed != wanted or after.soname != names.get(before.soname, before.soname):
        raise ValueError("the names in the library %s cannot be replaced" % before.soname)
    return changed
