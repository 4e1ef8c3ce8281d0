# SPDX-License-Identifier: BSD-3-Clause
"""headline.py BIN OUT [MESH] : a deformation of 14 and one of 44 million vertices, from file to file.

Refines a mesh, shuffles it, and bends it (bent_meshes.py) with `smg convert` and `smg deform` within a limit of memory:
to the default tolerance and with 3 V-cycles a step. The error is the largest distance of a vertex from where a run to 1e-8
puts it, over the diagonal of the bounding box. Then draws the first mesh, before and after, piece by piece, and bends meshes
in each order that `smg convert` knows. BIN is the folder of the programs. Without MESH, the meshes are those of --data, the
archive: the dragon in the memory that the paper's solver took for 14 million vertices, and the Armadillo in twice as much. The output is
OUT/headline.json, OUT/headline.md and, where pvpython and --plugin are, OUT/headline.jpg.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

from bent_meshes import Meshes, measured, reported
from machine import machine

# File, vertices to which it is simplified (0: not), refinements, limit of memory in MB.
HEADLINES = (("dragon.ply", 56500, 4, 84), ("armadillo43k.obj", 0, 5, 160))
ORDERED = ("head_mri_1m.ply", "dragon.ply")
ORDERS = ("bfs", "spectral", "axis", "keep")
# What is kept of the reports.
KEPT = ("vertices", "cells", "passes", "steps", "residuals", "seconds", "cpu_seconds", "peak_nodes", "pool_bytes_peak",
        "rss_bytes_peak", "scratch_bytes_peak", "bytes_read", "bytes_written", "inverted", "threads", "notes")
MB = 10 ** 6

STEPS = """| mesh | vertices | step | limit, MB | accounted, MB | resident, MB | passes | time, s | CPU, s | CPU, us a vertex | million vertices per GiB | error |
|---|---|---|---|---|---|---|---|---|---|---|---|
"""
BY_ORDER = """| mesh | order | span | accounted, MB | over bfs | peak nodes | passes | CPU s | over bfs |
|---|---|---|---|---|---|---|---|---|
"""


class Headline:
    """The runs and what each of them took."""

    def __init__(self, options):
        self.options = options
        self.meshes = Meshes(options.bin, options.out)
        self.steps, self.orders, self.picture = [], [], None

    def file(self, name):
        return self.options.out / f"headline-{name}"

    def smg(self, command, *arguments):
        """Runs a command of smg whose `arguments` begin with IN and OUT: its costs and its report."""
        costs = reported(self.options.bin / "smg", self.options.out, command, *arguments)
        costs["report"] = {key: costs["report"][key] for key in KEPT if key in costs["report"]}
        return costs

    def bend(self, mesh, vertices, times, limit):
        """Converts and deforms a mesh; returns the streams before and after."""
        ply = self.meshes.refined(mesh, vertices, times)
        stream = self.options.out / f"{ply.stem}.vsm"
        memory = ["--memory", f"{limit}MB"]
        runs = [("convert", self.smg("convert", ply, stream, *memory))]
        if ply != mesh:
            ply.unlink()
        handles = self.meshes.handles(stream)
        deformed = {name: self.file(f"{name}.vsm") for name in ("exact", "cycles", "deformed")}
        exact = self.smg("deform", stream, deformed["exact"], "--handles", handles, "--tolerance", "1e-8")
        for name, options in (("cycles", ["--cycles", "3"]), ("deformed", [])):
            run = self.smg("deform", stream, deformed[name], "--handles", handles, *memory, *options)
            distance = subprocess.run([self.options.bin / "position_error", deformed[name], deformed["exact"]],
                                      check=True, capture_output=True, text=True).stdout
            run["error"] = float(distance) / self.diagonal(stream)
            runs.append((f"deform {' '.join(options)}".strip(), run))
            deformed["exact" if name == "deformed" else name].unlink()
        for step, run in runs:
            self.steps.append({"mesh": stream.stem, "step": step, "limit_mb": limit,
                               "vertices": exact["report"]["vertices"], **run})
        return stream, deformed["deformed"]

    def diagonal(self, stream):
        bounds = self.meshes.info(stream)["bounds"]
        return sum((h - l) ** 2 for l, h in zip(bounds[0::2], bounds[1::2])) ** 0.5

    def draw(self, *streams):
        """Every triangle of these streams, where ParaView can."""
        if not shutil.which("pvpython") or not self.options.plugin:
            print("no picture: it needs pvpython and --plugin", file=sys.stderr)
            return
        infos = [self.meshes.info(stream) for stream in streams]
        bounds = [(min, max)[k % 2](info["bounds"][k] for info in infos) for k in range(6)]
        script = pathlib.Path(__file__).with_name("headline_picture.py")
        numbers = self.file("picture.json")
        costs = measured("xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", "pvpython", script,
                         self.options.plugin, self.options.out / "headline.jpg", numbers, json.dumps(bounds),
                         infos[0]["cells"], *streams)
        self.picture = {**costs, **json.loads(numbers.read_text()), "triangles": sum(info["cells"] for info in infos)}
        numbers.unlink()

    def bend_in_orders(self, mesh):
        for order in ORDERS:
            stream, deformed = self.file(f"{order}.vsm"), self.file("deformed.vsm")
            self.smg("convert", mesh, stream, "--order", order)
            run = self.smg("deform", stream, deformed, "--handles", self.meshes.handles(stream), "--threads", 1)
            self.orders.append({"mesh": mesh.stem, "order": order, "span": self.meshes.info(stream)["span"], **run})
            stream.unlink()
            deformed.unlink()

    def write(self):
        """What is there so far."""
        numbers = {"machine": machine(), "steps": self.steps, "orders": self.orders, "picture": self.picture}
        (self.options.out / "headline.json").write_text(json.dumps(numbers, indent=2) + "\n")
        (self.options.out / "headline.md").write_text(self.table())

    def table(self):
        on = machine()
        lines = [f"Measured on {on['processor']}, {on['cores']} cores, {on['memory_gib']} GiB of memory. MB of 1e6 bytes.\n\n",
                 STEPS]
        for step in self.steps:
            report, vertices = step["report"], step["vertices"]
            rss = report["rss_bytes_peak"]
            error = f"{step['error']:.0e}" if "error" in step else ""
            lines.append(
                f"| {step['mesh']} | {vertices:,} | {step['step']} | {step['limit_mb']} | "
                f"{report['pool_bytes_peak'] / MB:.1f} | {rss / MB:.0f} | {report.get('passes', '')} | {step['seconds']:.0f} | "
                f"{step['cpu_seconds']:.0f} | {1e6 * step['cpu_seconds'] / vertices:.2f} | "
                f"{vertices / rss * 2**30 / 1e6:.0f} | {error} |\n")
        lines += ["\n", BY_ORDER]
        for run in self.orders:
            report = run["report"]
            first = next(r for r in self.orders if r["mesh"] == run["mesh"])
            memory = report["pool_bytes_peak"] / first["report"]["pool_bytes_peak"]
            lines.append(
                f"| {run['mesh']} | {run['order']} | {run['span']:,} | {report['pool_bytes_peak'] / MB:.1f} | {memory:.2f} | "
                f"{report['peak_nodes']:,} | {report['passes']} | {run['cpu_seconds']:.1f} | "
                f"{run['cpu_seconds'] / first['cpu_seconds']:.2f} |\n")
        if self.picture:
            lines.append("\nThe picture of {triangles:,} triangles, in {pieces} pieces a mesh: {seconds:.0f} s, {cpu_seconds:.0f} s of "
                         "CPU; {largest_mib:.0f} MiB resident, {before_mib:.0f} of them before the first piece.\n".format(**self.picture))
        return "".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path, nargs="?")
    parser.add_argument("--times", type=int, default=4, help="refinements of MESH (4)")
    parser.add_argument("--memory", type=int, default=84, help="limit of MESH in MB (84)")
    parser.add_argument("--data", type=pathlib.Path, help="folder with the meshes of the archive")
    parser.add_argument("--plugin", type=pathlib.Path, help="StreamingMultigrid.so, for the picture")
    options = parser.parse_args()
    if not options.mesh and not options.data:
        parser.error("a MESH or --data is needed")
    headline = Headline(options)
    tasks = [(options.mesh, 0, options.times, options.memory)] if options.mesh else [
        (options.data / file, *rest) for file, *rest in HEADLINES]
    before, after = headline.bend(*tasks[0])
    headline.draw(before, after)
    after.unlink()
    headline.write()
    for mesh in [options.mesh] if options.mesh else [options.data / file for file in ORDERED]:
        headline.bend_in_orders(mesh)
    for task in tasks[1:]:
        headline.write()
        _, after = headline.bend(*task)
        after.unlink()
    headline.write()
    print(headline.table(), end="")


if __name__ == "__main__":
    sys.exit(main())
