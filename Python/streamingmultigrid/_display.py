# SPDX-License-Identifier: BSD-3-Clause
"""How reports, meshes and fields show themselves in notebooks: HTML with pictures in SVG."""

from __future__ import annotations

import html
import math
from typing import Any, Iterable, List, Optional, Tuple

import numpy as np

from ._arrays import counted

_STYLE = "font-family:sans-serif;font-size:13px"


def _table(rows: Iterable[Tuple[str, str]]) -> str:
    cells = "".join(
        "<tr><td style='text-align:left;padding-right:1em'>%s</td>"
        "<td style='text-align:left'>%s</td></tr>" % (html.escape(name), html.escape(value))
        for name, value in rows
    )
    return "<table>%s</table>" % cells


def _block(title: str, *parts: str) -> str:
    return "<div style='%s'><b>%s</b>%s</div>" % (_STYLE, html.escape(title), "".join(parts))


def convergence_svg(residuals: List[Optional[float]], width: int = 360, height: int = 160) -> str:
    """The relative residuals over the V-cycles, on a logarithmic axis."""
    values = [1.0, *(value for value in residuals if value)]
    if len(values) < 2:
        return ""
    low = math.floor(math.log10(min(values)))
    left, bottom, right, top = 45, height - 25, width - 10, 10
    step = (right - left) / (len(values) - 1)
    points = [
        (left + i * step, top + (bottom - top) * math.log10(value) / low if low else top)
        for i, value in enumerate(values)
    ]
    every = max(1, -low // 5)
    grid = "".join(
        "<line x1='%d' x2='%d' y1='%.1f' y2='%.1f' stroke='#ddd'/>"
        "<text x='%d' y='%.1f' font-size='10' text-anchor='end'>1e%d</text>"
        % (left, right, y, y, left - 4, y + 3, -power)
        for power in range(0, -low + 1, every)
        for y in [top + (bottom - top) * power / max(1, -low)]
    )
    line = " ".join("%.1f,%.1f" % point for point in points)
    dots = "".join("<circle cx='%.1f' cy='%.1f' r='2' fill='#1f6fb4'/>" % point for point in points)
    return (
        "<svg width='%d' height='%d' role='img' aria-label='Residuals'>%s"
        "<polyline points='%s' fill='none' stroke='#1f6fb4' stroke-width='1.5'/>%s"
        "<text x='%d' y='%d' font-size='10' text-anchor='end'>%d V-cycles</text></svg>"
        % (width, height, grid, line, dots, right, height - 8, len(values) - 1)
    )


def surface_svg(points: np.ndarray, triangles: np.ndarray, values: Any = None, size: int = 240) -> str:
    """A surface from the front, above and the side; far triangles first.

    Args:
        points: (n, 3). triangles: (m, 3). values: None, or (n,) numbers that colour the surface.
    """
    turn, lean = math.radians(-30), math.radians(20)
    across = np.array([math.cos(turn), math.sin(turn), 0])
    depth = np.array([-math.sin(turn) * math.cos(lean), math.cos(turn) * math.cos(lean), -math.sin(lean)])
    upwards = np.cross(across, depth)
    seen = points @ np.stack([across, upwards, depth], axis=1)
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = (size - 4) / max(float((high - low)[:2].max()), 1e-300)
    flat = np.stack([seen[:, 0] - low[0], high[1] - seen[:, 1]], axis=1) * scale + 2
    corners = seen[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = np.abs(normals[:, 2]) / np.where(lengths > 0, lengths, 1)
    colours = np.full((len(triangles), 3), [175.0, 190.0, 205.0])
    if values is not None and np.isfinite(values).any():
        least, most = np.nanmin(values), np.nanmax(np.where(np.isfinite(values), values, np.nan))
        part = np.nan_to_num((values - least) / (most - least if most > least else 1), nan=0.5)
        part = np.clip(part[triangles].mean(axis=1), 0, 1)[:, None]
        blue, white, red = np.array([59, 76, 192]), np.array([221, 221, 221]), np.array([180, 4, 38])
        colours = np.where(
            part < 0.5, blue + (white - blue) * 2 * part, white + (red - white) * (2 * part - 1)
        )
    colours = (colours * (0.45 + 0.55 * light)[:, None]).astype(int)
    polygons = "".join(
        "<path d='M%.1f %.1fL%.1f %.1fL%.1f %.1fz' fill='#%02x%02x%02x'/>"
        % (*flat[triangles[i]].ravel(), *colours[i])
        for i in np.argsort(-corners[:, :, 2].mean(axis=1))
    )
    return "<svg width='%d' height='%d' role='img' aria-label='Preview'>%s</svg>" % (
        size,
        math.ceil((high - low)[1] * scale) + 4,
        polygons,
    )


def report_html(report: Any) -> str:
    """A report: its lines, and the convergence."""
    first, *rest = repr(report).split("\n")
    lines = "".join("<div>%s</div>" % html.escape(line) for line in rest)
    return _block(first, lines, convergence_svg(report.get("residuals") or []))


def estimate_html(estimate: Any) -> str:
    """An estimate as a table."""
    return _block(repr(estimate).split("\n")[0], _table(estimate.lines()))


def closed_html(thing: Any) -> str:
    """What a notebook shows of a mesh or field that has been closed."""
    return "<p>%s</p>" % html.escape(repr(thing))


def mesh_html(title: str, rows: Iterable[Tuple[str, str]], picture: str) -> str:
    """A mesh: what is known of it, and a picture."""
    return _block(title, _table(rows), picture)


def _values(column: Any) -> str:
    """The range of a column of a description, and its tags."""

    def number(value: Any) -> str:
        return "nan" if value is None else "%.6g" % value

    ranges = zip(column.get("minimum") or [], column.get("maximum") or [])
    words = ", ".join("[%s, %s]" % (number(low), number(high)) for low, high in ranges)
    if column.get("not_finite"):
        words += ", {:,} not finite".format(column["not_finite"])
    tags = column.get("tags")
    if tags:
        shown = ["%s (%s)" % (tag, format(count, ",")) for tag, count in list(tags.items())[:8]]
        words += "; " + ", ".join(shown) + (", ..." if len(tags) > len(shown) else "")
    return words


def _topology(found: Any) -> List[Tuple[str, str]]:
    """Bodies, boundary and cells of a description; what it does not have is left out."""

    def count(key: str, *noun: str) -> List[str]:
        return [counted(found[key], *noun)] if found.get(key) else []

    boundary = [
        *count("boundary_edges", "edge"),
        *count("boundary_loops", "loop"),
        *count("boundary_faces", "face"),
        *count("boundary_surfaces", "surface"),
    ]
    flaws = [
        *count("nonmanifold_edges", "non-manifold edge"),
        *count("nonmanifold_vertices", "non-manifold vertex", "non-manifold vertices"),
        *count("nonmanifold_faces", "face of more than two cells", "faces of more than two cells"),
        *count("turned_edges", "edge wound against another", "edges wound against each other"),
        *count("inverted_cells", "inverted cell"),
        *count("degenerate_cells", "degenerate cell"),
        *count("duplicate_cells", "duplicate cell"),
    ]
    lines = []
    if "bodies" in found:
        lines.append(("bodies", "{:,}".format(found["bodies"])))
        lines.append(("boundary", ", ".join(boundary) or "none"))
        lines.append(("flaws", ", ".join(flaws) or "none"))
    for key, words in (("edge_length", "edges"), ("quality", "quality")):
        if key in found:
            low, mean = found[key].get("minimum"), found[key].get("mean")
            lines.append((words, "at least %.4g, mean %.4g" % (low or 0, mean or 0)))
    return lines


def _digits(bound: float, info: Any) -> str:
    """With all digits of the positions: rounded bounds would be those of other meshes."""
    text = str(bound if info["positions"] == "float64" else np.float32(bound))
    return text[:-2] if text.endswith(".0") else text


def mesh_lines(info: Any) -> List[Tuple[str, str]]:
    """What is known of a mesh, for people: names and values. `info`: the JSON of smg_info()."""
    kind = ("triangle",) if info["cell_type"] == "triangle" else ("tetrahedron", "tetrahedra")
    bounds = info["bounds"]
    lines = [
        ("vertices", "{:,} ({})".format(info["vertices"], info["positions"])),
        ("cells", counted(info["cells"], *kind)),
        ("bounds", " x ".join("[%s, %s]" % tuple(_digits(bound, info) for bound in pair) for pair in zip(bounds[::2], bounds[1::2]))),
    ]
    if info.get("isolated_vertices"):
        lines.append(("isolated", counted(info["isolated_vertices"], "vertex", "vertices") + " of no cell"))
    description = info.get("description") or {}
    lines += _topology(description)
    columns = description.get("columns") or info["columns"]
    for place in ("vertices", "cells"):
        for column in columns[place]:
            words = "%s x %d, of the %s" % (column["type"], column["components"], place)
            values = _values(column)
            lines.append((column["name"], words + (": " + values if values else "")))
    return lines + [("note", note) for note in description.get("notes") or []]
