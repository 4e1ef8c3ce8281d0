# SPDX-License-Identifier: BSD-3-Clause
"""The deformation that is measured, and the meshes of the sizes of the paper.

Every mesh is bent: the lowest tenth of its longest side is held, the highest tenth is turned by 45
degrees about the axis of the shortest side through the middle of the bounding box, and moved outwards
by a twentieth of the longest side.
"""
import json
import os
import pathlib
import subprocess
import sys
import time

HELD = 0.1  # of the longest side, at either end
DEGREES = 45
MOVED = 0.05  # of the longest side


def bend(bounds):
    """The handles, for bounds xmin, xmax, ymin, ymax, zmin, zmax."""
    low, high = bounds[0::2], bounds[1::2]
    sides = [h - l for l, h in zip(low, high)]
    long, short = sides.index(max(sides)), sides.index(min(sides))
    side = sides[long]
    along = [float(d == long) for d in range(3)]
    bottom = {"halfspace": [-a for a in along] + [-(low[long] + HELD * side)]}
    top = {"halfspace": along + [high[long] - HELD * side]}
    return {"handles": [
        {"region": bottom, "fixed": True},
        {"region": top, "translate": [MOVED * side * a for a in along],
         "rotate": {"axis": [float(d == short) for d in range(3)], "degrees": DEGREES,
                    "center": [(l + h) / 2 for l, h in zip(low, high)]}}]}


def measured(*command):
    """Runs a command: wall-clock and processor seconds, and the largest resident memory in MiB, which
    is at least that of this Python."""
    command = [str(part) for part in command]
    print(" ".join(command), file=sys.stderr, flush=True)
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=sys.stderr)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"failed: {' '.join(command)}")
    return {"seconds": time.monotonic() - start, "cpu_seconds": usage.ru_utime + usage.ru_stime,
            "rss_mib": usage.ru_maxrss / 1024}


def reported(smg, folder, command, *arguments):
    """Runs a command of smg: its costs, as measured(), and its report."""
    file = folder / "report.json"
    costs = measured(smg, command, *arguments, "--quiet", "--report", file)
    costs["report"] = json.loads(file.read_text())
    file.unlink()
    return costs


class Meshes:
    """Streams in a folder, made by the programs in `bin` unless they are there already."""

    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder

    def run(self, program, *arguments):
        command = [str(self.programs / program), *map(str, arguments)]
        print(" ".join(command), file=sys.stderr, flush=True)
        subprocess.run(command, check=True, stdout=sys.stderr)

    def file(self, mesh, vertices, times, suffix):
        """The file of this folder for a mesh so treated."""
        name = mesh.stem + (f"-{vertices}" if vertices else "") + (f"-x{4 ** times}" if times else "")
        return self.folder / f"{name}.{suffix}"

    def refined(self, mesh, vertices, times):
        """A mesh simplified to at most `vertices` unless 0, and refined `times` times unless 0, then
        in a random order: a .ply file of this folder."""
        source = pathlib.Path(mesh)
        result = self.file(source, vertices, times, "ply")
        if vertices:
            source = self.file(source, vertices, 0, "ply")
            self.run("smg", "simplify", mesh, source, "--vertices", vertices, "--quiet")
        if times:
            self.run("make_mesh", "finer", source, times, result, "--shuffle")
            if vertices:
                source.unlink()
            source = result
        return source

    def stream(self, mesh, vertices=0, times=0):
        """The stream of a mesh so treated."""
        mesh = pathlib.Path(mesh)
        if mesh.suffix == ".vsm":
            return mesh
        stream = self.file(mesh, vertices, times, "vsm")
        if not stream.exists():
            file = self.refined(mesh, vertices, times)
            self.run("smg", "convert", file, stream, "--quiet")
            if file != mesh:
                file.unlink()
        return stream

    def made(self, shape, vertices):
        """The stream of a mesh that make_mesh makes."""
        stream = self.folder / f"{shape}-{vertices}.vsm"
        if not stream.exists():
            self.run("make_mesh", shape, vertices, stream)
        return stream

    def info(self, mesh):
        """The report of smg info."""
        return reported(self.programs / "smg", self.folder, "info", mesh)["report"]

    def handles(self, mesh):
        """A file with the handles of a mesh."""
        file = self.folder / f"{mesh.stem}-bend.json"
        file.write_text(json.dumps(bend(self.info(mesh)["bounds"])))
        return file
