#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damaged files of every format: smg returns 1, prints one line and leaves no files."""

import base64
import json
import math
import os
import random
import re
import struct
import subprocess
import sys

from program import SMG, Combinations
from tetrahedra import tetrahedra
from torus import torus

COMBINATIONS = Combinations()
# A coordinate that occurs once in the meshes, to be replaced by NaN.
MARK = 1234.5


def marked_torus(nu=24, nv=12):
    points, quadrangles = torus(nu, nv)
    points[5] = (MARK, points[5][1], points[5][2])
    cells = []
    for a, b, c, d in quadrangles:
        cells += [(a, b, c), (a, c, d)]
    return points, cells


def marked_tetrahedra():
    points, cells = tetrahedra(4)
    points[5] = (MARK,) + points[5][1:]
    return points, cells


def rows(tuples, offset=0, head=""):
    return "".join(head + " ".join(str(v + offset) for v in t) + "\n" for t in tuples)


def ply(points, cells):
    return ("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
            "end_header\n" % (len(points), len(cells))
            + rows(points) + rows(cells, head="3 ")).encode()


def binary_ply(points, cells):
    head = ply(points, cells).split(b"end_header\n")[0].replace(b"ascii", b"binary_little_endian")
    return (head + b"end_header\n" + b"".join(struct.pack("<3f", *p) for p in points)
            + b"".join(struct.pack("<B3i", 3, *c) for c in cells))


def obj(points, cells):
    return (rows(points, head="v ") + rows(cells, 1, "f ")).encode()


def off(points, cells):
    return ("OFF\n%d %d 0\n" % (len(points), len(cells)) + rows(points)
            + rows(cells, head="3 ")).encode()


def stl(points, cells):
    loops = ("facet normal 0 0 0\nouter loop\n" + rows([points[i] for i in c], head="vertex ")
             + "endloop\nendfacet\n" for c in cells)
    return ("solid x\n" + "".join(loops) + "endsolid x\n").encode()


def binary_stl(points, cells):
    return (b"\0" * 80 + struct.pack("<I", len(cells)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in c for x in points[i]), 0) for c in cells))


def legacy(points, cells):
    return ("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS %d double\n%sPOLYGONS "
            "%d %d\n" % (len(points), rows(points), len(cells), 4 * len(cells))
            + rows(cells, head="3 ")).encode()


def vtu(points, cells):
    count = len(cells[0]) if cells else 3
    arrays = (("connectivity", "Int64", rows(cells)),
              ("offsets", "Int64", rows((count * (i + 1),) for i in range(len(cells)))),
              ("types", "UInt8", ("10 " if count == 4 else "5 ") * len(cells)))
    return ('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
            'header_type="UInt64"><UnstructuredGrid><Piece NumberOfPoints="%d" NumberOfCells="%d">'
            '<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">%s'
            '</DataArray></Points><Cells>' % (len(points), len(cells), rows(points))
            + "".join('<DataArray type="%s" Name="%s" format="ascii">%s</DataArray>'
                      % (kind, name, text) for name, kind, text in arrays)
            + "</Cells></Piece></UnstructuredGrid></VTKFile>\n").encode()


def medit(points, cells):
    return ("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points)
            + "".join("%s %s %s 0\n" % p for p in points) + "Tetrahedra\n%d\n" % len(cells)
            + "".join("%d %d %d %d 0\n" % tuple(i + 1 for i in c) for c in cells)
            + "End\n").encode()


def gmsh(points, cells):
    return ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(points)
            + "".join("%d %s %s %s\n" % ((i + 1,) + p) for i, p in enumerate(points))
            + "$EndNodes\n$Elements\n%d\n" % len(cells)
            + "".join("%d 4 0 %d %d %d %d\n" % ((i + 1,) + tuple(v + 1 for v in c))
                      for i, c in enumerate(cells)) + "$EndElements\n").encode()


def convert(name, out, *options):
    return subprocess.run([SMG, "convert", name, out, "--quiet", *options], capture_output=True,
                          text=True, errors="replace", timeout=1200)


def samples():
    """A valid file of each format: (suffix, bytes)."""
    surface, solid = marked_torus(), marked_tetrahedra()
    files = [(".ply", ply(*surface)), (".ply", binary_ply(*surface)), (".obj", obj(*surface)),
             (".off", off(*surface)), (".stl", stl(*surface)), (".stl", binary_stl(*surface)),
             (".vtk", legacy(*surface)), (".vtu", vtu(*surface)), (".vtu", vtu(*solid)),
             (".mesh", medit(*solid)), (".msh", gmsh(*solid))]
    for name, data, suffixes in (("s.obj", obj(*surface), (".vsm", ".sma", ".smb", ".vtp", ".vtu")),
                                 ("s.mesh", medit(*solid), (".vsm", ".sva", ".svb", ".vtu"))):
        with open(name, "wb") as file:
            file.write(data)
        for suffix in suffixes:
            done = convert(name, "s" + suffix)
            assert done.returncode == 0, done.stderr
            with open("s" + suffix, "rb") as file:
                files.append((suffix, file.read()))
            os.remove("s" + suffix)
        os.remove(name)
    return files


def check(suffix, data, refused, what):
    """Expects one line and code 1 or, unless the file must be refused, success."""
    if not COMBINATIONS.next():
        return
    name = "damaged" + suffix
    with open(name, "wb") as file:
        file.write(data)
    before = sorted(os.listdir("."))
    done = convert(name, "out.vsm", "--scratch", ".")
    label = (suffix, what, done.returncode, done.stderr[:300])
    if done.returncode == 0:
        assert not refused and done.stderr == "", label
        os.remove("out.vsm")
    else:
        assert done.returncode == 1 and done.stdout == "", label
        assert done.stderr.count("\n") == 1 and done.stderr.startswith("smg: "), label
        assert done.stderr.isprintable() or done.stderr[:-1].isprintable(), label
    assert sorted(os.listdir(".")) == before, label
    os.remove(name)


def counts(suffix, data):
    """Vertices and cells of a valid file."""
    with open("sound" + suffix, "wb") as file:
        file.write(data)
    done = convert("sound" + suffix, "out.vsm", "--report", "report.json")
    assert done.returncode == 0 and done.stderr == "", (suffix, done.stderr)
    with open("report.json", encoding="utf-8") as file:
        report = json.load(file)
    for name in ("out.vsm", "report.json", "sound" + suffix):
        os.remove(name)
    return report["vertices"], report["isolated_vertices"], report["cells"]


def refuse(suffix, data, what, placed=True):
    """Expects one line that names the file and, for a single error, its position."""
    if not COMBINATIONS.next():
        return
    name = "damaged" + suffix
    with open(name, "wb") as file:
        file.write(data)
    before = sorted(os.listdir("."))
    done = convert(name, "out.vsm", "--scratch", ".")
    label = (suffix, what, done.returncode, done.stderr[:300])
    assert done.returncode == 1 and done.stdout == "", label
    assert done.stderr.count("\n") == 1 and done.stderr.startswith("smg: " + name), label
    place = r"(line|byte|point|vertex|cell|element|triangle|face|record|facet|node|tetrahedron) #?\d"
    assert not placed or re.search(place, done.stderr), label
    assert sorted(os.listdir(".")) == before, label
    os.remove(name)


def replace_last(data, old, new):
    """The bounds, which come first, may contain the same number."""
    before, _, after = data.rpartition(old)
    return before + new + after


def not_a_number(suffix, data):
    """The file with NaN as the marked coordinate."""
    nan = float("nan")
    for text in (b"1234.5", b"1.2345e+03", b"1234.500000"):
        if data.count(text) > 0:
            return replace_last(data, text, b"nan")
    for code in ("<f", "<d"):
        if struct.pack(code, MARK) in data:
            return replace_last(data, struct.pack(code, MARK), struct.pack(code, nan))
    # Inline binary data: the number begins at one of the three positions of a base64 group.
    for code in ("<f", "<d"):
        size = struct.calcsize(code)
        for start in data.split(b"<DataArray")[1:]:
            body = start[start.find(b">") + 1:start.find(b"</DataArray")]
            units = body.strip()
            try:
                raw = base64.b64decode(units[12:], validate=True)
            except ValueError:
                continue
            at = raw.find(struct.pack(code, MARK))
            if at >= 0 and at % size == 0:
                wrong = raw[:at] + struct.pack(code, nan) + raw[at + size:]
                return data.replace(units[12:], base64.b64encode(wrong), 1)
    assert suffix == ".vsm", "the marked coordinate is not in the sample " + suffix
    return None


def test_damage():
    chance = random.Random(1)
    for suffix, data in samples():
        counts(suffix, data)
        check(suffix, b"", True, "empty")
        check(suffix, b"\0" * 3000, True, "zeros")
        check(suffix, chance.randbytes(3000), True, "noise")
        for part in (0.001, 0.1, 0.5, 0.9, 0.98):
            check(suffix, data[:int(len(data) * part)], suffix != ".obj", "cut at %g" % part)
        wrong = not_a_number(suffix, data)
        if wrong:
            check(suffix, wrong, True, "nan")
        for length in (1, 3, 10):
            flipped = bytearray(data)
            for _ in range(length):
                flipped[chance.randrange(len(data))] = chance.randrange(256)
            check(suffix, bytes(flipped), False, "flipped %d" % length)
        head = bytearray(data)
        for _ in range(4):
            head[chance.randrange(min(300, len(data)))] = chance.randrange(256)
        check(suffix, bytes(head), False, "flipped at the beginning")


WRITERS = ((".ply", ply), (".ply", binary_ply), (".obj", obj), (".off", off), (".stl", stl),
           (".stl", binary_stl), (".vtk", legacy), (".vtu", vtu), (".mesh", medit),
           (".msh", gmsh))


def test_wrong_numbers():
    """Corners that are not vertices, and coordinates that are not numbers, with their positions."""
    for suffix, write in WRITERS:
        points, cells = marked_tetrahedra() if write in (medit, gmsh) else marked_torus()
        middle = len(cells) // 2
        # Negative numbers in OBJ count from the end.
        corners = (len(points), len(points) + 5, 2 ** 31 - 1, 2 ** 40, 2 ** 70,
                   -1 - 2 * len(points) if write is obj else -1, -2 ** 31, -2 ** 40)
        for corner in () if write in (stl, binary_stl) else corners:
            wrong = list(cells)
            wrong[middle] = (corner,) + cells[middle][1:]
            try:
                data = write(points, wrong)
            except struct.error:
                continue
            refuse(suffix, data, "corner %d" % corner)
        for x in (math.nan, math.inf, -math.inf):
            wrong = list(points)
            wrong[cells[middle][0]] = (0.0, x, 0.0)
            refuse(suffix, write(wrong, cells), "coordinate %r" % x)
        refuse(suffix, write(points, []), "no cells", placed=False)
        refuse(suffix, write([], []), "nothing", placed=False)


def test_wrong_counts():
    for suffix, write in WRITERS:
        if write in (obj, stl):
            continue
        points, cells = marked_tetrahedra() if write in (medit, gmsh) else marked_torus()
        data = write(points, cells)
        for count in (len(points), len(cells)):
            for other in (-1, 2 ** 62, 2 ** 31 - 1, count + 1, count - 1, 0):
                if write is binary_ply and other == len(points) + 1:
                    continue  # valid: one more vertex of 12 bytes, and an empty face of one byte instead of 13
                if write is binary_stl:
                    if count == len(points) or not 0 <= other < 2 ** 32:
                        continue
                    wrong = data[:80] + struct.pack("<I", other) + data[84:]
                else:
                    wrong = re.sub(rb"(?<![\d.])%d(?![\d.])" % count, b"%d" % other, data, count=1)
                assert wrong != data
                refuse(suffix, wrong, "%d instead of %d" % (other, count), placed=False)


def test_cuts():
    """A truncated file is refused, unless the missing part is irrelevant."""
    for suffix, write in WRITERS:
        if write is obj:
            continue
        data = write(*(marked_tetrahedra() if write in (medit, gmsh) else marked_torus(8, 6)))
        whole = counts(suffix, data)
        lines = [at + 1 for at in range(len(data)) if data[at:at + 1] == b"\n"]
        for cut in sorted({0, 1, *lines[:12], *lines[12::len(lines) // 12 or 1], *lines[-4:-1],
                           *range(0, len(data), len(data) // 12), len(data) - 2}):
            if not COMBINATIONS.next():
                continue
            name = "damaged" + suffix
            with open(name, "wb") as file:
                file.write(data[:cut])
            done = convert(name, "out.vsm", "--scratch", ".")
            if done.returncode == 0:
                os.remove("out.vsm")
                assert counts(suffix, data[:cut]) == whole, (suffix, write, cut, len(data))
                os.remove(name)
            else:
                refuse(suffix, data[:cut], "cut at %d of %d" % (cut, len(data)), placed=False)


def test_terminal_gets_no_escapes():
    check(".sma", b"v 0 0 0\n\x1b]0;x\x07 1\n", True, "escape sequence")


def test_crash_and_loop_of_the_reader():
    """Counts for which VTK's readers crash or loop."""
    data = vtu(*marked_torus())
    for count in (b"9223372036854775807", b"4611686018427387904", b"0", b"-1"):
        check(".vtu", data.replace(b'NumberOfComponents="3"', b'NumberOfComponents="' + count + b'"'),
              True, "components " + count.decode())
    data = legacy(*marked_torus())
    for field in (b"POINT_DATA 288\nFIELD f 1\na 9223372036854775807 288 float\n1 2 3\n",
                  b"POINT_DATA 288\nFIELD f 4294967295\na 1 288 float\n1 2 3\n",
                  b"POINT_DATA 288\nSCALARS s float -1\nLOOKUP_TABLE default\n1 2 3\n"):
        check(".vtk", data + field, False, field[:40].decode())


for each in (test_damage, test_wrong_numbers, test_wrong_counts, test_cuts,
             test_terminal_gets_no_escapes, test_crash_and_loop_of_the_reader):
    each()
    print("passed", each.__name__)
sys.exit(0)
