# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the table and plot of scaling.py reproduce the laws of its data."""
import pathlib
import sys
import tempfile

import scaling_law


def point(vertices):
    """Nodes grow with the power 1/2 of the vertices, memory with 2/3, time linearly."""
    result = {"cpu_total": 3e-6 * vertices, "peak_bytes": 1 << 24, "iterations": 8,
              "report": {"peak_nodes": round(1e3 * vertices ** 0.5),
                         "pool_bytes_peak": round(1e6 * vertices ** (2 / 3)),
                         "seconds": {"total": 1.0}}}
    return {"vertices": vertices, "convert": {"span": 7, "cpu_seconds": 1.0},
            "streaming": {"1": result, "2": result},
            "peers": {"hypre": result, "cholmod": {"failed": "no memory"}}}


def main():
    points = [point(10 ** k) for k in (4, 5, 6, 7)]
    series = [{"mesh": "wing", "points": points}, {"mesh": "dot", "points": points[:1]}]
    fits = scaling_law.growth(points)
    for name, law in (("peak_nodes", 1 / 2), ("pool_bytes", 2 / 3), ("cpu_seconds", 1)):
        for which in ("all", "last"):
            assert abs(fits[name][which] - law) < 1e-4, (name, fits)
    # One outlier changes the least-squares fit over all points: by 3/20 for the last of four points
    # at equal distances.
    fitted = scaling_law.exponent([(1, 1), (10, 1), (100, 1), (1000, 10)])
    assert abs(fitted - 0.3) < 1e-12, fitted
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        machine = {"processor": "abacus", "cores": 1, "memory_gib": 0}
        scaling_law.write(out, {"machine": machine, "series": series})
        tables = (out / "scaling.md").read_text()
        svg = (out / "scaling.svg").read_text()
    assert "| wing, all | 0.50 | 0.67 | 1.00 |" in tables and "| dot, all" not in tables, tables
    # 3 us per vertex and 16 MiB, streaming and hypre.
    assert "| dot | 10000 | 3.00, 16 | 3.00, 16 | failed |" in tables, tables
    assert "hypre BoomerAMG, wing" in svg and "CHOLMOD" not in svg


sys.exit(main())
