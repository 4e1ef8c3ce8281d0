# SPDX-License-Identifier: BSD-3-Clause
"""story.py BIN OUT MESH : what people do with a large scan, in a fixed amount of memory.

Refines a scan (a triangle becomes four), shuffles it and moves every vertex by noise of up to 0.2
mean edges. Then, with the same memory limit throughout: converts it, smooths it, computes the
distances from a point, and draws a preview of the result with isolines of the whole mesh. BIN is the
folder of the programs; the output is OUT/story.json, OUT/story.md and, where pvpython and the plugin
are, OUT/story.png. The refinement holds the finest mesh in memory, 60 bytes per triangle; the steps
do not.
"""
import argparse
import json
import pathlib
import shutil
import sys

from bent_meshes import measured, reported

TABLE = """| step | time, s | CPU, s | CPU, us a vertex | resident memory, MiB | passes | bytes of the file |
|---|---|---|---|---|---|---|
"""


class Story:
    """The steps and what each of them took."""

    def __init__(self, options):
        self.options = options
        self.steps = []

    def file(self, name):
        return self.options.out / f"story-{name}"

    def run(self, step, out, *command):
        """Runs a command and measures the process from outside."""
        self.steps.append({"step": step, **measured(*command), "bytes": out.stat().st_size})

    def smg(self, command, *arguments):
        """Runs a command of smg within the memory limit; `arguments` begin with IN and OUT."""
        costs = reported(self.options.bin / "smg", self.options.out, command, *arguments,
                         "--memory", self.options.memory)
        self.steps.append({"step": command, **costs, "bytes": arguments[1].stat().st_size})

    def tell(self):
        noisy, stream = self.file("noisy.ply"), self.file("noisy.vsm")
        smooth, distance = self.file("smooth.vsm"), self.file("distance.vsm")
        self.run("make", noisy, self.options.bin / "make_mesh", "finer", self.options.mesh,
                 self.options.times, noisy, "--shuffle", "--noise", 0.2)
        self.steps.clear()
        self.smg("convert", noisy, stream)
        noisy.unlink()
        self.smg("smooth", stream, smooth, "--size", self.options.size, "--tolerance", "1e-6")
        self.smg("distance", smooth, distance, "--from", json.dumps(self.options.source))
        self.draw(distance)

    def draw(self, distance):
        """Draws the preview with the isolines of the whole mesh, where ParaView can."""
        picture = self.file("picture.png")
        if not shutil.which("pvpython") or not self.options.plugin:
            print("no picture: it needs pvpython and --plugin", file=sys.stderr)
            return
        script = pathlib.Path(__file__).with_name("story_picture.py")
        self.run("picture", picture, "xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset",
                 "pvpython", script, self.options.plugin, distance, picture)

    def table(self):
        vertices = self.steps[0]["report"]["vertices"]
        lines = [f"{self.options.mesh.name}, {vertices} vertices, --memory {self.options.memory}\n\n",
                 TABLE]
        for step in self.steps:
            passes = step.get("report", {}).get("passes", "")
            lines.append(f"| {step['step']} | {step['seconds']:.0f} | {step['cpu_seconds']:.0f} | "
                         f"{1e6 * step['cpu_seconds'] / vertices:.2f} | {step['rss_mib']:.0f} | "
                         f"{passes} | {step['bytes']} |\n")
        return "".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("--times", type=int, default=3, help="refinements (3)")
    parser.add_argument("--memory", type=int, default=128, help="limit of every step, MiB (128)")
    parser.add_argument("--size", default="8edges", help="of smg smooth (8edges)")
    parser.add_argument("--source", type=json.loads, default={"vertices": [0]},
                        help='of smg distance, as JSON ({"vertices": [0]})')
    parser.add_argument("--plugin", type=pathlib.Path, help="StreamingMultigrid.so, for a picture")
    story = Story(parser.parse_args())
    story.tell()
    (story.options.out / "story.json").write_text(json.dumps(story.steps, indent=2))
    (story.options.out / "story.md").write_text(story.table())
    print(story.table(), end="")


main()
