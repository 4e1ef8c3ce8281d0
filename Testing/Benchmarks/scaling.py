# SPDX-License-Identifier: BSD-3-Clause
"""scaling.py BIN OUT MESH... : how time and memory grow with the mesh.

Refines each mesh repeatedly (a triangle becomes four, a tetrahedron eight) up to --to vertices, with
vertices and cells in random order; converts it out of core, and solves it streaming with one thread
and with two, and with the other solvers up to --peers-to vertices. BIN is the folder of the
programs; the output is OUT/scaling.json, .md and .svg, and OUT keeps the streams. The refinement
holds the finest tetrahedra in memory; neither that of triangles nor the solver does so.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import scaling_law
from machine import machine

CHILDREN = {"triangle": 4, "tetrahedron": 8}
SUFFIX = {"triangle": ".ply", "tetrahedron": ".vtk"}


class Series:
    """The refinements of a mesh."""

    def __init__(self, mesh, options):
        self.mesh, self.options = mesh, options
        self.name = mesh.stem
        self.cell_type = ""
        self.points = []

    def run(self, program, *arguments):
        command = [str(self.options.bin / program), *map(str, arguments)]
        print(" ".join(command), file=sys.stderr, flush=True)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

    def numbers(self, program, option, *arguments):
        """The JSON that a program writes to the file given by `option`."""
        file = self.options.out / "scaling-numbers.json"
        self.run(program, *arguments, option, file)
        numbers = json.loads(file.read_text())
        file.unlink()
        return numbers

    def solve(self, stream, threads, *peers):
        """Without `peers`, uses all that exist and checks their solutions."""
        which = ["--peers", ",".join(peers), "--no-check"] if peers else []
        return self.numbers("benchmark_peers", "--json", stream, "--threads", threads,
                            *which)["results"]

    def measure(self, times):
        """The mesh refined `times` times."""
        factor = CHILDREN[self.cell_type] ** times if times else 1
        stream = self.options.out / f"{self.name}-x{factor}.vsm"
        mesh = self.mesh
        if times:
            mesh = self.options.out / f"{self.name}-x{factor}{SUFFIX[self.cell_type]}"
            self.run("make_mesh", "finer", self.mesh, times, mesh, "--shuffle")
        convert = self.numbers("smg", "--report", "convert", mesh, stream, "--quiet")
        if times:
            mesh.unlink()
        if not self.cell_type:
            self.cell_type = self.numbers("smg", "--report", "info", stream, "--quiet")["cell_type"]
        with_peers = convert["vertices"] <= self.options.peers_to
        results = self.solve(stream, 1, *([] if with_peers else ["smg"]))
        one = results.pop("smg")
        two = self.solve(stream, 2, "smg")["smg"]
        for result in (one, two):
            if "failed" in result:
                sys.exit(f"{stream}: {result['failed']}")
        self.points.append({"vertices": convert["vertices"], "cells": convert["cells"],
                            "convert": convert, "streaming": {"1": one, "2": two},
                            "peers": results})

    def measure_all(self):
        self.measure(0)
        children = CHILDREN[self.cell_type]
        while self.points[-1]["vertices"] * children <= self.options.to:
            self.measure(len(self.points))
        return {"mesh": self.name, "cell_type": self.cell_type, "points": self.points,
                "exponents": scaling_law.growth(self.points)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path, nargs="+", metavar="MESH")
    parser.add_argument("--to", type=int, default=3_000_000, help="most vertices of a mesh")
    parser.add_argument("--peers-to", type=int, default=1_000_000,
                        help="most vertices of a mesh that the other solvers get")
    options = parser.parse_args()
    series = [Series(mesh, options).measure_all() for mesh in options.meshes]
    scaling_law.write(options.out, {"machine": machine(), "series": series})
    print((options.out / "scaling.md").read_text(), end="")


main()
