#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""distance.py SMG VERTEX MESH... : distances from a vertex of meshes, as a table in Markdown.

Each MESH is a .vsm file with the column OriginalId. Runs `SMG distance` and prints processor time, passes, memory and traffic. With --exact FILE, also
the relative errors at the first vertices of the original mesh: FILE has their exact distances as
binary doubles, for instance exact polyhedral geodesics of a mesh that the others refine. Errors of
largest values are those beyond 5 % of the diameter. Needs NumPy. Files go to the current folder.
"""
import argparse
import base64
import json
import pathlib
import subprocess
import xml.etree.ElementTree as xml

import numpy as np

TABLE = """| mesh | vertices | passes | mesh read | CPU, s | us a vertex | accounted, MiB | resident, MiB | mean error, % | largest, % |
|---|---|---|---|---|---|---|---|---|---|
"""


def read_ids_and_distances(smg, mesh):
    """The columns OriginalId and Distance of a .vsm file of triangles, through a VTK file."""
    subprocess.run([smg, "convert", mesh, "distance.vtp", "--quiet"], check=True)
    columns = {}
    for array in xml.parse("distance.vtp").getroot().iter("DataArray"):
        name, kind = array.get("Name"), {"OriginalId": "i8", "Distance": "f8"}
        if name in kind:
            # The number of bytes is encoded separately, in 12 characters.
            data = base64.b64decode(array.text.strip()[12:])
            columns[name] = np.frombuffer(data, kind[name])
    return columns["OriginalId"], columns["Distance"]


def errors(smg, exact):
    ids, distances = read_ids_and_distances(smg, "distance.vsm")
    found = np.full(len(exact), np.nan)
    first = ids < len(exact)
    found[ids[first]] = distances[first]
    there = np.isfinite(found) & (exact > 0)
    error = np.abs(found[there] - exact[there]) / exact[there]
    far = exact[there] > 0.05 * exact.max()
    return f"{100 * error.mean():.3f} | {100 * error[far].max():.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("smg")
    parser.add_argument("vertex", type=int)
    parser.add_argument("mesh", type=pathlib.Path, nargs="+")
    parser.add_argument("--exact", type=pathlib.Path)
    parser.add_argument("--memory", type=int, default=64)
    options = parser.parse_args()
    print(TABLE, end="")
    for mesh in options.mesh:
        subprocess.run([options.smg, "distance", mesh, "distance.vsm", "--quiet", "--report",
                        "distance.json", "--memory", str(options.memory), "--from",
                        json.dumps({"vertices": [options.vertex]})], check=True)
        report = json.loads(pathlib.Path("distance.json").read_text(encoding="utf-8"))
        vertices, cpu = report["vertices"], report["cpu_seconds"]
        error = errors(options.smg, np.fromfile(options.exact)) if options.exact else " | "
        print(f"| {mesh.stem} | {vertices} | {report['passes']} | "
              f"{report['distance']['mesh_readings']:.1f} | {cpu:.1f} | {1e6 * cpu / vertices:.2f} | "
              f"{report['pool_bytes_peak'] / 2**20:.0f} | {report['rss_bytes_peak'] / 2**20:.0f} | "
              f"{error} |", flush=True)


main()
