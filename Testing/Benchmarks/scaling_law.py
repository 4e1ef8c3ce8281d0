# SPDX-License-Identifier: BSD-3-Clause
"""The results of scaling.py: exponents of the growth, Markdown tables and a plot."""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))
from documented_tables import markdown  # noqa: E402

MEBIBYTE = 1 << 20
SOLVERS = {  # in the plot: colour and label
    "smg": ("tab:blue", "streaming"),
    "smg-in-core": ("tab:cyan", "the same in core"),
    "hypre": ("tab:orange", "hypre BoomerAMG"),
    "petsc": ("tab:green", "PETSc GAMG"),
    "cholmod": ("tab:red", "CHOLMOD"),
}


def exponent(points):
    """The e of the least-squares fit log y = e log x + c; None for fewer than two points."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    if len(logs) < 2:
        return None
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs)
            / sum((x - mean_x) ** 2 for x, _ in logs))


def streaming(point, threads=1):
    return point["streaming"][str(threads)]


# The quantities that are fitted against the number of vertices.
GROWTHS = {
    "peak_nodes": lambda point: streaming(point)["report"]["peak_nodes"],
    "pool_bytes": lambda point: streaming(point)["report"]["pool_bytes_peak"],
    "cpu_seconds": lambda point: streaming(point)["cpu_total"],
}


def growth(points):
    """Exponents over all points, and over the two largest meshes."""
    def fit(of, name):
        return exponent([(point["vertices"], GROWTHS[name](point)) for point in of])
    return {name: {"all": fit(points, name), "last": fit(points[-2:], name)} for name in GROWTHS}


def mebibytes(value, digits=0):
    return f"{value / MEBIBYTE:.{digits}f}"


def streaming_table(series):
    """A row for each mesh, solved out of core."""
    rows = []
    for entry in series:
        for point in entry["points"]:
            vertices, one = point["vertices"], streaming(point)
            report, of_two = one["report"], streaming(point, 2)["report"]
            rows.append([
                entry["mesh"], vertices, point["convert"]["span"], report["peak_nodes"],
                mebibytes(report["pool_bytes_peak"], 1), mebibytes(one["peak_bytes"]),
                f'{1e6 * point["convert"]["cpu_seconds"] / vertices:.2f}',
                f'{1e6 * one["cpu_total"] / vertices:.2f}', f'{report["seconds"]["total"]:.2f}',
                f'{of_two["seconds"]["total"]:.2f}', one["iterations"]])
    return markdown(
        ["mesh", "vertices", "span", "peak nodes", "accounted MiB", "process MiB",
         "convert, CPU us/vertex", "solve, CPU us/vertex", "wall s, 1 thread", "2 threads",
         "V-cycles"], rows)


def growth_table(series):
    """A row for each series with data to fit."""
    rows = []
    for entry in series:
        if len(entry["points"]) > 1:
            fits = growth(entry["points"])
            rows += [[f'{entry["mesh"]}, {what}'] + [f"{fits[name][which]:.2f}" for name in GROWTHS]
                     for which, what in (("all", "all"), ("last", "the last two"))]
    return markdown(["exponent of the growth with the vertices", "peak nodes", "accounted memory",
                     "CPU time"], rows)


def peer_table(series):
    """A row for each mesh that the other solvers have solved, too."""
    results = [(entry["mesh"], point["vertices"], {"smg": streaming(point), **point["peers"]})
               for entry in series for point in entry["points"] if point["peers"]]
    solvers = [name for name in SOLVERS if any(name in of for _, _, of in results)]

    def cell(vertices, result):
        if result is None or "failed" in result:
            return "failed" if result else ""
        return f'{1e6 * result["cpu_total"] / vertices:.2f}, {mebibytes(result["peak_bytes"])}'
    return markdown(
        ["CPU us/vertex, MiB", "vertices", *(SOLVERS[name][1] for name in solvers)],
        [[mesh, vertices, *(cell(vertices, of.get(name)) for name in solvers)]
         for mesh, vertices, of in results]) if results else ""


def curve(entry, solver, value):
    """(vertices, value) of a solver on the meshes of a series that it has solved."""
    points = []
    for point in entry["points"]:
        result = streaming(point) if solver == "smg" else point["peers"].get(solver, {})
        if result and "failed" not in result:
            points.append((point["vertices"], value(result)))
    return points


def plot(series, file):
    """Plots memory and time against the vertices, logarithmic, as SVG."""
    pyplot.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "smg", "font.size": 9})
    figure, (memory, time) = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for entry, style in zip(series, ("o-", "s--", "^:", "v-.") * len(series)):
        for solver, (colour, label) in SOLVERS.items():
            for axes, value in (
                    (memory, lambda result: result["peak_bytes"] / MEBIBYTE),
                    (time, lambda result: result["cpu_total"])):
                points = curve(entry, solver, value)
                if points:
                    axes.loglog(*zip(*points), style, color=colour, markersize=4, linewidth=1.2,
                                label=f'{label}, {entry["mesh"]}')
    memory.set_ylabel("memory of the process, MiB")
    time.set_ylabel("CPU time of the solve, s")
    for axes in (memory, time):
        axes.set_xlabel("vertices")
        axes.grid(True, which="major", alpha=0.3)
    handles, labels = memory.get_legend_handles_labels()
    figure.legend(handles, labels, loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    figure.savefig(file, bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)


def write(out, numbers):
    """Writes scaling.md, .json and .svg to the folder `out`."""
    series, machine = numbers["series"], numbers["machine"]
    (out / "scaling.json").write_text(json.dumps(numbers, indent=1) + "\n")
    (out / "scaling.md").write_text(
        f'Measured on {machine["processor"]}, {machine["cores"]} cores, {machine["memory_gib"]} '
        f"GiB of memory:\n\n{streaming_table(series)}\n{growth_table(series)}\n{peer_table(series)}")
    plot(series, out / "scaling.svg")
