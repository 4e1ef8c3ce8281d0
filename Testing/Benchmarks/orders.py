#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""orders.py SMG OUT MESH... : what stream orders and sweeps cost a solve; the tables of docs/paper.md.

Solves in breadth-first and in spectral order with one thread: three columns, held at one vertex at either end in x, to a
relative residual of 1e-6; the first mesh, in breadth-first order, also with other numbers of sweeps. Prints two tables:
sweeps, and orders. Files go to the folder OUT.
"""
import json
import pathlib
import sys

from bent_meshes import reported

SWEEPS = (1, 2, 4, 10)
ORDERS = ("bfs", "spectral")
ENDS = {"columns": 3, "dirichlet": [{"nearest": [[-1e9, 0, 0]], "value": [0, 0, 0]},
                                    {"nearest": [[1e9, 0, 0]], "value": [1, 2, 3]}]}


def main(smg, out, *meshes):
    out = pathlib.Path(out)
    problem, solved = out / "orders-ends.json", out / "orders-solved.vsm"
    problem.write_text(json.dumps(ENDS), encoding="utf-8")

    def row(stream, *before, options=()):
        run = reported(smg, out, "solve", stream, solved, "--problem", problem, "--tolerance", "1e-6", "--threads", "1", *options)
        report = run["report"]
        needs = [f"{report['peak_nodes']:,}", f"{report['pool_bytes_peak'] / 2**20:.1f}"]
        return "| " + " | ".join([*map(str, before), *needs, str(report["cycles"]), f"{run['cpu_seconds']:.2f}"]) + " |"

    sweeps, orders = [], []
    for mesh in map(pathlib.Path, meshes):
        for order in ORDERS:
            stream = out / f"orders-{mesh.stem}-{order}.vsm"
            found = reported(smg, out, "convert", mesh, stream, "--order", order)["report"]
            orders.append(row(stream, mesh.stem, order, f"{found['width']:,}", f"{found['span']:,}"))
            if len(orders) == 1:
                sweeps = [row(stream, count, options=("--sweeps", count)) for count in SWEEPS]
            stream.unlink()
    for file in (problem, solved):
        file.unlink()
    print("| sweeps | peak nodes | accounted MiB | V-cycles | CPU s |\n|---|---|---|---|---|")
    print("\n".join(sweeps))
    print("\n| mesh | order | width | span | peak nodes | accounted MiB | V-cycles | CPU s |\n|---|---|---|---|---|---|---|---|")
    print("\n".join(orders))


if __name__ == "__main__":
    main(*sys.argv[1:])
