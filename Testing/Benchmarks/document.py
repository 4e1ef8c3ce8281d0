#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""document.py [RESULTS] : writes what run.sh measured into the documents.

RESULTS is the folder of its results (build-benchmarks/results), of which a part may be missing. In README.md,
docs/performance.md and docs/paper.md the tables between the lines `<!-- NAME -->` and `<!-- end -->` are replaced; NAME is
that of a method of Tables or of a .md file of RESULTS, with `:N` its Nth table. The files that were used are copied to
Testing/Benchmarks/results, without the paths of the machine. With --check, the documents must have what the files there
say.
"""
import argparse
import json
import pathlib
import re
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TREE / "Testing" / "Support"))
from documented_tables import markdown, replace_tables  # noqa: E402

KEPT = TREE / "Testing" / "Benchmarks" / "results"
PAGES = (TREE / "README.md", TREE / "docs" / "performance.md", TREE / "docs" / "paper.md")
MESHES = {
    "armadillo43k-x16": "armadillo43k, refined twice",
    "armadillo43k-x64": "armadillo43k, refined three times",
    "armadillo43k-x256": "armadillo43k, refined four times",
    "gyroid-860000": "gyroid by marching tetrahedra",
    "head_tet336k-x8": "head_tet336k, refined once",
    "head_tet336k-x64": "head_tet336k, refined twice",
}
SOLVERS = {
    "smg": "streaming, out of core (build + solve)",
    "smg-in-core": "the same code in core",
    "hypre": "hypre BoomerAMG-PCG (assembly, set-up, solve)",
    "petsc": "PETSc GAMG-PCG (assembly, set-up, solve)",
    "cholmod": "CHOLMOD, simplicial (assembly, factor, solve)",
}


def per_gib(vertices, size):
    """Millions of vertices."""
    millions = vertices / size * 2**30 / 1e6
    return f"{millions:.0f}" if millions >= 10 else f"{millions:.1f}"


class Tables:
    """What documents have of the results of a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.used = {}  # files and their text
        self.reading = {}  # those of the table that is made

    def read(self, name):
        """The text of a file, in which paths are names of files."""
        text = (self.folder / name).read_text(encoding="utf-8")
        if name.endswith(".json"):
            numbers = json.loads(text)
            if isinstance(numbers, dict):
                numbers.pop("context", None)  # Google Benchmark's, of the host
            text = json.dumps(numbers, indent=1) + "\n"
        if not name.endswith(".svg"):
            text = re.sub(r"(?<![\w.])(?:\.\.?)?(?:/[\w.+-]+)+/([\w.+-]+)", r"\1", text)
        self.reading[name] = text
        return text

    def json(self, name):
        return json.loads(self.read(f"{name}.json"))

    def text(self, name):
        """The text NAME of the page; None if what it needs has not been measured."""
        name, _, argument = name.partition(":")
        self.reading = {}
        try:
            if name.endswith(".md"):
                text = self.read(name)
                if argument:
                    text = re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)[int(argument) - 1]
                    text = re.sub(r"^\| ([\w-]+)\.vsm \| (\d+) \|", lambda cells: (
                        f"| {MESHES.get(cells[1], cells[1])} | {int(cells[2]):,} |"), text, flags=re.MULTILINE)
                for numbers in (f"{name[:-3]}.json", f"{name[:-3]}.svg"):
                    if (self.folder / numbers).exists():
                        self.read(numbers)
            else:
                text = getattr(self, name)(*[argument] * bool(argument))
        except (FileNotFoundError, IndexError, KeyError):
            return None
        self.used.update(self.reading)
        return text

    def peers(self, mesh):
        """The solvers on a mesh."""
        numbers = self.json(mesh)
        vertices, rows = numbers["vertices"], []
        for solver, title in SOLVERS.items():
            result = numbers["results"].get(solver)
            if not result:
                continue
            if "failed" in result:
                rows.append([title, "failed", "", "", ""])
                continue
            cycles = result["iterations"]
            rows.append([title, f"{1e6 * result['cpu_total'] / vertices:.1f}", f"{result['peak_bytes'] / vertices:.0f}",
                         per_gib(vertices, result["peak_bytes"]),
                         {"smg": f"{cycles} V-cycles in {cycles + 1} passes", "cholmod": "direct"}.get(solver, cycles)])
        millions = f"{vertices / 1e6:.2f}M vertices"
        return markdown([millions, "CPU us/vertex", "peak bytes/vertex", "million vertices per GiB", "iterations"], rows)

    def preview(self, mesh):
        """Updates while a handle is dragged."""
        names = {"start": "the first one, with the hierarchy", "update/3_cycles": "3 V-cycles a step",
                 "update/6_cycles": "6 V-cycles a step", "update/tolerance_1e-4": "to a tolerance of 1e-4"}
        runs = {run["name"]: run for run in self.json(f"{mesh}-interactive")["benchmarks"]}
        rows = []
        for name, title in names.items():
            times = [next(run["real_time"] for key, run in runs.items() if key.startswith(name) and key.endswith(weights))
                     for weights in ("cotangent", "uniform")]
            rows.append([title, *(f"{time:.0f}" for time in times)])
        return markdown(["update, ms", "cotangent weights", "uniform weights"], rows)

    def convergence(self):
        """What holds V-cycles up."""
        def count(solve):
            return solve["cycles"] if solve["converged"] else f"more than {solve['cycles']}"

        def row(mesh):
            plain, finest = mesh["plain"]["residuals"], mesh["levels"][0]
            return [MESHES.get(mesh["mesh"], mesh["mesh"]), f"{mesh['vertices']:,}", count(mesh["from_zero"]),
                    count(mesh["from_positions"]), count(mesh["plain"]), f"{plain[-1] / plain[-2]:.2f}", f"{finest['two_grid']:.2f}",
                    f"{finest['v_cycle']:.2f}", f"{100 * mesh['slowest'][1]['share']:.0f} %"]
        return markdown(["mesh", "vertices", "V-cycles from zero", "from the positions", "without acceleration", "their last factor", "two-grid", "V",
                         "the worst 100"], map(row, self.json("convergence")))

    def hypre(self):
        """V-cycles beside hypre's iterations, from zero and from the positions."""
        rows = []
        for mesh in (result["mesh"] for result in self.json("convergence")):
            numbers, others = self.json(f"{mesh}-hypre-zero"), self.json(f"{mesh}-hypre")
            vertices, smg, hypre = numbers["vertices"], numbers["results"]["smg"], numbers["results"]["hypre"]
            size = f"{smg['peak_bytes'] / vertices:.0f}"
            cycles = f"{smg['iterations']}, {others['results']['smg']['iterations']}"
            row = [MESHES.get(mesh, mesh), f"{vertices:,}", cycles]
            iterations = [f"{run['iterations'] / 3:.0f}" if "failed" not in run else "fails"
                          for run in (hypre, others["results"]["hypre"])]
            row += [", ".join(iterations), f"{size}, {hypre['peak_bytes'] / vertices:.0f}",
                    f"{smg['cpu_total'] / hypre['cpu_total']:.2f}"]
            rows.append(row)
        return markdown(["mesh", "vertices", "V-cycles of smg", "iterations of hypre, mean of three columns",
                         "memory, bytes per vertex", "CPU time of smg over hypre's"], rows)

    def schedule(self):
        """The model of threads, and what this machine took."""
        surface, solid = (self.json(f"{mesh}-schedule")["model"] for mesh in ("armadillo43k-x64", "head_tet336k-x64"))
        rows = []
        for pair in zip(surface["rows"][1:], solid["rows"][1:]):
            cells = [pair[0]["threads"]]
            for row, model in zip(pair, (surface, solid)):
                cells += [f"{row[key]:.2f}" for key in ("speed_up", "first_pass", "later_passes")]
                cells.append(f"{model['rows'][0]['wall'] / row['wall']:.2f}" if "wall" in row else "")
            rows.append(cells)
        rows.append(["any, if no stage waited for another", f"{surface['limit']:.2f}", "", "", "",
                     f"{solid['limit']:.2f}", "", "", ""])
        return markdown(["threads", "surface, 2.8M vertices: solve", "first pass", "later passes", "measured",
                         "tetrahedra, 3.7M: solve", "first pass", "later passes", "measured"], rows)

    def convert(self):
        """A line for each mesh."""
        rows = []
        for mesh in ("head_mri_1m", "armadillo43k-x64", "head_tet336k-x64", "armadillo43k-x256"):
            numbers = self.json(f"{mesh}-convert")
            result, in_core = numbers["results"][0], numbers["in_core"]
            vertices = result["vertices"]
            quality = ", ".join(f"{result['quality'][key] / in_core[key]:.2f}" for key in ("span", "mean_window")) \
                if in_core and "span" in in_core else ""
            rows.append([MESHES.get(mesh, mesh), f"{vertices:,}", f"{1e6 * result['cpu_seconds'] / vertices:.1f}",
                         f"{result['wall_seconds'] / result['cpu_seconds']:.2f}", f"{result['peak_bytes'] / 1e6:.0f} MB",
                         ", ".join(f"{result[f'scratch_bytes_{what}'] / vertices:.0f}" for what in ("written", "read", "peak")),
                         quality])
        return markdown(["mesh", "vertices", "CPU us/vertex", "wall time over CPU", "resident memory",
                         "bytes of scratch per vertex: written, read, largest", "span, mean window over breadth-first in core"],
                        rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path, nargs="?", default=TREE / "build-benchmarks" / "results")
    parser.add_argument("--check", action="store_true", help="of what the tree has; writes nothing")
    options = parser.parse_args()
    tables, differ = Tables(KEPT if options.check else options.results), False
    for page in PAGES:
        names = set(re.findall(r"^<!-- (\S+) -->$", page.read_text(encoding="utf-8"), re.MULTILINE)) - {"end"}
        texts = {name: tables.text(name) for name in sorted(names)}
        missing = [name for name, text in texts.items() if text is None]
        if missing:
            print(f"{page.relative_to(TREE)}: not measured: {', '.join(missing)}", file=sys.stderr)
        before, after = replace_tables(page, {name: text for name, text in texts.items() if text is not None})
        if not options.check:
            page.write_text(after, encoding="utf-8")
        elif before != after or missing:
            print(f"{page.relative_to(TREE)}: its tables are not those of the results: run document.py", file=sys.stderr)
            differ = True
    if not options.check:
        for name, text in tables.used.items():
            (KEPT / name).write_text(text, encoding="utf-8")
    return differ


if __name__ == "__main__":
    sys.exit(main())
