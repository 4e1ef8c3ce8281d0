# SPDX-License-Identifier: BSD-3-Clause
"""What scaling.py has measured: the exponents of the growth, a Markdown table and a plot."""
import math

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

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


# What is fitted against the number of vertices.
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


def of_peer(point, peer, value):
    result = point["peers"].get(peer)
    return "" if result is None else "failed" if "failed" in result else value(result)


def table(series):
    """Markdown: a row for each mesh, and the exponents."""
    peers = [peer for peer in SOLVERS if any(
        peer in point["peers"] for entry in series for point in entry["points"])]
    head = ["mesh", "vertices", "span", "peak nodes", "accounted MiB", "process MiB",
            "convert, CPU us/vertex", "solve, CPU us/vertex", "wall s, 1 thread", "2 threads",
            "V-cycles"] + [f"{SOLVERS[peer][1]}: CPU us/vertex, MiB" for peer in peers]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for entry in series:
        for point in entry["points"]:
            vertices, one, two = point["vertices"], streaming(point), streaming(point, 2)
            report = one["report"]
            cells = [entry["mesh"], vertices, point["convert"]["span"], report["peak_nodes"],
                     f'{report["pool_bytes_peak"] / MEBIBYTE:.1f}',
                     f'{one["peak_bytes"] / MEBIBYTE:.0f}',
                     f'{1e6 * point["convert"]["cpu_seconds"] / vertices:.2f}',
                     f'{1e6 * one["cpu_total"] / vertices:.2f}',
                     f'{report["seconds"]["total"]:.2f}',
                     f'{two["report"]["seconds"]["total"]:.2f}', one["iterations"]]
            cells += [of_peer(point, peer, lambda result: (
                f'{1e6 * result["cpu_total"] / vertices:.2f}, '
                f'{result["peak_bytes"] / MEBIBYTE:.0f}')) for peer in peers]
            lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
    lines += ["", "| exponent of the growth with the vertices | peak nodes | accounted memory | "
              "CPU time |", "|---|---|---|---|"]
    for entry in series:
        if len(entry["points"]) > 1:
            fits = growth(entry["points"])
            for which, what in (("all", "all"), ("last", "the last two")):
                lines.append(f'| {entry["mesh"]}, {what} | ' + " | ".join(
                    f"{fits[name][which]:.2f}" for name in GROWTHS) + " |")
    return "\n".join(lines) + "\n"


def curve(entry, solver, value):
    """(vertices, value) of a solver on the meshes of a series where it succeeded."""
    points = []
    for point in entry["points"]:
        result = streaming(point) if solver == "smg" else point["peers"].get(solver, {})
        if result and "failed" not in result:
            points.append((point["vertices"], value(result)))
    return points


def plot(series, file):
    """Memory and time against the vertices, logarithmic, as SVG."""
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
