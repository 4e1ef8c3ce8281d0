#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""No command overwrites a file that it reads, or one of its results with another: every file that a
command writes, with the name of every other file that it uses, also through a link."""

import gzip
import json
import lzma
import os
import shutil
import subprocess

from program import run, write_medit, write_ply
from tetrahedra import tetrahedra
from torus import torus

STREAMED = ("--threads", "1")
# Meshes with all their files, and a result of the same cells.
MESHES = {"t.vsm": ["t.vsm"], "t.ply": ["t.ply"], "t.sma": ["t.sma"], "s.node": ["s.node", "s.ele"],
          "s.ele": ["s.node", "s.ele"], "s.node.gz": ["s.node.gz", "s.ele"],
          "s.pvtu": ["s.pvtu", "pieces/s.vtu"], "s.vsm": ["s.vsm"],
          "z.pvtu.gz": ["z.pvtu.gz", "pieces/z.vtu.gz"]}
# The second file of a result.
WITH_SECOND = {".node": ".ele", ".ele": ".node"}


def write_inputs():
    write_ply("t.ply", *torus(12, 8), {"patch": ("int", [i % 2 for i in range(96)]),
                                       "heat": ("double", [i / 7 for i in range(96)])})
    write_medit("s.mesh", *tetrahedra(3))
    run("convert", "t.ply", "t.vsm", "--quiet")
    run("convert", "t.vsm", "t.sma", "--quiet")
    run("convert", "s.mesh", "s.vsm", "--quiet")
    run("convert", "s.vsm", "s.node", "--quiet")
    os.makedirs("pieces", exist_ok=True)
    run("convert", "s.vsm", "pieces/s.vtu", "--quiet")
    with open("s.pvtu", "w", encoding="utf-8") as file:
        file.write('<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>'
                   '<Piece Source="pieces/s.vtu"/></PUnstructuredGrid></VTKFile>\n')
    # The index names the piece as it was before it was compressed.
    with gzip.open("z.pvtu.gz", "wt", encoding="utf-8") as file:
        file.write('<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>'
                   '<Piece Source="pieces/z.vtu"/></PUnstructuredGrid></VTKFile>\n')
    with open("pieces/s.vtu", "rb") as plain, gzip.open("pieces/z.vtu.gz", "wb") as packed:
        shutil.copyfileobj(plain, packed)
    with open("s.node", "rb") as plain, gzip.open("s.node.gz", "wb") as packed:
        shutil.copyfileobj(plain, packed)
    with open("where.json", "w", encoding="utf-8") as file:
        json.dump({"halfspace": [1, 0, 0, 0]}, file)
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"halfspace": [1, 0, 0, 0], "value": [0]}], "source": 1}, file)
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": {"halfspace": [1, 0, 0, 0]}, "translate": [0, 0, 1]}]}, file)


def commands():
    """Each command with its mesh and further inputs; OUT stands for the result."""
    for mesh in MESHES:
        is_surface = mesh[0] == "t"
        yield mesh, (), ("info", mesh)
        yield mesh, (), ("convert", mesh, "OUT")
        yield mesh, (), ("preview", mesh, "OUT", "--points", "100")
        yield mesh, ("problem.json",), ("solve", mesh, "OUT", "--problem", "problem.json", "--trace", "TRACE", *STREAMED)
        yield mesh, ("where.json",), ("distance", mesh, "OUT", "--from", "where.json", *STREAMED)
        yield mesh, ("handles.json",), ("deform", mesh, "OUT", "--handles", "handles.json", *STREAMED)
        if is_surface:
            yield mesh, (), ("simplify", mesh, "OUT", "--vertices", "50")
            yield mesh, ("where.json",), ("smooth", mesh, "OUT", "--hold", "where.json", *STREAMED)
            yield mesh, ("where.json",), ("blend", mesh, "OUT", "--patch", "patch", "--columns", "heat",
                                          "--hold", "where.json", *STREAMED)


def contents():
    return {os.path.join(place, name): open(os.path.join(place, name), "rb").read()
            for place, _, names in os.walk(".") for name in names}


def put(arguments, **names):
    return [names.get(word, word) for word in arguments]


def refused(arguments, what, before):
    """Expects an error, by which no file is changed or made."""
    error = run(*arguments, code=1).stderr
    assert what in error, (arguments, error)
    assert contents() == before, arguments


def test_table():
    write_inputs()
    for name in ("t.vsm", "s.ele", "where.json"):
        os.symlink(name, "link-" + name)
    before = contents()
    count = 0
    for mesh, further, arguments in commands():
        out = "o.vtp" if mesh[0] == "t" or arguments[0] == "preview" else "o.vtu"
        victims = [*MESHES[mesh], *further]
        victims += ["link-" + name for name in victims if os.path.lexists("link-" + name)]
        traced = put(arguments, OUT=out, TRACE="o.csv")
        for victim in (*victims, *(("o.csv",) if "TRACE" in arguments else ()),
                       *((out,) if "OUT" in arguments else ())):
            refused([*traced, "--report", "./" + victim], "would overwrite it", before)
            count += 1
        for victim in (*victims, out) if "TRACE" in arguments else ():
            refused(put(arguments, OUT=out, TRACE=victim), "would overwrite it", before)
            count += 1
        for victim in victims if "OUT" in arguments else ():
            # A name that is none of a result is refused for that.
            refused(put(arguments, OUT=victim, TRACE="o.csv"), victim.removeprefix("link-"), before)
            count += 1
    assert count > 200, count
    for mesh, out in (("s.node", "s.ele"), ("s.ele", "s.node"), ("s.node.gz", "s.node"), ("s.pvtu", "pieces/s.vtu")):
        refused(("convert", mesh, out), "would overwrite it", before)
    # The second file of a result.
    shutil.copy("s.vsm", "r.ele")
    before = contents()
    refused(("convert", "r.ele", "r.node"), "would overwrite it", before)
    refused(("convert", "s.vsm", "q.node", "--report", "q.ele"), "would overwrite it", before)
    run("convert", "s.vsm", "q.node", "--report", "q.json", "--quiet")


def test_compressed_pieces():
    """A mesh in pieces is the same however index and pieces are compressed, each by itself."""
    packers = {"": None, ".gz": gzip.open, ".xz": lzma.open}
    if shutil.which("zstd"):
        packers[".zst"] = None

    def pack(text, name, suffix):
        if packers[suffix]:
            with packers[suffix](name + suffix, "wb") as file:
                file.write(text)
            return
        with open(name, "wb") as file:
            file.write(text)
        if suffix:
            subprocess.run(["zstd", "--quiet", "--rm", name], check=True)

    with open("pieces/s.vtu", "rb") as file:
        piece = file.read()
    run("convert", "s.pvtu", "expected.vtu", "--order", "keep", "--quiet")
    with open("expected.vtu", "rb") as file:
        expected = file.read()
    for of_index in packers:
        for of_piece in packers:
            for named in {"", of_piece}:
                shutil.rmtree("packed", ignore_errors=True)
                os.makedirs("packed/in")
                pack(piece, "packed/in/p.vtu", of_piece)
                index = ('<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>'
                         '<Piece Source="in/p.vtu%s"/></PUnstructuredGrid></VTKFile>\n' % named)
                pack(index.encode(), "packed/a.pvtu", of_index)
                mesh = "packed/a.pvtu" + of_index
                run("convert", mesh, "found.vtu", "--order", "keep", "--quiet")
                with open("found.vtu", "rb") as file:
                    assert file.read() == expected, (of_index, of_piece, named)
                error = run("info", mesh, "--report", "packed/in/p.vtu" + of_piece, code=1).stderr
                assert "would overwrite it" in error, error
    # An error names the compressed file.
    pack(piece[:len(piece) // 2], "packed/in/broken.vtu", ".gz")
    pack(index.replace("in/p.vtu" + named, "in/broken.vtu").encode(), "packed/broken.pvtu", "")
    error = run("convert", "packed/broken.pvtu", "found.vtu", code=1).stderr
    assert "broken.vtu.gz" in error and "piece0" not in error, error


def test_linked_folders():
    """Files that do not exist yet are one also through a link to their folder, or a link in its path."""
    os.makedirs("real/inner", exist_ok=True)
    os.symlink("real", "lnk")
    os.symlink("real/inner", "deep")
    before = contents()
    for first, second in (("real/a", "lnk/a"), ("lnk/a", "real/a"), ("real/a", "lnk/inner/../a"),
                          ("real/a", "deep/../a"), ("real/inner/a", "deep/a"), ("lnk/inner/a", "./deep/a")):
        refused(("convert", "s.mesh", first + ".node", "--report", second + ".ele"), "would overwrite it", before)
        refused(("convert", "s.mesh", first + ".vsm", "--report", second + ".vsm"), "would overwrite it", before)
    run("convert", "s.mesh", "real/a.node", "--report", "deep/a.ele", "--quiet")


def test_folders():
    """A folder that is removed at the end is no place for scratch files."""
    os.makedirs("folder", exist_ok=True)
    for scratch in ("folder", "./folder/", "folder/inner"):
        os.makedirs(scratch, exist_ok=True)
        for arguments in (("solve", "t.vsm", "o.vtp", "--problem", "problem.json"),
                          ("convert", "t.ply", "o.vsm"), ("simplify", "t.vsm", "o.ply", "--vertices", "50")):
            error = run(*arguments, "--checkpoint", "folder", "--scratch", scratch, code=1).stderr
            assert "choose another folder for --scratch" in error, error
            assert os.path.isdir(scratch)
        shutil.rmtree("folder/inner", ignore_errors=True)
    run("convert", "t.ply", "o.vsm", "--checkpoint", "new", "--scratch", "folder", "--quiet")
    assert os.listdir("folder") == [] and not os.path.exists("new")


for entry in os.listdir("."):  # remains of an earlier run
    shutil.rmtree(entry) if os.path.isdir(entry) and not os.path.islink(entry) else os.remove(entry)
for each in (test_table, test_compressed_pieces, test_linked_folders, test_folders):
    each()
    print("passed", each.__name__)
