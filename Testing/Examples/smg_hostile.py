#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that are made to take memory, to take time or to look like something else: every command
ends with a result or one error within its memory limit, in a time like that of harmless files of the
same size, and neither shows nor writes what is not text."""

import base64
import json
import math
import os
import shutil
import signal
import struct
import subprocess
import time
import xml.etree.ElementTree as xml
import zlib

from program import SANITIZED, SMG

LIMIT = 16  # MiB, the least memory of a conversion
MOST = LIMIT + 96  # MiB resident: the program, its libraries, the limit and some blocks
HANG = 60  # seconds; all of it takes about one


def resident(process):
    """The most MiB of a process so far, unlike ru_maxrss without those of the program before it."""
    try:
        with open("/proc/%d/status" % process, encoding="ascii") as status:
            peaks = [line.split()[1] for line in status if line.startswith("VmHWM:")]
        return int(peaks[0]) / 1024 if peaks else 0
    except OSError:
        return 0


def measure(*arguments):
    """Runs smg; returns its code, output, errors, and the most MiB that were resident."""
    with open("stdout", "w+b") as out, open("stderr", "w+b") as err:
        child = subprocess.Popen([SMG, *map(str, arguments)], stdout=out, stderr=err,
                                 stdin=subprocess.DEVNULL)
        end = time.monotonic() + HANG
        peak = 0
        while child.poll() is None:
            peak = max(peak, resident(child.pid))
            if time.monotonic() > end:
                child.kill()
                child.wait()
                raise AssertionError(("endless", arguments))
            time.sleep(0.003)
        out.seek(0)
        err.seek(0)
        return child.returncode, out.read(), err.read(), peak


def check(*arguments, within=MOST, refused=None):
    """Expects success, or one error of one line; `refused`: a part of that error."""
    code, out, err, peak = measure(*arguments)
    label = (arguments, code, out[:300], err[:300])
    text = err.decode()
    assert code in (0, 1, 3), label
    if code == 1:
        assert out == b"" and text.count("\n") == 1 and text.startswith("smg: "), label
    assert refused is None or (code == 1 and refused in text), label
    # The memory of sanitizers is their own.
    assert SANITIZED or peak < within, (label, peak)
    return code, out.decode()


def compressed(data):
    """An array of a VTK file, compressed by zlib in one block, in base64."""
    block = zlib.compress(data, 1)
    head = struct.pack("<4Q", 1, len(data), len(data), len(block))
    return (base64.b64encode(head) + base64.b64encode(block)).decode()


def array(kind, name, components, data):
    return ('<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="binary">%s</DataArray>\n'
            % (kind, name, components, compressed(data)))


def write_grid(name, n, point_data="", cell_data="", field_data=""):
    """A .vtu file of n x n points."""
    points = b"".join(struct.pack("<3d", i, j, 0) for j in range(n) for i in range(n))
    cells = []
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i
            cells += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    with open(name, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
                   'header_type="UInt64" compressor="vtkZLibDataCompressor"><UnstructuredGrid>'
                   + field_data + '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<PointData>%s</PointData>'
                   "<CellData>%s</CellData>\n" % (n * n, len(cells), point_data, cell_data)
                   + "<Points>" + array("Float64", "Points", 3, points) + "</Points><Cells>"
                   + array("Int64", "connectivity", 1, b"".join(struct.pack("<3q", *c)
                                                                for c in cells))
                   + array("Int64", "offsets", 1, b"".join(struct.pack("<q", 3 * i + 3)
                                                           for i in range(len(cells))))
                   + array("UInt8", "types", 1, b"\5" * len(cells))
                   + "</Cells></Piece></UnstructuredGrid></VTKFile>\n")
    return len(cells)


def write_ply(name, points, triangles):
    with open(name, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n"
                   b"property float y\nproperty float z\nelement face %d\n"
                   b"property list uchar int vertex_indices\nend_header\n"
                   % (len(points), len(triangles)))
        file.write(b"".join(struct.pack("<3f", *p) for p in points))
        file.write(b"".join(struct.pack("<B3i", 3, *t) for t in triangles))


def write_json(name, value):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(value, file)


def commands(mesh):
    """Every command on a mesh, with an output of which nothing is left."""
    memory = ("--memory", LIMIT, "--quiet")
    yield "info", mesh, *memory
    yield "info", mesh, "--full", *memory
    yield "convert", mesh, "out.vsm", *memory
    yield "convert", mesh, "out.vtu", *memory
    yield "convert", mesh, "out.ply", *memory
    yield "solve", mesh, "out.vsm", "--problem", "p.json", "--memory", 32, "--quiet"
    yield "smooth", mesh, "out.vsm", "--size", 2, "--memory", 32, "--quiet"
    yield "distance", mesh, "out.vsm", "--from", '{"vertices": [0]}', "--memory", 32, "--quiet"
    yield "simplify", mesh, "out.ply", "--vertices", 100, *memory
    yield "preview", mesh, "out.vtp", "--points", 100, *memory


def wide_columns():
    """Columns of very many components, of zeros, which take no room in a file."""
    write_json("p.json", {"dirichlet": [{"vertices": [0], "value": 1}]})
    n = 30
    cells = 2 * (n - 1) * (n - 1)
    for components, count in ((4096, 1), (20000, 1), (1000, 4)):
        def columns(rows, components=components, count=count):
            return "".join(array("Float64", "c%d" % k, components, bytes(8 * components * rows))
                           for k in range(count))
        write_grid("wide.vtu", n, columns(n * n), columns(cells))
        for command in commands("wide.vtu"):
            check(*command)
        # Its blocks have fewer rows: a .vsm file of it is read in the same memory.
        code, _ = check("convert", "wide.vtu", "wide.vsm", "--memory", LIMIT, "--quiet")
        if code == 0:
            for command in commands("wide.vsm"):
                check(*command)
            os.remove("wide.vsm")


def many_columns():
    """Very many arrays: some are left out, with a note."""
    for count in (1000, 5000):
        write_grid("many.vtu", 3, "".join(array("Float32", "a%d" % k, 1, bytes(36))
                                          for k in range(count)))
        _, out = check("convert", "many.vtu", "many.vsm")
        assert ("are left out" in out) == (count > 4000), out
        for command in commands("many.vsm"):
            check(*command, within=math.inf)


def field_data():
    """Every command says what it leaves out of the file."""
    fields = "<FieldData>%s</FieldData>" % array("Float64", "mass", 1, bytes(8))
    write_grid("fields.vtu", 5, field_data=fields.replace("<DataArray", '<DataArray NumberOfTuples="1"'))
    for command in commands("fields.vtu"):
        out = check(*[word for word in command if word != "--quiet"])[1]
        assert out.count("Field data are left out, since a mesh has no place for them: 'mass'.") == 1, (command, out)
    check("info", "fields.vtu", "--report", "info.json", "--quiet")
    with open("info.json", encoding="utf-8") as file:
        assert "mass" in json.load(file)["notes"][0]


def no_files():
    """Whatever is read is a regular file: nothing waits for a pipe, or reads a device."""
    os.mkfifo("pipe")
    os.makedirs("folder", exist_ok=True)
    write_grid("grid.vtu", 5)
    places = ["pipe", "folder", "/dev/null", "/dev/zero"]
    for suffix in (".vsm", ".ply", ".vtu", ".pvtu", ".node", ".sma", ".vtkhdf"):
        os.mkfifo("pipe" + suffix)
        places.append("pipe" + suffix)
    for place in places:
        for command in commands(place):
            code, _ = check(*command, within=math.inf)
            assert code == 1, command
        for command in (("solve", "grid.vtu", "out.vsm", "--problem", place),
                        ("deform", "grid.vtu", "out.vsm", "--handles", place),
                        ("distance", "grid.vtu", "out.vsm", "--from", place)):
            code, _ = check(*command, within=math.inf)
            assert code == 1, command


def descriptions():
    """Descriptions of any size and shape."""
    write_grid("grid.vtu", 5)
    with open("large.json", "wb") as file:
        file.truncate(2 << 30)
    with open("deep.json", "w", encoding="utf-8") as file:
        file.write("[" * 5_000_000)
    for name, refused in (("large.json", "16 MiB"), ("deep.json", "more than 100")):
        for command in (("solve", "grid.vtu", "out.vsm", "--problem", name),
                        ("deform", "grid.vtu", "out.vsm", "--handles", name),
                        ("distance", "grid.vtu", "out.vsm", "--from", name)):
            check(*command, refused=refused)
        os.remove(name)
    # Long lists take a time that is linear in their length.
    n = 10000 if SANITIZED else 100000
    write_json("p.json", {"dirichlet": [{"vertices": [k % 25], "value": 0} for k in range(n)]})
    write_json("f.json", [{"vertices": [k % 25]} for k in range(n)])
    check("solve", "grid.vtu", "out.vsm", "--problem", "p.json", within=math.inf)
    check("distance", "grid.vtu", "out.vsm", "--from", "f.json", within=math.inf)


def rim(n):
    return [(math.cos(2 * math.pi * i / n) * (1 + 0.1 * math.sin(50 * i / n)),
             math.sin(2 * math.pi * i / n), 0.3 * math.sin(40 * i / n)) for i in range(n)]


def stars():
    """Vertices and edges of very many triangles."""
    n = 20000 if SANITIZED else 100000
    points = [(0, 0, 1), (0, 0, -1)] + rim(n)
    for name, triangles in (
            ("hub", [(0, 2 + i, 2 + (i + 1) % n) for i in range(n)]),
            ("open hub", [(0, 2 + i, 3 + i) for i in range(n - 1)]),
            ("fans", [(0, 2 + i, 3 + i) for i in range(0, n - 1, 2)]),
            ("two hubs", [(0, 2 + i, 2 + (i + 1) % n) for i in range(n)]
             + [(1, 2 + (i + 1) % n, 2 + i) for i in range(n)]),
            ("book", [(0, 1, 2 + i) for i in range(n)])):
        write_ply("star.ply", points, triangles)
        code, _ = check("simplify", "star.ply", "out.ply", "--vertices", 1000, "--quiet",
                        within=math.inf)
        assert code == 0, name
        check("preview", "star.ply", "out.vtp", "--points", 1000, "--quiet", within=math.inf)


def interruption():
    """A signal ends a simplification within a second, also while a window is simplified."""
    n = 60 if SANITIZED else 400
    points = [(i, j, math.sin(i * 0.1) * math.cos(j * 0.13) * 9) for j in range(n) for i in range(n)]
    cells = []
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i
            cells += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    write_ply("large.ply", points, cells)
    whole = time.monotonic()
    check("simplify", "large.ply", "out.ply", "--vertices", 1000, "--quiet", within=math.inf)
    whole = time.monotonic() - whole
    for share in (0.2, 0.4, 0.6, 0.8):
        child = subprocess.Popen([SMG, "simplify", "large.ply", "out.ply", "--vertices", "1000",
                                  "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(share * whole)
        begin = time.monotonic()
        child.send_signal(signal.SIGTERM)
        child.communicate(timeout=HANG)
        late = time.monotonic() - begin
        # A second on an idle machine.
        assert SANITIZED or late < 10, (share, late)


def names():
    """Names with control characters and bytes that are not UTF-8 are cleaned where they are shown,
    and in files that cannot have them."""
    n = 5
    odd = ("red\x1b[31m", "a&#10;b&#9;c", "caf\xe9", "\x9b2J", "dup\x01", "dup\x02", "x'<&amp;>")
    data = "".join(array("Float32", name.replace("\x1b", "&#27;").replace("\x01", "&#1;")
                         .replace("\x02", "&#2;").replace("<", "&lt;").replace("&amp;>", "&amp;"),
                         1, bytes(4 * n * n)) for name in odd)
    write_grid("names.vtu", n, data)
    # Bytes of another encoding.
    with open("names.vtu", "rb") as file:
        content = file.read()
    with open("names.vtu", "wb") as file:
        file.write(content.replace("caf\xe9".encode(), b"caf\xe9").replace(
            "\x9b2J".encode(), b"\x9b2J"))
    with open("names.ply", "wb") as file:
        file.write(b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   b"property float z\nproperty float caf\xe9\nproperty float e\x1b[31m\n"
                   b"property float e\x02[31m\n"
                   b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   b"0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n")
    for mesh in ("names.vtu", "names.ply"):
        check("convert", mesh, "names.vsm", "--quiet")
        for source in (mesh, "names.vsm"):
            for option in ((), ("--full",)):
                _, out = check("info", source, *option, "--report", "report.json")
                assert all(line.isprintable() for line in out.splitlines()), out
                with open("report.json", encoding="utf-8") as file:
                    json.load(file)
            check("info", source, "--report", "report.html")
            with open("report.html", encoding="utf-8") as file:
                assert all(c.isprintable() or c in "\n\t" for c in file.read())
            for suffix in (".vtu", ".vtp", ".vtk", ".ply"):
                _, out = check("convert", source, "out" + suffix)
                assert all(line.isprintable() for line in out.splitlines()), out
                if suffix in (".vtu", ".vtp"):
                    arrays = [a.get("Name") for a in xml.parse("out" + suffix).iter("DataArray")]
                    assert len(set(arrays)) == len(arrays), arrays
                check("info", "out" + suffix)
            check("solve", source, "out.vsm", "--problem", '{"source": "none\x1b"}',
                  refused="none")


def main():
    for entry in os.listdir("."):  # remains of an earlier run
        shutil.rmtree(entry) if os.path.isdir(entry) else os.remove(entry)
    wide_columns()
    many_columns()
    field_data()
    no_files()
    descriptions()
    stars()
    interruption()
    names()


if __name__ == "__main__":
    main()
