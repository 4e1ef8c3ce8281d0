#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""golden.py SMG [--write] [--meshes FOLDER] : that the program's results have not changed by a bit.

Runs small jobs of every kind, and compares the checksums of what they write with those in hashes.txt,
which --write writes: conversions in all orders, files of every format in both orders, solutions,
deformations, smoothings, distances, areas, blends, simplifications and previews, and what is said of
each damaged file of the fuzzers. --meshes: converts and solves on each mesh of this folder, too (long; in
hashes-FOLDER.txt). For changes of structure: they keep all bits. A change of results writes the table anew
and says so in the CHANGELOG.

Sines and the like are those of the C library: the table is of the system that its first line names, and
on others the script says so and exits with 77.
"""
import argparse
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TREE = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(TREE, "Testing", "Examples"))
SURFACE_STREAMS = ".sma .smb .ply .vtp .vtkhdf".split()
SOLID_STREAMS = ".sva .svb .vtu .vtkhdf".split()
CORPUS = {"gmsh": ".msh", "medit": ".mesh", "obj": ".obj", "off": ".off", "ply": ".ply", "stl": ".stl", "vtk": ".vtk",
          "vtu": ".vtu", "vsm": "", "stream": "", "abaqus": ".inp", "nastran": ".bdf", "mfem": ".mesh", "netgen": ".vol"}

def problems(low, high, middle):
    """Problems with conditions in these places."""
    return {
        "ends": {"dirichlet": [{**low, "value": [0]}, {**high, "value": [1]}]},
        "positions": {"columns": 3, "dirichlet": [{**low, "value": "position"}, {**high, "value": "position"}]},
        "clamped": {"weights": "clamped", "source": [1], "dirichlet": [{**low, "value": [0]}]},
        "uniform": {"weights": "uniform", "source": [1], "dirichlet": [{**low, "value": [0]}]},
        "tensor": {"conductivity": [3, 2, 1, 0.5, 0.2, 0.1], "screening": 0.3, "source": [2],
                   "outputs": ["gradient", "flux"], "dirichlet": [{**high, "value": [1]}]},
        "rim": {"dirichlet": [{**low, "value": [0]}], "flux": [{**high, "value": [1]}],
                "robin": [{**middle, "coefficient": 2, "ambient": [3]}], "outputs": ["flux"]},
        "free": {"source": [1]},
        "soft": {"soft": [{**high, "value": [1], "weight": 3}], "screening": 0.1},
    }


def system():
    """What the bits may depend on: processor, the libraries of sines and of dense factors."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        fused = "fma" if " fma " in file.read() else "no fma"
    blas = os.path.realpath("/usr/lib/x86_64-linux-gnu/libblas.so.3")
    return ", ".join([platform.machine(), fused, " ".join(platform.libc_ver()), os.path.basename(blas)])


class Golden:
    """Runs the program in a folder and collects checksums by name."""

    def __init__(self, program, folder):
        self.program, self.folder, self.hashes = os.path.abspath(program), folder, {}

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_json(self, name, content):
        with open(self.path(name), "w", encoding="utf-8") as file:
            json.dump(content, file)
        return name

    def run(self, *arguments):
        """The exit code and the messages, without the name of the folder."""
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=1200, check=False)
        return done.returncode, done.stderr.replace(self.folder, "")

    def add(self, name, content):
        assert name not in self.hashes, name
        self.hashes[name] = hashlib.blake2b(content, digest_size=8).hexdigest()

    def make(self, command, source, out, *options):
        """The checksum of what a command writes; the file stays. It may end without convergence."""
        code, said = self.run(command, source, out, *options, "--quiet", "--no-sync")
        assert code in (0, 3), (command, source, out, options, said)
        content = b""
        for name in [out] if not out.endswith(".node") else [out, out[:-5] + ".ele"]:
            if os.path.exists(self.path(name)):
                with open(self.path(name), "rb") as file:
                    content += file.read()
        self.add(" ".join([command, source, out, *map(str, options)]), content + f"{code} {said}".encode())

    def make_by_paper(self, source, problem, out):
        """The checksum of what the equations of the paper give, by a program beside smg."""
        program = os.path.join(os.path.dirname(self.program), "solve_shi2006")
        subprocess.run([program, source, problem, out], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        with open(self.path(out), "rb") as file:
            self.add(f"solve_shi2006 {source} {problem} {out}", file.read())


def make_meshes(golden):
    """Writes the meshes of the jobs; returns the formats in which each can be restored."""
    from mesh_files import SOLIDS, SURFACES
    from odd_mesh import odd_solid, odd_surface
    from program import write_medit, write_ply, write_torus
    from tetrahedra import tetrahedra
    from torus import torus
    points, cells = torus(90, 45)
    shade = [int(100 + 50 * point[0]) % 200 for point in points]
    scan = [1 if point[0] > 0 else 2 for point in points]
    write_ply(golden.path("scan.ply"), points, cells, {"shade": ("float", shade), "scan": ("int", scan)})
    write_torus(golden.path("torus.obj"), 64, 32)
    points, cells = odd_surface(48, 24)
    write_ply(golden.path("odd.ply"), points, cells, {"tag": ("int", range(len(points)))})
    points, cells = tetrahedra(11)
    write_medit(golden.path("cube.mesh"), [tuple(x / 5 - 1 for x in point) for point in points], cells)
    write_medit(golden.path("oddcube.mesh"), *odd_solid(7))
    shutil.copy(os.path.join(TREE, "Examples", "Data", "bunny.smb"), golden.path("bunny.smb"))
    return {"scan.ply": SURFACES, "torus.obj": SURFACES, "odd.ply": SURFACES, "cube.mesh": SOLIDS + (".node",),
            "oddcube.mesh": SOLIDS + (".node",), "bunny.smb": []}


def convert_all(golden, meshes):
    for mesh, formats in meshes.items():
        stem = mesh.split(".")[0]
        for order in ("bfs", "axis", "keep", "spectral"):
            golden.make("convert", mesh, f"{stem}-{order}.vsm", "--order", order)
        golden.make("convert", mesh, f"{stem}-welded.vsm", "--weld", "1e-6", "--codec", "lz4")
        for suffix in SOLID_STREAMS if "cube" in mesh else SURFACE_STREAMS:
            golden.make("convert", mesh, f"{stem}-stream{suffix}")
        for suffix in formats:
            golden.make("convert", f"{stem}-bfs.vsm", f"{stem}-restored{suffix}", "--restore-order")
            golden.make("convert", f"{stem}-restored{suffix}", f"{stem}-from{suffix}.vsm")


def ends_of(golden, mesh):
    """The lowest and the highest fifth of a mesh, and a ball in the middle, as places."""
    golden.run("info", mesh, "--quiet", "--report", "info.json")
    with open(golden.path("info.json"), encoding="utf-8") as file:
        bounds = json.load(file)["bounds"]
    low, high = bounds[::2], bounds[1::2]
    fifth = (high[2] - low[2]) / 5
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    return ({"halfspace": [0, 0, -1, -low[2] - fifth]}, {"halfspace": [0, 0, 1, high[2] - fifth]},
            {"sphere": [*middle, 3 * (high[0] - low[0])]})


def solve_all(golden, meshes):
    for mesh in meshes:
        stem = mesh.split(".")[0]
        stream, suffix = stem + "-bfs.vsm", ".vtu" if "cube" in mesh else ".ply"
        low, high, middle = ends_of(golden, stream)
        for name, problem in problems(low, high, middle).items():
            golden.write_json(name + ".json", problem)
            golden.make("solve", stream, f"{stem}-{name}.vsm", "--problem", name + ".json")
        golden.make("solve", stream, f"{stem}-core.vsm", "--problem", "tensor.json", "--in-core", "--sweeps", 3)
        golden.make("solve", stream, f"{stem}-auto.vsm", "--problem", "tensor.json", "--tolerance", "auto")
        golden.make_by_paper(stream, "ends.json", f"{stem}-paper.vsm")
        golden.make("solve", mesh, f"{stem}-direct.vtu", "--problem", "rim.json", "--acceleration", "none")
        golden.write_json("handles.json", {"handles": [{"region": low, "fixed": True}, {
            "region": high, "translate": [0.1, 0.2, 0.4], "scale": 1.2,
            "rotate": {"axis": [1, 2, 3], "degrees": 40, "center": [0, 0, 1]}}]})
        golden.make("deform", stream, f"{stem}-deformed.vsm", "--handles", "handles.json")
        golden.make("deform", mesh, f"{stem}-cycles{suffix}", "--handles", "handles.json", "--cycles", 3, "--in-core")
        golden.make("distance", stream, f"{stem}-away.vsm", "--from", json.dumps(low), "--source", "--direction")
        golden.make("smooth", f"{stem}-away.vsm", f"{stem}-column.vsm", "--column", "Distance")
        golden.make("area", stream, f"{stem}-area.vsm", "--of", json.dumps(low), "--scale", 0.1)
        if suffix == ".ply":
            golden.make("smooth", stream, f"{stem}-smooth.vsm", "--size", "3edges", "--steps", 2)
            golden.make("smooth", mesh, f"{stem}-edges.ply", "--keep-edges", 40, "--hold", json.dumps(low))
        else:
            golden.make("distance", stream, f"{stem}-wall.vsm", "--wall")
        golden.make("simplify", stream, f"{stem}-small.vsm", "--vertices", 300)
        golden.make("simplify", mesh, f"{stem}-coarse.ply", "--error", 0.05)
        golden.make("preview", stream, f"{stem}-preview.vsm", "--points", 400)
    for seam in "zero", "average":
        golden.make("blend", "scan-bfs.vsm", f"scan-{seam}.vsm", "--patch", "scan", "--columns", "shade", "--seam",
                    seam)


def damage_all(golden):
    """What is said of the files of the fuzzers, together for each format."""
    corpus = os.path.join(TREE, "Testing", "Fuzzing", "corpus")
    for target, suffix in CORPUS.items():
        said = []
        for name in sorted(os.listdir(os.path.join(corpus, target))):
            copy = name if re.search(r"\.\w{3,4}$", name) else name + (suffix or ".vsm")
            shutil.copy(os.path.join(corpus, target, name), golden.path(copy))
            said.append((name, *golden.run("convert", copy, "damaged.vsm", "--quiet")))
            os.remove(golden.path(copy))
        golden.add("damaged " + target, json.dumps(said).encode())


def mesh_all(golden, folder):
    golden.write_json("vertex.json", {"source": [1], "dirichlet": [{"vertices": [1000], "value": [0]}]})
    for mesh in sorted(entry.name for entry in os.scandir(folder) if entry.is_file()):
        os.symlink(os.path.join(os.path.abspath(folder), mesh), golden.path(mesh))
        golden.make("convert", mesh, mesh + ".vsm", *(["--cells", "tets"] if "_tet" in mesh else []))
        golden.make("solve", mesh + ".vsm", mesh + "-solved.vsm", "--problem", "vertex.json", "--max-cycles", 5)
        os.remove(golden.path(mesh + ".vsm"))
        os.remove(golden.path(mesh + "-solved.vsm"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="SMG")
    parser.add_argument("--write", action="store_true", help="write the table instead of comparing with it")
    parser.add_argument("--meshes", metavar="FOLDER", help="a folder of meshes of any format")
    arguments = parser.parse_args()
    name = f"hashes-{os.path.basename(arguments.meshes)}.txt" if arguments.meshes else "hashes.txt"
    table = os.path.join(HERE, name)
    if not arguments.write:
        with open(table, encoding="utf-8") as file:
            first, *rows = file.read().splitlines()
        if first != system():
            print(f"The table is of {first}, this is {system()}.")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SMG_PROGRAM"] = arguments.program  # the scripts of Testing/Examples want it
        golden = Golden(arguments.program, folder)
        if arguments.meshes:
            mesh_all(golden, arguments.meshes)
        else:
            meshes = make_meshes(golden)
            convert_all(golden, meshes)
            solve_all(golden, meshes)
            damage_all(golden)
    made = [f"{value}  {name}" for name, value in golden.hashes.items()]
    if arguments.write:
        with open(table, "w", encoding="utf-8") as file:
            file.write("\n".join([system(), *made]) + "\n")
        print(f"{len(made)} results written to {table}")
        return
    changed = [line for line in made if line not in set(rows)]
    missing = len(set(line.split("  ", 1)[1] for line in rows) - set(golden.hashes))
    for line in changed:
        print("changed:", line.split("  ", 1)[1])
    print(f"{len(made) - len(changed)} of {len(made)} results are the same, {missing} are no longer made")
    sys.exit(1 if changed or missing else 0)


if __name__ == "__main__":
    main()
