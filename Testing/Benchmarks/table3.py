# SPDX-License-Identifier: BSD-3-Clause
"""table3.py BIN OUT [MESH...] : Table 3 of the paper, then and now.

Bends meshes of the sizes of the paper's models, out of core and in core, and puts the paper's numbers beside ours.
The limit of memory out of core is what the paper's solver took. BIN is the folder of the programs. Without a
MESH, the meshes are those of --data, the archive, refined or simplified to the sizes of the paper's models, or
without --data bumpy surfaces of the sizes of the smaller ones; each MESH is compared with the model of
the nearest number of vertices. The output is OUT/table3.json and OUT/table3.md, and OUT keeps the streams.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

from bent_meshes import Meshes
from machine import machine

# Of each model of the paper: vertices; of its streaming solver the seconds of I/O, hierarchy construction,
# operations and in total, thousands of nodes and MB; of its solver in core the same without I/O and nodes, where
# the paper has it.
PAPER = {
    "Bunny": (35947, (1.08, 1.00, 3.48, 5.56, 15.2, 13), (0.65, 1.58, 2.23, 23)),
    "Elephant": (42321, (1.28, 1.15, 4.03, 6.45, 14.6, 14), (0.74, 1.83, 2.56, 27)),
    "Armadillo": (172974, (5.26, 2.59, 16.67, 24.52, 33.2, 20), (1.13, 8.02, 9.14, 82)),
    "Dragon": (437645, (13.33, 6.42, 40.59, 60.35, 53.6, 25), (3.07, 20.19, 23.26, 191)),
    "Lucy": (936440, (28.57, 11.76, 86.04, 126.37, 66.4, 27), (4.68, 42.61, 47.29, 397)),
    "Lucy, large": (14027872, (428.08, 153.71, 1306.90, 1888.69, 257.0, 84), None),
    "XYZ RGB Dragon": (14438400, (440.60, 156.50, 1355.39, 1952.50, 239.7, 79), None),
}
# Meshes of the archive: the model, file, vertices to which it is simplified, refinements.
ARCHIVE = (("Bunny", "bunny.ply", 0, 0), ("Elephant", "elephant44k.off", 0, 0), ("Armadillo", "armadillo43k.obj", 0, 1),
           ("Dragon", "dragon.ply", 0, 0), ("Lucy", "lucy50k.ply", 14640, 3), ("Lucy", "head_mri_1m.ply", 0, 0),
           ("Lucy, large", "lucy50k.ply", 0, 4), ("XYZ RGB Dragon", "dragon.ply", 55000, 4))
LARGEST_MADE = 1_000_000  # vertices

DETAILS = """| model | vertices / levels | solver | I/O | hierarchy | operations | total | CPU | peak nodes | accounted memory | process |
|---|---|---|---|---|---|---|---|---|---|---|
"""
RATIOS = """| mesh | vertices over the paper's | paper's time over ours: wall | CPU | our memory over the paper's: accounted | process | streaming over in core: then | now, wall | now, CPU |
|---|---|---|---|---|---|---|---|---|
"""
CYCLES = """| mesh | V-cycles, error | CPU us a vertex | million vertices per GiB | 3 + 3 V-cycles, error | CPU us a vertex | paper's time over ours: wall | CPU | streaming over in core, CPU |
|---|---|---|---|---|---|---|---|---|
"""


def nearest_model(vertices):
    """Of a mesh that is not of the archive."""
    return min(PAPER, key=lambda model: abs(math.log(PAPER[model][0] / vertices)))


def text(value, places):
    return f"{value:.{places}f}"


def details(row):
    """Lines of the paper's model and of ours."""
    vertices, streaming, in_core = PAPER[row["model"]]
    times = " | ".join(f"{t:.2f}" for t in streaming[:4])
    yield f"{row['model']}, paper | {vertices} | streaming | {times} | | {streaming[4]}K | | {streaming[5]}"
    if in_core:
        times = " | ".join(f"{t:.2f}" for t in in_core[:3])
        yield f" | | in core | | {times} | | | | {in_core[3]}"
    else:
        yield " | | in core | | N/A | N/A | N/A | | | | > 2000"
    for k, name in enumerate(("streaming", "in core")):
        run = row["runs"][name]
        times = " | ".join(f"{run[key]:.2f}" for key in ("io_seconds", "hierarchy_seconds", "operations_seconds",
                                                         "total_seconds", "cpu_seconds"))
        what = f"{row['mesh']} | {row['vertices']} / {run['levels']}" if k == 0 else " | "
        star = "" if k or row["limit_bytes"] else "*"
        yield (f"{what} | {name} | {times} | {run['peak_nodes'] / 1e3:.1f}K | {run['pool_bytes'] / 1e6:.1f}{star} | "
               f"{run['process_bytes'] / 1e6:.1f}")


def ratios(row):
    vertices, then, in_core_then = PAPER[row["model"]]
    now, in_core = row["runs"]["streaming"], row["runs"]["in core"]
    cells = [row["mesh"], text(row["vertices"] / vertices, 2), text(then[3] / now["total_seconds"], 0),
             text(then[3] / now["cpu_seconds"], 0), text(now["pool_bytes"] / 1e6 / then[5], 2),
             text(now["process_bytes"] / 1e6 / then[5], 2), text(then[3] / in_core_then[2], 1) if in_core_then else "-",
             text(now["total_seconds"] / in_core["total_seconds"], 2),
             text(now["cpu_seconds"] / in_core["cpu_seconds"], 2)]
    return " | ".join(cells)


def cycles(row):
    then = PAPER[row["model"]][1]
    now, few = row["runs"]["streaming"], row["runs"]["streaming, 3 V-cycles"]
    per_gib = row["vertices"] / now["process_bytes"] * 2**30 / 1e6
    cells = [row["mesh"], f"{' + '.join(map(str, now['cycles']))}, {now['error']:.0e}",
             text(1e6 * now["cpu_seconds"] / row["vertices"], 1), text(per_gib, 0 if per_gib >= 10 else 1),
             f"{few['error']:.0e}", text(1e6 * few["cpu_seconds"] / row["vertices"], 1),
             text(then[3] / few["total_seconds"], 0), text(then[3] / few["cpu_seconds"], 0),
             text(few["cpu_seconds"] / row["runs"]["in core, 3 V-cycles"]["cpu_seconds"], 2)]
    return " | ".join(cells)


def table(numbers):
    on = numbers["machine"]
    rows = numbers["rows"]
    lines = [f"Measured on {on['processor']}, {on['cores']} cores, {on['memory_gib']} GiB of memory, with one thread. "
             "Seconds of wall time and of the processor; MB of 1e6 bytes; * without a limit of memory.\n\n", DETAILS]
    lines += [f"| {line} |\n" for row in rows for line in details(row)]
    lines += ["\n", RATIOS, *(f"| {ratios(row)} |\n" for row in rows)]
    lines += ["\n", CYCLES, *(f"| {cycles(row)} |\n" for row in rows)]
    return "".join(lines)


def models(meshes, options):
    """The streams to measure, each with its model unless that is the nearest one."""
    if options.meshes:
        return [(None, meshes.stream(mesh)) for mesh in options.meshes]
    if options.data:
        return [(model, meshes.stream(options.data / file, *treated)) for model, file, *treated in ARCHIVE]
    return [(None, meshes.made("scan", vertices)) for vertices, *_ in PAPER.values() if vertices < LARGEST_MADE]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path, nargs="*", metavar="MESH")
    parser.add_argument("--data", type=pathlib.Path, help="folder with the meshes of the archive")
    parser.add_argument("--threads", type=int, default=1, help="of each run (1)")
    options = parser.parse_args()
    meshes = Meshes(options.bin, options.out)
    rows = []
    for model, stream in models(meshes, options):
        vertices = meshes.info(stream)["vertices"]
        model = model or nearest_model(vertices)
        limit = PAPER[model][1][5] * 10**6
        numbers = options.out / "table3-numbers.json"
        arguments = (stream, meshes.handles(stream), "--threads", options.threads, "--repeats", 3 if vertices < 2e6 else 1,
                     "--json", numbers)
        try:
            meshes.run("benchmark_table3", *arguments, "--memory", limit)
        except subprocess.CalledProcessError:  # where the limit is too low for a mesh
            limit = None
            meshes.run("benchmark_table3", *arguments)
        rows.append({"model": model, "limit_bytes": limit, **json.loads(numbers.read_text())})
        numbers.unlink()
    results = {"machine": machine(), "rows": rows}
    (options.out / "table3.json").write_text(json.dumps(results, indent=2) + "\n")
    (options.out / "table3.md").write_text(table(results))
    print(table(results), end="")


if __name__ == "__main__":
    sys.exit(main())
