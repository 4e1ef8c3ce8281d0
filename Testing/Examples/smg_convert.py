#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg convert as a black box: no part of a mesh is lost, for any order, memory and format."""

import gzip
import json
import os
import sys

from mesh_files import SOLIDS, SURFACES, ply_vertices, read_mesh, same_points
from odd_mesh import are_triangles_of, fans, odd_solid, odd_surface
from program import load, run, write_medit, write_ply, write_torus
from tetrahedra import tetrahedra

ORDERS = ("bfs", "spectral", "axis", "keep")


def write_tagged_ply(name, points, cells, kind="double"):
    write_ply(name, points, cells, {"tag": ("int", range(len(points)))}, kind)


def convert(name, out, *arguments):
    """Converts and returns the report."""
    run("convert", name, out, "--quiet", "--report", "report.json", *arguments)
    return load("report.json")


def restore(vsm, suffix):
    """The mesh of the .vsm file in the order of the first file, via a file of this suffix."""
    name = "restored" + suffix
    run("convert", vsm, name, "--restore-order", "--quiet")
    return read_mesh(name)


def check_restored(vsm, suffix, points, cells):
    """Expects the given points and cells."""
    mesh = restore(vsm, suffix)
    if suffix == ".stl":
        assert are_triangles_of(cells, points, mesh.points), (vsm, suffix)
    else:
        assert mesh.cells == cells, (vsm, suffix)
        assert same_points(mesh.points, points), (vsm, suffix)


def test_restored_order():
    """Each format preserves points and cells when written and read."""
    points, cells = odd_surface()
    write_tagged_ply("odd.ply", points, cells)
    convert("odd.ply", "odd.vsm")
    assert "vertex 'tag'" in convert("odd.vsm", "odd.sma")["notes"][0]
    run("info", "odd.vsm", "--report", "info.json")
    assert load("info.json")["isolated_vertices"] == 9
    assert "isolated    9," in run("info", "odd.vsm").stdout
    few_points, few_cells = odd_surface(36, 18, largest=4)
    write_tagged_ply("few.ply", few_points, few_cells, "float")
    for order in ORDERS:
        convert("odd.ply", "odd.vsm", "--order", order)
        for suffix in SURFACES[:6]:
            check_restored("odd.vsm", suffix, points, cells)
            convert("odd.vsm", "axis.vsm", "--order", "axis")
            check_restored("axis.vsm", suffix, points, cells)
            convert("restored" + suffix, "again.vsm", "--order", "axis")
            check_restored("again.vsm", ".ply", points, cells)
        check_restored("odd.vsm", ".stl", points, cells)
        convert("few.ply", "few.vsm", "--order", order)
        by_kind = sorted(few_cells, key=len)
        for suffix, expected in ((".stl", few_cells), (".mesh", by_kind), (".msh", few_cells)):
            check_restored("few.vsm", suffix, few_points, expected)
            if suffix != ".stl":
                convert("restored" + suffix, "again.vsm")
                check_restored("again.vsm", ".ply", few_points, expected)
        assert load("report.json")["isolated_vertices"] == 9


def test_restored_solids():
    points, cells = odd_solid()
    write_medit("odd.mesh", points, cells)
    for order in ORDERS:
        report = convert("odd.mesh", "solid.vsm", "--order", order)
        assert report["duplicate_cells"] == 1 and report["isolated_vertices"] == 9
        for suffix in SOLIDS:
            check_restored("solid.vsm", suffix, points, cells)
            convert("restored" + suffix, "again.vsm", "--order", "spectral")
            check_restored("again.vsm", ".mesh", points, cells)
    assert "holds no tetrahedra" in run(
        "convert", "solid.vsm", "o.ply", "--restore-order", code=1).stderr
    assert not os.path.exists("o.ply")


def test_restored_is_the_same_file():
    """Columns are restored, too: the second restored file equals the first one."""
    convert("odd.ply", "odd.vsm", "--order", "spectral")
    run("convert", "odd.vsm", "first.ply", "--restore-order", "--quiet")
    convert("first.ply", "second.vsm", "--order", "axis", "--memory", 16)
    run("convert", "second.vsm", "second.ply", "--restore-order", "--quiet", "--memory", 16)
    with open("first.ply", "rb") as first, open("second.ply", "rb") as second:
        data = first.read()
        assert data == second.read() and b"tag" in data[:1000]


def test_moved_meshes_keep_their_order():
    """The results of deform and solve on a .vsm file are restored as well, with isolated points."""
    points, cells = odd_surface(48, 24)
    write_tagged_ply("odd.ply", points, cells)
    convert("odd.ply", "odd.vsm")
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [
            {"region": {"halfspace": [-1, 0, 0, 2.6]}, "fixed": True},
            {"region": {"halfspace": [1, 0, 0, 2.6]}, "translate": [0, 0, 1]}]}, file)
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"halfspace": [1, 0, 0, 2.6], "value": [1]}]}, file)
    run("deform", "odd.vsm", "moved.vsm", "--handles", "handles.json", "--quiet")
    used = {corner for cell in cells for corner in cell}
    for suffix in SURFACES[:6]:
        mesh = restore("moved.vsm", suffix)
        assert mesh.cells == cells, suffix
        moved = [after != before for before, after in zip(points, mesh.points)]
        assert len(mesh.points) == len(points) and sum(moved) > 100, suffix
        assert not any(moved[i] for i in range(len(points)) if i not in used), suffix
        assert all(abs(mesh.points[i][2] - points[i][2] - 1) < 1e-9 for i in used
                   if points[i][0] >= 2.6), suffix
    run("solve", "odd.vsm", "solved.vsm", "--problem", "problem.json", "--quiet")
    check_restored("solved.vsm", ".ply", points, cells)
    # Solving the input directly gives the same file.
    run("solve", "odd.ply", "direct.ply", "--problem", "problem.json", "--quiet", "--report", "report.json")
    with open("restored.ply", "rb") as restored, open("direct.ply", "rb") as direct:
        data = restored.read()
        assert data == direct.read() and b"Solution" in data[:1000]
    # A corner in the middle of a side of its polygon may be of cells without area alone.
    missing = {i for i, row in enumerate(ply_vertices(data)) if row["Solution"] != row["Solution"]}
    unused = set(range(len(points))) - used
    assert unused <= missing and len(missing - unused) == load("report.json")["held"]


def test_other_formats_in_the_order_of_the_stream():
    """Every format is written in stream order, too, and holds the same mesh."""
    write_torus("torus.obj", 40, 20)
    points, cells = read_mesh("torus.obj")[:2]
    triangles = fans(cells)
    for suffix in SURFACES:
        assert not convert("torus.obj", "kept" + suffix, "--order", "keep")["notes"]
        assert not convert("torus.obj", "bfs" + suffix)["notes"]
        run("convert", "kept" + suffix, "kept.vsm", "--quiet")
        run("convert", "bfs" + suffix, "bfs.vsm", "--quiet")
        for stream in ("kept.vsm", "bfs.vsm"):
            run("info", stream, "--report", "info.json")
            assert [load("info.json")[key] for key in ("vertices", "cells")] == [len(points), len(triangles)]
        if suffix != ".stl":
            assert read_mesh("kept" + suffix).cells == read_mesh("kept.ply").cells
            assert len(read_mesh("bfs" + suffix).points) == len(points)
    tets = tetrahedra(4)
    write_medit("tets.mesh", *tets)
    for suffix in SOLIDS:
        convert("tets.mesh", "bfs" + suffix)
        mesh = read_mesh("bfs" + suffix)
        used = [[mesh.points[corner] for corner in cell] for cell in mesh.cells]
        assert sorted(map(sorted, used)) == sorted(sorted(tets[0][corner] for corner in cell) for cell in tets[1]), suffix


def test_gzip_and_wrong_suffixes():
    """The content of a file determines its format, regardless of its name and compression."""
    convert("odd.ply", "odd.vsm", "--order", "keep")
    points, cells = read_mesh("odd.ply")[:2]
    write_medit("tets.mesh", *odd_solid())
    tets = odd_solid()
    convert("tets.mesh", "tets.vsm", "--order", "keep")
    for vsm, suffixes, expected in (("odd.vsm", SURFACES[:6], (points, cells)),
                                    ("tets.vsm", SOLIDS, tets)):
        for suffix in suffixes:
            run("convert", vsm, "plain" + suffix, "--restore-order", "--quiet")
            with open("plain" + suffix, "rb") as file:
                data = file.read()
            wrong = ".stl" if suffix != ".stl" else ".ply"
            with open("wrong" + wrong, "wb") as file:
                file.write(data)
            with gzip.open("packed" + suffix + ".gz", "wb") as file:
                file.write(data)
            with gzip.open("packed" + wrong, "wb") as file:
                file.write(data)
            for name in ("wrong" + wrong, "packed" + suffix + ".gz", "packed" + wrong):
                convert(name, "again.vsm", "--order", "axis")
                check_restored("again.vsm", ".vtu", *expected)


def test_compressed_streams():
    """Streams may be compressed, too; errors name the damaged file."""
    write_torus("stream.obj", 40, 30)
    run("convert", "stream.obj", "stream.vsm")
    for suffix in (".sma", ".smb", ".vsm"):
        if suffix != ".vsm":
            run("convert", "stream.vsm", "stream" + suffix, "--order", "keep")
        with open("stream" + suffix, "rb") as file:
            plain = file.read()
        with gzip.open("stream" + suffix + ".gz", "wb") as file:
            file.write(plain)
        run("convert", "stream" + suffix, "plain.vsm", "--order", "keep")
        run("convert", "stream" + suffix + ".gz", "packed.vsm", "--order", "keep")
        with open("plain.vsm", "rb") as one, open("packed.vsm", "rb") as other:
            assert one.read() == other.read(), suffix
    with open("stream.smb.gz", "rb") as file:
        packed = file.read()
    with open("cut.smb.gz", "wb") as file:
        file.write(packed[:len(packed) // 2])
    assert "cut.smb.gz" in run("convert", "cut.smb.gz", "no.vsm", code=1).stderr
    assert not os.path.exists("no.vsm")


def test_own_name():
    """A conversion does not overwrite its input."""
    write_torus("own.obj", 10, 8)
    with open("own.obj", "rb") as file:
        before = file.read()
    run("convert", "own.obj", "own.obj", code=1)
    run("convert", "stream.vsm", "./stream.vsm", code=1)
    with open("own.obj", "rb") as file:
        assert file.read() == before


def test_weld():
    """Triangles with separate points become a closed surface."""
    write_torus("torus.obj", 60, 30)
    mesh = read_mesh("torus.obj")
    triangles = fans(mesh.cells)
    for name, distance, weld in (("soup.ply", 0.0, 0), ("loose.ply", 1e-5, 1e-3)):
        soup = [tuple(x + distance * k for x in mesh.points[cell[k]])
                for cell in triangles for k in range(3)]
        write_tagged_ply(name, soup, [(i, i + 1, i + 2) for i in range(0, len(soup), 3)])
        report = convert(name, "soup.vsm")
        assert report["vertices"] == 3 * 3600 and report["components"] == 3600
        for order in ORDERS:
            report = convert(name, "welded.vsm", "--weld", weld, "--order", order)
            assert report["vertices"] == 1800 and report["cells"] == 3600, report
            assert report["merged_points"] == len(soup) - 1800, report
            assert report["isolated_vertices"] == 0, report
            assert report["components"] == 1 and report["boundary_edges"] == 0, report
            assert report["nonmanifold_edges"] == 0 and report["degenerate_cells"] == 0, report
    # The same holds when solving or deforming.
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"screening": 1, "source": 1}, file)
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": {"sphere": [0, 0, 0, 9]}, "translate": [1, 0, 0]}]}, file)
    for command in (("solve", "soup.ply", "o.vsm", "--problem", "problem.json"),
                    ("deform", "soup.ply", "o.vsm", "--handles", "handles.json"),
                    ("deform", "soup.ply", "moved_soup.ply", "--handles", "handles.json")):
        run(*command, "--weld", 0, "--report", "report.json", "--quiet")
        report = load("report.json")
        assert report["vertices"] == 1800 and report["cells"] == 3600, report
        error = run(command[0], "welded.vsm", *command[2:], "--weld", 0, code=1).stderr
        assert "welded.vsm" in error and "smg convert" in error, error
    # None of the merged points stays at its position.
    assert min(x for x, _, _ in read_mesh("moved_soup.ply").points) > -2.1
    report = convert("loose.ply", "welded.vsm", "--weld", 0)
    assert report["vertices"] > 1800 and report["boundary_edges"] > 0, report
    run("convert", "soup.ply", "o.vsm", "--weld", -1, code=2)


def test_orient():
    """However triangles are wound, the stream has a closed surface with a volume; of two nested ones the inner one is
    a cavity if it was wound inwards."""
    write_torus("torus.obj", 60, 30)
    mesh = read_mesh("torus.obj")
    triangles = fans(mesh.cells)
    half = [tuple(x / 2 + 10 for x in point) for point in mesh.points]  # beside the other one
    points = mesh.points + half
    both = triangles + [tuple(i + len(mesh.points) for i in cell) for cell in triangles]
    windings = (lambda k: True, lambda k: k % 2, lambda k: k == 5, lambda k: k >= len(triangles),
                lambda k: (k * 2654435761 >> 7) % 3 == 0)
    for number, is_turned in enumerate(windings):
        wound = [cell[::-1] if is_turned(k) else cell for k, cell in enumerate(both)]
        write_tagged_ply("wound.ply", points, wound)
        for order in ORDERS:
            report = convert("wound.ply", "oriented.vsm", "--orient", "--order", order)
            turned = sum(1 for k in range(len(both)) if is_turned(k))
            # The torus of the test is wound outwards or inwards as a whole.
            counts = {f"{n} triangle{'s were' if n != 1 else ' was'} turned." for n in (turned, len(both) - turned)}
            assert counts & set(report["notes"]), (number, report["notes"])
            run("info", "oriented.vsm", "--full", "--quiet", "--report", "info.json")
            facts = load("info.json")["description"]
            assert facts["consistently_wound"] and facts["turned_volume"] == 0, facts
            restored = restore("oriented.vsm", ".ply")
            assert same_points(restored.points, points)
            assert [sorted(cell) for cell in restored.cells] == [sorted(cell) for cell in wound]
    again = convert("oriented.vsm", "again.vsm", "--orient", "--order", "keep")
    assert not [note for note in again["notes"] if "turned" in note], again["notes"]
    error = run("convert", "oriented.vsm", "o.ply", "--restore-order", "--orient", code=2).stderr
    assert "--orient" in error, error


def test_orient_what_is_nested():
    """A shell that is inside out is turned with its cavity; parts whose outside is not known are said to be there."""
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    box = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
           (1, 3, 7), (1, 7, 5)]
    points = [tuple(3 * x - 1 for x in point) for point in corners] + corners
    hollow = box + [tuple(k + 8 for k in cell[::-1]) for cell in box]
    for is_turned in (False, True):
        write_tagged_ply("hollow.ply", points, [cell[::-1] if is_turned else cell for cell in hollow])
        report = convert("hollow.ply", "hollow.vsm", "--orient")
        assert ("24 triangles were turned." in report["notes"]) == is_turned, report["notes"]
        assert any("cavities" in note and "enclose 1." in note for note in report["notes"]), report["notes"]
        run("info", "hollow.vsm", "--full", "--quiet", "--report", "info.json")
        assert abs(load("info.json")["description"]["volume"] - 26) < 1e-12
    second = [tuple(k // 2 + 8 if k % 2 else k + 1 for k in cell) for cell in box]  # on the face x = 1
    write_tagged_ply("two.ply", corners + [(2, y, z) for z in (0, 1) for y in (0, 1)], box + second)
    notes = convert("two.ply", "two.vsm", "--orient")["notes"]
    assert any("more than two triangles" in note for note in notes), notes
    run("smooth", "two.ply", "smoothed.ply", "--size", "0.1", "--orient", "--quiet", "--report", "report.json")
    assert load("report.json")["volume"]["before"] is None


def test_cells_of_both_kinds():
    points, solids = tetrahedra(5)
    faces = [(0, 1, 5), (1, 5, 6), (5, 6, 10)]
    write_medit("both.mesh", points, solids, faces)
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"screening": 1, "source": 1}, file)
    for choice in ((), ("--cells", "tets")):  # those of the highest dimension
        report = convert("both.mesh", "o.vsm", *choice)
        assert report["cells"] == len(solids) and report["dropped_cells"] == 3, choice
    for choice, count in (((), len(solids)), (("--cells", "tets"), len(solids)), (("--cells", "triangles"), 3)):
        run("solve", "both.mesh", "o.vsm", "--problem", "problem.json", *choice,
            "--report", "report.json", "--quiet")
        assert load("report.json")["cells"] == count
    for command in ("info", "preview"):
        run(command, "both.mesh", *(["o.vsm"] if command == "preview" else []))
    report = convert("both.mesh", "o.vsm", "--cells", "triangles")
    assert report["cells"] == 3 and report["dropped_cells"] == len(solids)
    assert report["vertices"] == 5 and report["isolated_vertices"] == 120
    os.remove("o.vsm")
    error = run("convert", "torus.obj", "o.vsm", "--cells", "tets", code=1).stderr
    assert "torus.obj" in error and not os.path.exists("o.vsm"), error


def test_parts():
    """One partition of a VTKHDF file alone; a time step where there are none is an error."""
    write_torus("parts.obj", 500, 300)
    run("convert", "parts.obj", "parts.vtkhdf", "--quiet")
    run("info", "parts.vtkhdf", "--report", "report.json")
    cells = load("report.json")["cells"]
    assert load("report.json")["partitions"] == 2 and load("report.json")["time_steps"] == 0
    counts = [convert("parts.vtkhdf", "o.vsm", "--partition", k)["cells"] for k in range(2)]
    assert min(counts) > 0 and sum(counts) == cells, counts
    os.remove("o.vsm")
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"screening": 1, "source": 1}, file)
    run("solve", "parts.vtkhdf", "o.vsm", "--problem", "problem.json", "--partition", 1,
        "--report", "report.json", "--quiet")
    assert load("report.json")["cells"] == counts[1]
    os.remove("o.vsm")
    for name, option, said in (("parts.vtkhdf", ("--partition", 2), "there are 2"),
                               ("parts.vtkhdf", ("--time-step", 1), "no time steps"),
                               ("parts.obj", ("--time-step", 1), "no time steps"),
                               ("parts.obj", ("--partition", 0), "no partitions"),
                               ("stream.smb", ("--partition", 0), "no partitions"),
                               ("stream.vsm", ("--time-step", 1), "no time steps")):
        error = run("convert", name, "o.vsm", *option, code=1).stderr
        assert name in error and said in error and option[0] in error, error
    run("convert", "parts.vtkhdf", "o.vsm", "--time-step", -1, code=2)
    assert not os.path.exists("o.vsm")


def test_same_mesh_for_any_memory():
    """The bytes are equal, except for bfs, whose pages depend on the memory: there the mesh is equal."""
    write_torus("large.obj", 400, 200)
    for order in ORDERS:
        files = set()
        for memory in (16, 64, 256):
            report = convert("large.obj", "large.vsm", "--order", order, "--memory", memory)
            assert report["pool_bytes_peak"] <= memory << 20, report
            name = "large.vsm"
            if order == "bfs":
                name = "large.ply"
                run("convert", "large.vsm", name, "--restore-order", "--quiet")
            with open(name, "rb") as file:
                files.add(file.read())
        assert len(files) == 1, order


def test_too_many_vertices_are_said_at_once():
    header = (b"ply\nformat binary_little_endian 1.0\nelement vertex 5000000000\nproperty float x\n"
              b"property float y\nproperty float z\nelement face 1\n"
              b"property list uchar int vertex_indices\nend_header\n")
    with open("huge.ply", "wb") as file:
        file.write(header)
        file.truncate(len(header) + 5000000000 * 12 + 13)  # takes no room
    for option in ((), ("--dry-run",)):
        done = run("convert", "huge.ply", "huge.vsm", *option, code=1)
        assert "has 5000000000 vertices" in done.stderr and "at most 4294967294" in done.stderr, done.stderr
    os.remove("huge.ply")
    assert not os.path.exists("huge.vsm")


for each in (test_too_many_vertices_are_said_at_once, test_restored_order, test_restored_solids, test_restored_is_the_same_file,
             test_moved_meshes_keep_their_order, test_other_formats_in_the_order_of_the_stream, test_gzip_and_wrong_suffixes,
             test_compressed_streams, test_own_name, test_weld, test_orient, test_orient_what_is_nested,
             test_cells_of_both_kinds, test_parts, test_same_mesh_for_any_memory):
    each()
    print("passed", each.__name__)
sys.exit(0)
