# SPDX-License-Identifier: BSD-3-Clause
"""Reads mesh files of every format that smg writes in a restored order, but of two files (TetGen), without smg."""

import array
import base64
import math
import struct
import sys
import xml.etree.ElementTree as xml
from typing import NamedTuple


class Mesh(NamedTuple):
    """Points and polygons or tetrahedra in the order of the file, corners from 0."""
    points: list
    cells: list
    single: bool  # whether the file's numbers are of single precision


def rounded(points):
    """The points rounded to single precision."""
    flat = array.array("f", [x for point in points for x in point])
    return list(zip(flat[0::3], flat[1::3], flat[2::3]))


def same_points(points, expected):
    """Whether the points are exactly equal; texts may hold the shortest digits that identify a number."""
    return (rounded(points) if rounded(expected) == expected else points) == expected


def triples(flat):
    return list(zip(flat[0::3], flat[1::3], flat[2::3]))


def mesh(points, cells, single):
    return Mesh(rounded(points) if single else points, cells, single)


def lists(flat):
    """The consecutive lists of `n a b c ...`."""
    result, at = [], 0
    while at < len(flat):
        count = flat[at]
        result.append(tuple(flat[at + 1:at + 1 + count]))
        at += 1 + count
    return result


PLY_CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
             "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
             "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def ply_elements(header):
    """(name, count, [(property, code, code of the list's length or None)]) of each element."""
    elements = []
    for words in map(str.split, header):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            isList = words[1] == "list"
            elements[-1][2].append((words[-1], PLY_CODES[words[-2]],
                                    PLY_CODES[words[2]] if isList else None))
    return elements


class PlyText:
    def __init__(self, data):
        self.words = iter(data.split())

    def take(self, code):
        word = next(self.words)
        return float(word) if code in "fd" else int(word)


class PlyBinary:
    def __init__(self, data, order):
        self.data, self.at = data, 0
        self.codes = {code: struct.Struct(order + code) for code in "bBhHiIfd"}

    def take(self, code):
        kind = self.codes[code]
        value, = kind.unpack_from(self.data, self.at)
        self.at += kind.size
        return value


def ply_rows(data):
    """(element, {property: value}) of each row of the elements."""
    head, _, body = data.partition(b"end_header\n")
    header = head.decode("latin-1").splitlines()
    form = next(line.split()[1] for line in header if line.startswith("format"))
    source = PlyText(body) if form == "ascii" else PlyBinary(
        body, "<" if form == "binary_little_endian" else ">")
    for name, count, properties in ply_elements(header):
        for _ in range(count):
            yield name, {key: source.take(code) if length is None else
                         tuple([source.take(code) for _ in range(source.take(length))])
                         for key, code, length in properties}


def ply_vertices(data):
    """{property: value} of each vertex."""
    return [row for name, row in ply_rows(data) if name == "vertex"]


def read_ply(data):
    header = data.partition(b"end_header\n")[0].decode("latin-1").splitlines()
    single = any(name == "vertex" and ("x", "f", None) in properties
                 for name, _, properties in ply_elements(header))
    points, cells = [], []
    for name, row in ply_rows(data):
        if name == "vertex":
            points.append((row["x"], row["y"], row["z"]))
        elif name == "face":
            cells.append(row.get("vertex_indices") or row["vertex_index"])
    return mesh(points, cells, single)


def read_obj(data):
    lines = [line.split() for line in data.decode().splitlines()]
    return mesh([tuple(map(float, line[1:4])) for line in lines if line and line[0] == "v"],
                [tuple(int(corner.split("/")[0]) - 1 for corner in line[1:])
                 for line in lines if line and line[0] == "f"], False)


def read_off(data):
    words = data.split()
    vertices, faces = int(words[1]), int(words[2])
    end = 4 + 3 * vertices
    cells = lists(list(map(int, words[end:])))
    assert len(cells) == faces
    return mesh(triples(list(map(float, words[4:end]))), cells, False)


def read_stl(data):
    """Each triangle has its own points."""
    if data.startswith(b"solid"):
        corners = [tuple(map(float, line.split()[1:])) for line in data.decode().splitlines()
                   if line.split()[:1] == ["vertex"]]
    else:
        count, = struct.unpack_from("<I", data, 80)
        assert len(data) == 84 + 50 * count
        corners = [row[k:k + 3] for row in struct.iter_unpack("<12f2x", data[84:])
                   for k in (3, 6, 9)]
    return mesh(corners, triples(range(len(corners))), not data.startswith(b"solid"))


def read_medit(data):
    """Tetrahedra if there are any, otherwise triangles and quadrilaterals."""
    words = data.split()
    single = words[words.index(b"MeshVersionFormatted") + 1] == b"1"

    def section(name, count):
        if name not in words:
            return []
        at = words.index(name) + 2
        rows = int(words[at - 1])
        return [tuple(words[i:i + count]) for i in range(at, at + rows * (count + 1), count + 1)]

    def cells(name, count):
        return [tuple(int(corner) - 1 for corner in row) for row in section(name, count)]

    points = [tuple(map(float, row)) for row in section(b"Vertices", 3)]
    return mesh(points, cells(b"Tetrahedra", 4) or
                cells(b"Triangles", 3) + cells(b"Quadrilaterals", 4), single)


def read_gmsh(data):
    """Versions 2.2 and 4.1 as text, nodes numbered from 1 in the order of the file."""
    words = data.split()
    at = words.index(b"$Nodes") + 1
    kinds = {2: 3, 3: 4, 4: 4}
    points, cells = [], []
    if words[1] == b"4.1":
        blocks = int(words[at])
        at += 4
        for _ in range(blocks):
            count = int(words[at + 3])
            at += 4 + count
            points += triples(list(map(float, words[at:at + 3 * count])))
            at += 3 * count
        at = words.index(b"$Elements") + 1
        blocks = int(words[at])
        at += 4
        for _ in range(blocks):
            count, corners = int(words[at + 3]), kinds[int(words[at + 2])]
            at += 4
            for i in range(at, at + count * (corners + 1), corners + 1):
                cells.append(tuple(int(word) - 1 for word in words[i + 1:i + 1 + corners]))
            at += count * (corners + 1)
    else:
        for i in range(at + 1, at + 1 + 4 * int(words[at]), 4):
            points.append(tuple(map(float, words[i + 1:i + 4])))
        at = words.index(b"$Elements") + 1
        count, at = int(words[at]), at + 1
        for _ in range(count):
            corners, tags = kinds[int(words[at + 1])], int(words[at + 2])
            at += 3 + tags
            cells.append(tuple(int(word) - 1 for word in words[at:at + corners]))
            at += corners
    return mesh(points, cells, False)


def read_abaqus(data):
    """Nodes and elements that are numbered from 1 in the order of the file."""
    points, cells, rows = [], [], None
    for line in data.decode().splitlines():
        if line.startswith("*"):
            rows = points if line.startswith("*NODE") else cells if line.startswith("*ELEMENT") else None
        elif rows is not None:
            number, *words = line.split(",")
            assert int(number) == len(rows) + 1
            rows.append(tuple(map(float, words)) if rows is points else tuple(int(word) - 1 for word in words))
    return mesh(points, cells, False)


def read_exodus(data):
    """Classic netCDF of 64-bit offsets: coordinates and the blocks of elements, of one time step at most."""
    assert data[:4] == b"CDF\2"
    at = 8

    def word():
        nonlocal at
        at += 4
        return struct.unpack_from(">I", data, at - 4)[0]

    def name():
        nonlocal at
        size = word()
        at += (size + 3) // 4 * 4
        return data[at - (size + 3) // 4 * 4:][:size]

    def entries():
        word()
        return range(word())

    def skip_attributes():
        nonlocal at
        for _ in entries():
            name()
            size = {2: 1, 4: 4, 5: 4, 6: 8}[word()]
            size *= word()
            at += (size + 3) // 4 * 4

    extents = [(name(), word())[1] for _ in entries()]
    skip_attributes()
    arrays = {}
    for _ in entries():
        key, shape = name(), [extents[word()] for _ in range(word())]
        skip_attributes()
        code = {2: "B", 4: "i", 5: "f", 6: "d"}[word()]
        word()
        begin, = struct.unpack_from(">Q", data, at)
        at += 8
        if 0 not in shape:  # that of results, which are records
            arrays[key] = code, shape, struct.unpack_from(">%d%s" % (math.prod(shape), code), data, begin)
    points = list(zip(*(arrays[b"coord" + axis][2] for axis in (b"x", b"y", b"z"))))
    cells = []
    for block in range(1, len(arrays[b"eb_prop1"][2]) + 1):
        _, (_, corners), numbers = arrays[b"connect%d" % block]
        cells += [tuple(number - 1 for number in numbers[i:i + corners]) for i in range(0, len(numbers), corners)]
    return mesh(points, cells, arrays[b"coordx"][0] == "f")


def read_legacy_vtk(data):
    """Binary files of versions before 5."""
    assert data.splitlines()[2] == b"BINARY"

    def numbers(keyword, code, per):
        at = data.index(keyword + b" ")
        end = data.index(b"\n", at)
        values = array.array(code)
        values.frombytes(data[end + 1:end + 1 + values.itemsize * per(data[at:end].split())])
        if sys.byteorder == "little":
            values.byteswap()
        return values

    single = data[data.index(b"\nPOINTS "):].split(None, 3)[2] == b"float"
    points = triples(numbers(b"POINTS", "f" if single else "d", lambda words: 3 * int(words[1])))
    keyword = b"CELLS" if b"UNSTRUCTURED_GRID" in data[:300] else b"POLYGONS"
    return mesh(points, lists(numbers(keyword, "i", lambda words: int(words[2]))), single)


XML_CODES = {"Float32": "f", "Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B"}


def xml_values(element):
    code = XML_CODES[element.get("type")]
    if element.get("format") == "ascii":
        return list(map(float if code in "fd" else int, element.text.split()))
    text = element.text.strip()
    size, = struct.unpack("=Q", base64.b64decode(text[:12], validate=True))
    values = array.array(code, base64.b64decode(text[12:], validate=True))
    assert len(values) * values.itemsize == size
    return values


def read_vtk_xml(data):
    root = xml.fromstring(data)
    place = next(root.iter("Points")).find("DataArray")
    arrays = {each.get("Name"): each
              for tag in ("Polys", "Cells") for part in root.iter(tag) for each in part}
    corners = xml_values(arrays["connectivity"])
    ends = xml_values(arrays["offsets"])
    cells = [tuple(corners[begin:end]) for begin, end in zip([0, *ends], ends)]
    return mesh(triples(xml_values(place)), cells, place.get("type") == "Float32")


# Those with polygons of any number of corners come first.
READERS = {".ply": read_ply, ".vtp": read_vtk_xml, ".vtu": read_vtk_xml, ".vtk": read_legacy_vtk, ".obj": read_obj,
           ".off": read_off, ".stl": read_stl, ".mesh": read_medit, ".msh": read_gmsh,
           ".inp": read_abaqus, ".e": read_exodus}
SURFACES = tuple(READERS)
SOLIDS = (".vtu", ".vtk", ".mesh", ".msh", ".inp", ".e")


def read_mesh(name):
    """Reads the mesh of a file, by its suffix."""
    with open(name, "rb") as file:
        data = file.read()
    return READERS[name[name.rindex("."):]](data)
