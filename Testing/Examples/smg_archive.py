#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg convert on the real meshes of the archive: every file in every order, plain and compressed.

smg_archive.py [all]: the meshes of up to 70,000 cells, or all."""

import gzip
import sys
from typing import NamedTuple

from archive_meshes import CHOSEN, in_archive
from mesh_files import SOLIDS, SURFACES, read_mesh, same_points
from odd_mesh import are_triangles_of
from program import load, run

MOST_CELLS = sys.maxsize if sys.argv[1:] == ["all"] else 70000
ORDERS = ("bfs", "spectral", "axis", "keep")


class Counts(NamedTuple):
    """The counts of a mesh by an independent program."""
    used: int
    cells: int
    isolated: int = 0
    components: int = 1
    boundary: int = 0
    edges: int = 0      # non-manifold
    vertices: int = 0   # non-manifold
    duplicates: int = 0
    degenerate: int = 0


TETS = {"boundary": -1, "edges": -1, "vertices": -1}
MESHES = {
    "armadillo43k.obj": Counts(43243, 86482),
    "armadillo_tet.msh": Counts(13230, 54985, **TETS),
    "brain168k.vtk": Counts(168390, 337014, components=3, vertices=1),
    "bunny.ply": Counts(34834, 69451, 1113, boundary=223),
    "bunny_tet.mesh": Counts(5433, 34055, **TETS),
    "dragon_res3.ply": Counts(22982, 47794, 16, edges=2094, vertices=5, duplicates=1254),
    "elephant44k.off": Counts(44460, 88928),
    "head_tet336k.vtk": Counts(59220, 335713, 5, **TETS),
    "horse_be.ply": Counts(48485, 96966),
    "lucy50k.ply": Counts(49987, 99970),
    "rangemap_lato315.ply": Counts(62361, 120995, 341, 32, 3713, vertices=11),
    "raptor_tet.vtu": Counts(5990, 19409, 2, **TETS),
    "dragon.ply": Counts(437645, 871414, components=151, boundary=4270, degenerate=108),
    "head_mri_1m.ply": Counts(1091302, 2181324, components=518, boundary=98),
}


def convert(name, out, *arguments):
    run("convert", name, out, "--quiet", "--report", "report.json", *arguments)
    return load("report.json")


def counts(report):
    return Counts(*(report[name] for name in (
        "vertices", "cells", "isolated_vertices", "components", "boundary_edges",
        "nonmanifold_edges", "nonmanifold_vertices", "duplicate_cells", "degenerate_cells")))


def check_restored(vsm, suffix, name):
    """The restored file has exactly the points and cells of the archive's file."""
    whole = read_mesh(in_archive(name))
    run("convert", vsm, "restored" + suffix, "--restore-order", "--quiet")
    mesh = read_mesh("restored" + suffix)
    if suffix == ".stl":
        assert are_triangles_of(whole.cells, whole.points, mesh.points), (name, suffix)
    else:
        assert mesh.cells == whole.cells, (name, suffix)
        assert same_points(mesh.points, whole.points), (name, suffix)


def test_every_order(meshes):
    for name, expected in meshes.items():
        for order in ORDERS:
            report = convert(in_archive(name), "mesh.vsm", "--order", order, "--memory", 16,
                             *CHOSEN.get(name, ()))
            assert report["pool_bytes_peak"] <= 16 << 20, report
            assert counts(report) == expected, (name, order, counts(report))


def test_restored_order(meshes):
    for i, name in enumerate(meshes):
        convert(in_archive(name), "mesh.vsm", "--order", ORDERS[i % 4], *CHOSEN.get(name, ()))
        suffixes = SOLIDS if "tet" in name else SURFACES
        for k in range(i, i + 2):
            check_restored("mesh.vsm", suffixes[k % len(suffixes)], name)
            if suffixes[k % len(suffixes)] != ".stl":
                convert("restored" + suffixes[k % len(suffixes)], "again.vsm", "--order", "axis")
                check_restored("again.vsm", suffixes[0], name)


def test_gzip_and_wrong_suffix(meshes):
    for name, expected in meshes.items():
        with open(in_archive(name), "rb") as file:
            data = file.read()
        with gzip.open("mesh.gz", "wb", compresslevel=1) as file:
            file.write(data)
        wrong = "wrong.off" if not name.endswith(".off") else "wrong.ply"
        with open(wrong, "wb") as file:
            file.write(data)
        for other in ("mesh.gz", wrong):
            report = convert(other, "mesh.vsm", *CHOSEN.get(name, ()))
            assert counts(report) == expected, (other, report)


for each in (test_every_order, test_restored_order, test_gzip_and_wrong_suffix):
    each({name: of for name, of in MESHES.items() if of.cells <= MOST_CELLS})
    print("passed", each.__name__)
sys.exit(0)
