# SPDX-License-Identifier: BSD-3-Clause
"""largest.py BIN OUT MESH : a solve of the largest mesh, in a fixed amount of memory.

Refines a mesh of triangles, shuffles it, converts it and solves for a prescribed value at either end of its longest side, to 1e-6.
BIN is the folder of the programs; the output is OUT/largest.json and OUT/largest.md. Neither the refinement nor the
other steps have the mesh in memory; the files of 177 million vertices take 30 GB.
"""
import argparse
import json
import pathlib
import sys

from bent_meshes import Meshes, bend, reported
from machine import machine

CONVERT_MIB, SOLVE_MIB = 512, 256


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("--times", type=int, default=6, help="refinements (6)")
    options = parser.parse_args()
    meshes = Meshes(options.bin, options.out)

    def smg(command, *arguments):
        return reported(options.bin / "smg", options.out, command, *arguments)

    ply = meshes.refined(options.mesh, 0, options.times)
    stream, solved = options.out / "largest.vsm", options.out / "largest-solved.vsm"
    convert = smg("convert", ply, stream, "--memory", CONVERT_MIB)
    if ply != options.mesh:
        ply.unlink()
    bottom, top = (handle["region"] for handle in bend(meshes.info(stream)["bounds"])["handles"])
    problem = options.out / "largest-ends.json"
    problem.write_text(json.dumps({"dirichlet": [{**bottom, "value": 0}, {**top, "value": 1}]}))
    solve = smg("solve", stream, solved, "--problem", problem, "--memory", SOLVE_MIB, "--tolerance", "1e-6")
    report, vertices = solve["report"], solve["report"]["vertices"]
    later = report["bytes_read"] / vertices / max(1, report["passes"] - 1)
    rows = (
        ("vertices, triangles", f"{vertices:,}, {report['cells']:,}"),
        ("span", f"{meshes.info(stream)['span']:,}"),
        ("conversion: time, CPU, resident memory", "%.0f s, %.0f s, %.0f MiB" % (
            convert["seconds"], convert["cpu_seconds"], convert["report"]["rss_bytes_peak"] / 2**20)),
        ("accounted memory, resident memory", "%.1f MiB, %.0f MiB" % (
            report["pool_bytes_peak"] / 2**20, report["rss_bytes_peak"] / 2**20)),
        ("passes, V-cycles", f"{report['passes']}, {report['cycles']}"),
        ("scratch files", f"{report['scratch_bytes_peak'] / 1e9:.1f} GB; {later:.0f} bytes per vertex were read in each later pass"),
        ("CPU time", f"{solve['cpu_seconds']:.0f} s, {1e6 * solve['cpu_seconds'] / vertices:.1f} us per vertex"),
        ("wall time", f"{solve['seconds']:.0f} s"))
    table = "| | |\n|---|---|\n" + "".join("| %s | %s |\n" % row for row in rows)
    (options.out / "largest.json").write_text(json.dumps(
        {"machine": machine(), "convert": convert, "solve": solve}, indent=2) + "\n")
    (options.out / "largest.md").write_text(table)
    print(table, end="")
    for file in (stream, solved, problem):
        file.unlink()


if __name__ == "__main__":
    sys.exit(main())
