# SPDX-License-Identifier: BSD-3-Clause
"""What a job did and what it cost, and what it is expected to cost."""

from __future__ import annotations

import dataclasses
import difflib
from typing import Any, Dict, List

import numpy as np

from ._arrays import counted
from ._display import estimate_html, report_html
from ._errors import NotConvergedWarning, ReportWarning, warn
from ._options import entries_of


class _Facts(dict):
    """A dict whose keys are attributes, too: those that its class declares are all that there may be."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(self._without(name)) from None

    def _without(self, name: str) -> str:
        """The sentence on an entry that is asked for, but not there."""
        if name in type(self).__annotations__:
            return "This %s has no entry %r, which other jobs or arguments have." % (type(self).__name__.lower(), name)
        near = difflib.get_close_matches(name, [*self, *type(self).__annotations__], 1)
        meant = ": %r is meant" % near[0] if near else ""
        return "There is no entry %r in reports and estimates%s." % (name, meant)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self]

    def to_dict(self) -> Dict[str, Any]:
        """The entries as a dict of Python's own types, as json.dumps() takes it."""
        return dict(self)


def in_bytes(count: float) -> str:
    """A number of bytes with a unit."""
    for unit in ("bytes", "KiB", "MiB", "GiB", "TiB"):
        if abs(count) < 1024 or unit == "TiB":
            break
        count /= 1024
    return "%.0f %s" % (count, unit) if unit == "bytes" or count >= 10 else "%.1f %s" % (count, unit)


def _residual(value: Any) -> str:
    return "not finite" if value is None else "%.2e" % value


class Report(_Facts):
    """The report of a job: a dict with the entries of ``smg --report``, which are attributes, too.

    Of a solve for example `vertices`, `cells`, `passes`, `cycles`, `residuals` (relative, one for each
    V-cycle), `converged`, `pool_bytes_peak` (accounted memory, bytes), `seconds` (a dict),
    `conditions`, `contacts`, `integrals`, `energy` (1/2 the integral of grad u . K grad u + s u^2, for each column), `mean`,
    `minimum`, `maximum`, `notes` and `warnings` (sentences). Numbers that are not finite are None.
    docs/solve.md describes all of them. Some are of some jobs alone; `to_dict` makes a plain dict.
    """

    def __repr__(self) -> str:
        return "\n".join(self._lines())

    def _repr_html_(self) -> str:
        return report_html(self)

    def _lines(self) -> List[str]:
        lines = [counted(self["vertices"], "vertex", "vertices") + ", " + counted(self["cells"], "cell")]
        if "converged" in self:
            residuals = self.get("residuals") or []
            outcome = "converged" if self["converged"] else "NOT CONVERGED"
            if self["converged"] and not residuals and self.get("levels"):
                outcome += ", the values already are the solution"
            elif residuals:
                outcome += " after %s, residual %s" % (counted(self["cycles"], "V-cycle"), _residual(residuals[-1]))
                outcome += " of that of %s" % self["relative_to"] if "relative_to" in self else ""
            lines.append("  %s, %s" % (outcome, counted(self.get("passes", 0), "pass", "passes")))
        if "error" in self:
            lines.append("  error %s" % self["error"])
        seconds = (self.get("seconds") or {}).get("total", 0)
        lines.append(
            "  %.3g s, %.3g s of CPU, %s of memory accounted"
            % (seconds, self.get("cpu_seconds", 0), in_bytes(self.get("pool_bytes_peak", 0)))
        )
        for condition in self.get("conditions") or []:
            lines.append(
                "  %s: mean %s, flux %s"
                % (condition["name"], condition.get("mean"), condition.get("flux"))
            )
        for contact in self.get("contacts") or []:
            lines.append(
                "  %s: area %.6g, mean step %s, flow %s"
                % (contact["name"], contact["area"], contact.get("step"), contact.get("flow"))
            )
        for part in self.get("integrals") or []:
            lines.append(
                "  %s: measure %.6g, integral %s, mean %s"
                % (part["name"], part["measure"], part.get("integral"), part.get("mean"))
            )
        lines += ["  " + note for note in self.get("notes") or []]
        return lines


@dataclasses.dataclass(frozen=True, eq=False)
class ShortestPath:
    """A shortest path of `distance`: the vertex `to`, the nearest source, both by their numbers, its
    length in the unit of the mesh, and the corners of a polyline from the source on, (n, 3).

    Where no source reaches the vertex, `source` is -1, the length is infinite, and there are no points.
    """

    to: int
    source: int
    length: float
    points: np.ndarray

    def __repr__(self) -> str:
        return "<ShortestPath from %d to %d, length %.6g, %d points>" % (
            self.source,
            self.to,
            self.length,
            len(self.points),
        )

    @classmethod
    def of(cls, entry: Dict[str, Any]) -> ShortestPath:
        """That of an entry of a report."""
        length = np.inf if entry["length"] is None else entry["length"]
        return cls(entry["to"], entry["from"], length, np.array(entry["points"], float).reshape(-1, 3))


class Estimate(_Facts):
    """What a job is expected to cost: a dict whose keys are attributes, too.

    `memory_bytes`, `memory_limit`, `scratch_bytes`, `scratch_free`, `output_bytes`, `output_free`
    (bytes), `passes` over the mesh, and `cpu_seconds`. `counted` says whether `vertices` and `cells`
    are known; else they are estimated from the size of the file.
    """

    def __repr__(self) -> str:
        about = "" if self.get("counted", True) else "about "
        return "\n".join(
            ["%s%s, %s" % (about, counted(self["vertices"], "vertex", "vertices"), counted(self["cells"], "cell"))]
            + ["  %-8s %s" % line for line in self.lines()]
        )

    def lines(self) -> list:
        """The figures with their names, for people."""
        lines = [
            (
                "memory",
                "about %s, the limit is %s"
                % (in_bytes(self["memory_bytes"]), in_bytes(self["memory_limit"])),
            )
        ]
        for name in ("scratch", "output"):
            if self.get(name + "_bytes"):
                words = "about %s" % in_bytes(self[name + "_bytes"])
                if self.get(name + "_free"):
                    words += ", %s are free" % in_bytes(self[name + "_free"])
                lines.append((name, words))
        if self.get("passes"):
            lines.append(("passes", "about %d" % self["passes"]))
        if self.get("cpu_seconds") is not None:
            lines.append(("time", "about %.3g s of CPU" % self["cpu_seconds"]))
        return lines

    def _repr_html_(self) -> str:
        return estimate_html(self)


# Those that the library lists.
Report.__annotations__ = entries_of("report", "simplify_report")
Estimate.__annotations__ = entries_of("estimate")


def warn_of(report: Report, said: set) -> None:
    """Turns what a report warns of into warnings of Python, each sentence once."""
    converged = report.get("converged", True)
    for sentence in report.get("warnings") or []:
        if sentence not in said:
            said.add(sentence)
            kind = ReportWarning if converged else NotConvergedWarning
            warn(sentence, kind)
    if not converged and NotConvergedWarning not in said:
        said.add(NotConvergedWarning)
        warn(not_converged(report), NotConvergedWarning)


def warn_of_notes(report: Report) -> None:
    """The notes, too, become warnings where nobody sees the report."""
    for sentence in report.get("notes") or []:
        warn(sentence, ReportWarning)


def sentences_of_conversion(conversion: Dict[str, Any]) -> List[str]:
    """What a conversion has left out or changed, and its notes."""
    sentences = list(conversion.get("changes") or [])
    isolated = conversion.get("isolated_vertices", 0)
    if isolated > 0:
        sentences.append(
            counted(isolated, "vertex belongs to no cell: no job computes with it.",
                    "vertices belong to no cell: no job computes with them.")
        )  # fmt: skip
    if conversion.get("keeps_numbers"):
        sentences.append(
            "The file has a column OriginalId or OriginalCellId of its own: rows are in the order of its numbers, or "
            "where these are not 0, 1, ... in stream order, perhaps not in that of the file. Open it with "
            'numbering="rows" to have those of the file.'
        )
    return sentences + list(conversion.get("notes") or [])


def not_converged(report: Report) -> str:
    """The sentence of a job that did not converge."""
    residuals = report.get("residuals") or []
    if residuals:
        return "Not converged after %s: the relative residual is %s." % (
            counted(report.get("cycles", len(residuals)), "V-cycle"),
            _residual(residuals[-1]),
        )
    return "Not settled after %s." % counted(report.get("passes", 0), "pass", "passes")
