# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program smg and reads its output, for the scripts of this folder."""

import base64
import json
import os
import re
import struct
import subprocess
import xml.etree.ElementTree as xml

from torus import torus

SMG = os.environ["SMG_PROGRAM"]
# Under sanitizers, which slow down each start of smg to a tenth of a second, the meshes of some tests
# are smaller.
SANITIZED = os.environ.get("SMG_SANITIZED") == "1"


class Combinations:
    """All combinations that loops visit; under sanitizers every seventh, as in the tests in C++."""

    def __init__(self):
        self.visited = 0

    def next(self):
        """Whether the next combination is to be tested."""
        self.visited += 1
        return not SANITIZED or self.visited % 7 == 1


# Commands that would make the tests wait for the disk.
WRITING = ("blend", "convert", "deform", "distance", "smooth", "solve")


# A line of progress, which smg writes every ten seconds: on slow machines.
PROGRESS = r"smg: [a-z ]+: [0-9.]+ %(, \d+ of \d+ MiB)?(, \d+ s left)?\n"


def run(*arguments, code=0):
    """Runs smg and expects this exit code; an error must be exactly one line."""
    no_sync = ["--no-sync"] if arguments and arguments[0] in WRITING else []
    done = subprocess.run([SMG, *map(str, arguments), *no_sync], capture_output=True, text=True,
                          timeout=1200)
    done.stderr = re.sub(PROGRESS, "", done.stderr)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    if code not in (0, 3):  # 3: not converged; the result is written
        assert done.stdout == "", (arguments, done.stdout)
        assert done.stderr.count("\n") == 1 and done.stderr.startswith("smg: "), done.stderr
    return done


def load(name):
    """The contents of a JSON file."""
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def read_vtk_xml(name):
    """The arrays of a .vtp or .vtu file, by name, as tuples."""
    codes = {"Float32": "f", "Float64": "d", "Int64": "q", "Int32": "i", "UInt16": "H", "UInt8": "B"}
    arrays = {}
    root = xml.parse(name).getroot()
    of_field = list(root.iterfind("*/FieldData/DataArray"))
    for array in root.iter("DataArray"):
        if array in of_field:
            assert array.get("format") == "ascii"
            continue
        assert array.get("format") == "binary"
        # The number of bytes is encoded separately.
        text = array.text.strip()
        size, = struct.unpack("=Q", base64.b64decode(text[:12], validate=True))
        data = base64.b64decode(text[12:], validate=True)
        assert len(data) == size, (name, array.attrib, size, len(data))
        components = array.get("NumberOfComponents")
        arrays[array.get("Name")] = list(struct.iter_unpack(
            "=" + components + codes[array.get("type")], data))
    return arrays


def write_torus(name, nu, nv):
    """The torus as an OBJ file."""
    points, quadrangles = torus(nu, nv)
    with open(name, "w", encoding="utf-8") as file:
        for point in points:
            file.write("v %.9g %.9g %.9g\n" % point)
        for quadrangle in quadrangles:
            file.write("f %d %d %d %d\n" % tuple(corner + 1 for corner in quadrangle))


def write_medit(name, points, cells, triangles=()):
    """Tetrahedra, and triangles, as a Medit file."""
    with open(name, "w", encoding="utf-8") as file:
        file.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points))
        file.writelines("%r %r %r 0\n" % point for point in points)
        for section, rows in (("Triangles", triangles), ("Tetrahedra", cells)):
            if rows:
                file.write("%s\n%d\n" % (section, len(rows)))
                file.writelines(" ".join(str(i + 1) for i in row) + " 0\n" for row in rows)
        file.write("End\n")


def write_ply(name, points, cells, columns=(), kind="double"):
    """A surface as an ASCII PLY file; `columns`: {name: (PLY type, a number for each point)}."""
    columns = dict(columns)
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        file.writelines("property %s %s\n" % (kind, axis) for axis in "xyz")
        file.writelines("property %s %s\n" % (of, column) for column, (of, _) in columns.items())
        file.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(cells))
        for row in zip(points, *(values for _, values in columns.values())):
            file.write(" ".join(map(repr, (*row[0], *row[1:]))) + "\n")
        file.writelines(" ".join(map(str, (len(cell), *cell))) + "\n" for cell in cells)
