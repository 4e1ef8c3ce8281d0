# SPDX-License-Identifier: BSD-3-Clause
"""The jobs: their arguments in Python, and what the library is told of them.

What all jobs have alike is in _options.py; here is what a job does with its arguments, and returns.
"""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from . import _options
from . import _problem as problems
from ._columns import Columns
from ._errors import InputError
from ._regions import Region, as_regions
from ._regions import vertices as vertices_of

#: For smg_run(), and what finds the columns of the result, once the mesh is open.
_Description = Tuple[Dict[str, Any], Callable[[], List[str]]]


def _where_of_file(added: Columns, region: Region) -> Any:
    """WHERE of a region for a job that takes no columns: of arrays it has the numbers of the vertices."""
    own = Columns(added.mesh)
    where = region.where(own) or {"everywhere": True}
    if not own.added:
        return where
    selected, of_cells = region.selected(added.mesh)
    cells = added.mesh.cells
    # Rows of merged points and of points of no cell are no vertices.
    rows = np.unique(cells[selected] if of_cells else cells[np.asarray(selected)[cells]])
    if not len(rows):
        raise InputError("hold: %r selects no vertex of the mesh." % region)
    return vertices_of(rows).where(own)


#: Arguments with which results are written.
_OF_SAVING = ("path", "text")


class Job:
    """A job: its signature and docstring, and the description of a call for the library.

    `lead` is the argument that may be given by its position. `own` are arguments besides the options, with
    their part `documentation` of the docstring, which ends with what it `raises`.
    """

    def __init__(
        self,
        name: str,
        summary: str,
        result: str,
        lead: Optional[str] = None,
        own: Sequence[inspect.Parameter] = (),
        documentation: str = "",
        raises: str = "",
    ) -> None:
        self.name = name
        self._options = {_options.name_of(each): each for each in _options.described()[name]}
        self._options.pop("text", None)  # of save()
        if own:  # which state the problem as well
            self._options["problem"] = {**self._options["problem"], "required": False}
        leading = [lead] if lead else []
        first = leading + [each for each in self._options if each != lead]
        parameters = [_options.parameter(self._options[each], each == lead) for each in first]
        count = len(leading)
        self.signature = inspect.Signature([*parameters[:count], *own, *parameters[count:]])
        self.arguments = "\n".join(_options.documentation(self._options[each]) for each in first) + "\n"
        self.documentation = "%s\n    Args:\n%s%s%s\n    Returns:\n        %s\n    %s" % (
            summary.strip(" "), documentation, self.arguments, _REPORTING, result, raises
        )  # fmt: skip

    def bind(self, *arguments: Any, **options: Any) -> Dict[str, Any]:
        """The arguments by their names. Raises TypeError for those that the job does not have."""
        try:
            bound = self.signature.bind(*arguments, **options)
        except TypeError as error:
            for_files = [each for each in options if each in _OF_SAVING]
            hint = "; it is one of save()" if for_files else ""
            if arguments and "problem" in self._options:
                hint += "; they are named, as problem=\"heat.json\""
            raise TypeError("%s() %s%s" % (self.name, error, hint)) from None
        bound.apply_defaults()
        return dict(bound.arguments)

    def __call__(self, added: Columns, *arguments: Any, **options: Any) -> _Description:
        given = self.bind(*arguments, **options)
        description = {
            key: value if key not in self._options else self._value(self._options[key], value, added)
            for key, value in given.items()
        }
        names = _RESULTS[self.name](added, given, description)
        keys = {key: self._options.get(key, {}).get("key", key) for key in description}
        return {keys[key]: value for key, value in description.items()}, names if callable(names) else lambda: names

    def _value(self, option: Mapping[str, Any], value: Any, added: Columns) -> Any:
        """An argument as the library takes its option."""
        kind, name = option["kind"], _options.name_of(option)
        if value is None:
            return None
        if kind == "where":
            try:
                regions = as_regions(value)
            except InputError as error:
                raise InputError("%s: %s" % (name, error)) from None
            if self.name == "simplify":
                return [_where_of_file(added, each) for each in regions]
            return [each.where(added) or {"everywhere": True} for each in regions]
        if kind == "columns":
            return added.named(value, name, "Values")
        return value


_REPORTING = """        progress: a function of the part that is done, a bar of tqdm or rich, or True.
        strict: raise NotConverged instead of a warning NotConvergedWarning.
"""


# What a job does with its arguments: each completes the description, and returns the columns of its result.


def _solve(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    problem = problems.problem(added, {name: description.pop(name) for name in problems.DATA})
    description["problem"] = problem
    # "gradient at vertices" is a column Gradient, too.
    outputs = (name.partition(" ")[0].capitalize() for name in problem.get("outputs", []))
    return ["Solution", *dict.fromkeys(outputs)]


def _deform(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    description["handles"] = problems.handles(added, given["handles"])
    return ["Position"]


def _smooth(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    if given["column"] is None:
        return ["Position"]
    names = added.named(given["column"], "column", "Values")
    if len(names) != 1:
        raise InputError("column: one column is smoothed at a time.")
    description["column"] = names[0]
    return names


def _blend(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    if not isinstance(given["patch"], str):
        description["patch"] = added.add(given["patch"], "patch", components=(1,)).name
    return description["columns"]


def _distance(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    if given["sources"] is None and not given["wall"]:
        raise InputError("distance: give the sources, a region or numbers of vertices, or wall=True.")
    return ["Distance", *("Distance" + name.capitalize() for name in ("source", "group", "direction") if given[name])]


def _area(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> Callable[[], List[str]]:
    if given["tag"] is not None and not isinstance(given["tag"], str):
        description["tag"] = added.add(given["tag"], "tag", True, (1,)).name
    return lambda: ["Area" if added.mesh.n_corners == 3 else "Volume"]


def _simplify(added: Columns, given: Dict[str, Any], description: Dict[str, Any]) -> List[str]:
    if given["vertices"] is None and given["error"] is None:
        raise InputError("simplify: give the number of vertices, or the error, or both.")
    return ["Position"]


_RESULTS: Dict[str, Callable[[Columns, Dict[str, Any], Dict[str, Any]], Any]] = {
    "solve": _solve, "deform": _deform, "smooth": _smooth, "blend": _blend, "distance": _distance,
    "area": _area,
    "simplify": _simplify,
}  # fmt: skip


def _data() -> List[inspect.Parameter]:
    """The arguments of `solve` that are data of a problem file."""
    types = {
        "dirichlet": "types.Conditions", "robin": "types.Pairs", "soft": "types.Pairs", "field": "types.Value",
        "periodic": "types.Sides", "interface": "types.Conditions",
        "weights": "types.Weights", "columns": "int",
        "outputs": "Union[types.Output, Sequence[types.Output]]",
        "integrals": "Union[types.GroupName, Sequence[types.GroupName]]",
    }  # fmt: skip
    return [
        inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            default=None,
            annotation="Optional[%s]" % types.get(name, "types.Values"),
        )
        for name in problems.DATA
        if name != "problem"
    ]


_DATA = """\
        dirichlet: u at vertices: ``[smg.plane(z=0) >> 0, smg.tag("part", 3) >> 1]``, or a dict
            {vertex: value}. With ``smg.vertices(ids)`` a value may have a row for each of `ids`.
        source: f, a density: a value, or a list of values with regions; also an array with a row for
            each cell. Default 0.
        flux: (K grad u - q) . n on the boundary, positive into the body: like `dirichlet`.
        robin: (K grad u - q) . n = coefficient * (ambient - u) on the boundary:
            ``[region >> (coefficient, ambient)]``.
        soft: adds weight * (u - value), a density: ``[region >> (weight, value)]``; entries add up.
        conductivity: K in the cells: a positive number; a symmetric tensor (3, 3), or its diagonal
            (3,), or (6,): xx, yy, zz, xy, yz, xz; an array of these with a row for each cell; the name
            of a column; or a list with regions, as ``[25, smg.tag("Material", 2) >> 200]``. Default 1.
        screening: s, at least 0: a number, an array (n,) of the vertices or (m,) of the cells, the
            name of a column, or a list with regions. Default 0.
        field: q in the cells: an array (m, 3) or (m, 3 k), or the name of a column. Default 0.
        initial: where the iteration begins: like `source`, of the vertices; NaN counts as 0.
        periodic: sides that are one: ``[("left", "right"), ("front", "back", 1.0)]``, names of groups
            or regions; a third number is the jump of u from the first side to the second.
        interface: contacts between bodies that have a copy each of its facets:
            ``[smg.group("gap") >> coefficient]``: coefficient * (u - u on the other side) flows.
        weights: "cotangent" (default, finite elements), "clamped" or "uniform".
        outputs: "gradient", "flux", or both in a list: columns Gradient (grad u) and Flux (-K grad u)
            of the cells, beside the solution; "gradient at vertices": Gradient of the vertices, the mean
            of their cells weighted by area or volume.
        integrals: groups of cells, by names, numbers or patterns with ``*``, over which the report has
            integrals; "*" is the whole and all of them.
        columns: k, the number of right-hand sides, 1 to 64; default: what the values have.
"""

_RAISES = """
    Raises:
        InputError: an argument is wrong. MemoryLimitError: the mesh needs more; the sentence says how
        much. Error: the problem has no solution, a region no vertex, the disk is full.
    """

#: By the names that the library knows them by.
JOBS: Dict[str, Job] = {
    job.name: job
    for job in (
        Job(
            "solve",
            """Solves -div(K grad u - q) + s u = f by linear finite elements, as ``smg solve``.

    A value is a number (for all right-hand sides); a list of k numbers, one for each right-hand side (an array of these with `columns`);
    an array with a row for each vertex, (n,) or (n, k); the name of a column of the mesh; or
    "position". With a region it is written ``region >> value``; of several, in a list, later ones take
    precedence. Without any flux or Robin condition, the boundary is insulated. Arrays of the cells may
    have a row for each of the `Mesh.elements` instead, as of the hexahedra of a file.
""",
            "The solution: (n,), or (n, k) of k right-hand sides, float64; NaN at vertices of no cell.",
            own=_data(),
            documentation=_DATA,
            raises=_RAISES,
        ),
        Job(
            "deform",
            "Deforms the mesh: handles hold or move parts, the rest follows and keeps its details.\n",
            "The positions: (n, 3) float64. Components that no handle holds, and vertices of no cell, stay.",
            "handles",
        ),
        Job(
            "smooth",
            "Smooths a surface, or a column of the vertices of any mesh, by implicit fairing.\n",
            "The smoothed positions, (n, 3) float64, or the smoothed column, of its type.",
        ),
        Job(
            "blend",
            "Removes the steps of columns between patches and keeps the gradients inside these.\n",
            "The blended column, of its type; of several the first one, the others by their names.",
            "columns",
        ),
        Job(
            "distance",
            "The distance of all vertices from some of them, along a surface or through a solid.\n",
            "The distances: (n,) float64, in the unit of the mesh; infinite where no path leads. With further\n"
            "        columns or `to` the function on arrays returns all of them by their names, and \"paths\".",
            "sources",
        ),
        Job(
            "area",
            "The area of a surface, or the volume of a tetrahedral mesh: of vertices, by tags, and in all.\n",
            "The share of each vertex: (n,) float64. `report.areas` has the total and the sums by tags.",
        ),
        Job("simplify", "", "", "vertices"),
    )
}
#: Those whose result is a field.
OF_FIELDS = tuple(name for name in JOBS if name != "simplify")

#: The arguments of `solve` that say what the matrix is, and how it is treated.
OF_MATRIX = (
    "dirichlet", "robin", "soft", "conductivity", "screening", "weights", "problem", "columns", "sweeps",
    "memory", "threads",
)  # fmt: skip


def with_arguments_of(job: str, names: Optional[Sequence[str]] = None) -> Callable[[Callable], Callable]:
    """Gives a function the arguments of a job, or those of these `names`, between its own, and its docstring.

    A docstring of its own has the lines on the arguments at {arguments}.
    """
    described = JOBS[job].signature.parameters

    def give(function: Callable) -> Callable:
        own = inspect.signature(function)
        of_kind = {kind: [each for each in own.parameters.values() if each.kind is kind] for kind in _KINDS}
        between = list(described.values()) if names is None else [described[name] for name in names]
        function.__signature__ = own.replace(  # type: ignore[attr-defined]
            parameters=[*of_kind[_KINDS[0]], *between, *of_kind[_KINDS[1]]]
        )
        lines = JOBS[job].arguments
        function.__doc__ = JOBS[job].documentation if function.__doc__ is None else re.sub(
            r"( *) {8}\{arguments\}\n", lambda match: textwrap.indent(lines, str(match[1])), function.__doc__
        )  # fmt: skip
        return function

    return give


#: Of the arguments that a function has before those of a job, and of those that it has after them.
_KINDS = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
