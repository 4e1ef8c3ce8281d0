# SPDX-License-Identifier: BSD-3-Clause
"""The jobs: their arguments in Python, and what the library is told of them.

The functions here describe; `Mesh` and the functions on arrays have their arguments and docstrings.
"""

from __future__ import annotations

import functools
import inspect
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _problem as problems
from . import _types as types
from ._columns import Columns
from ._errors import InputError
from ._regions import Region, as_regions
from ._regions import vertices as vertices_of

_Description = Tuple[Dict[str, Any], List[str]]  # for smg_run(), and the columns of the result


def _where(added: Columns, regions: Any) -> Any:
    if regions is None:
        return None
    return [each.where(added) or {"everywhere": True} for each in as_regions(regions)]


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


#: By the names that the library knows them by.
DESCRIPTIONS: Dict[str, Callable[..., _Description]] = {}
_BINDING: Dict[str, Callable[..., inspect.BoundArguments]] = {}
#: Arguments with which results are written, which no job has but `path` of `simplify`.
_OF_SAVING = ("path", "text")


def require_arguments(job: str, arguments: Sequence[Any], options: Mapping[str, Any]) -> None:
    """Raises TypeError for arguments that a job does not have, before a mesh is opened for it."""
    _BINDING[job](None, *arguments, **options)


def _job(function: Callable[..., _Description]) -> Callable[..., _Description]:
    """A job: the function gets its arguments by name as a dict `given`, too, which are the entries of the
    description unless it says otherwise."""
    signature = inspect.signature(function)
    own = list(signature.parameters.values())[1:]  # without `given`

    def bind(*arguments: Any, **options: Any) -> inspect.BoundArguments:
        try:
            return signature.bind({}, *arguments, **options)
        except TypeError as error:
            for_files = [name for name in options if name in _OF_SAVING and name not in signature.parameters]
            hint = "; it is one of save()" if for_files else ""
            raise TypeError("%s() %s%s" % (function.__name__, error, hint)) from None

    @functools.wraps(function)
    def describe(*arguments: Any, **options: Any) -> _Description:
        bound = bind(*arguments, **options)
        bound.apply_defaults()
        given = dict(bound.arguments)
        del given["given"], given["added"]
        bound.arguments["given"] = given
        return function(*bound.args, **bound.kwargs)

    _BINDING[function.__name__] = bind
    describe.__signature__ = signature.replace(parameters=own)  # type: ignore[attr-defined]
    DESCRIPTIONS[function.__name__] = describe
    return describe


@_job
def solve(
    given: Dict[str, Any],
    added: Columns,
    *,
    dirichlet: Optional[types.Conditions] = None,
    source: Optional[types.Values] = None,
    flux: Optional[types.Values] = None,
    robin: Optional[types.Pairs] = None,
    soft: Optional[types.Pairs] = None,
    conductivity: Optional[types.Values] = None,
    screening: Optional[types.Values] = None,
    field: Optional[types.Value] = None,
    initial: Optional[types.Values] = None,
    weights: Optional[types.Weights] = None,
    outputs: Union[types.Output, Sequence[types.Output], None] = None,
    columns: Optional[int] = None,
    problem: Optional[types.Problem] = None,
    tolerance: Union[float, Literal["auto"], None] = None,
    acceleration: Optional[types.Acceleration] = None,
    max_cycles: Optional[int] = None,
    sweeps: Optional[int] = None,
    in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
    checkpoint: Optional[types.Path] = None,
) -> _Description:
    """Solves -div(K grad u - q) + s u = f by linear finite elements, as ``smg solve``.

    A value is a number (for all right-hand sides); a list of k numbers, one for each right-hand side (an array of these with `columns`);
    an array with a row for each vertex, (n,) or (n, k); the name of a column of the mesh; or
    "position". With a region it is written ``region >> value``; of several, in a list, later ones take
    precedence. Without any flux or Robin condition, the boundary is insulated. Arrays of the cells may
    have a row for each of the `Mesh.elements` instead, as of the hexahedra of a file.

    Args:
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
        weights: "cotangent" (default, finite elements), "clamped" or "uniform".
        outputs: "gradient", "flux", or both in a list: columns Gradient (grad u) and Flux (-K grad u)
            of the cells, beside the solution.
        columns: k, the number of right-hand sides, 1 to 64; default: what the values have.
        problem: a problem file (docs/problem.md), or its dict, which the other arguments complete.
        tolerance: the relative residual to stop at, between 0 and 1, or "auto"; default 1e-8.
        acceleration: "automatic" (default), "none", "chebyshev" or "cg".
        max_cycles: the most V-cycles; default 50.
        sweeps: Gauss-Seidel sweeps before and after a coarse-grid correction, 1 to 20; default 2.
        in_core: keep everything in memory; the result is the same, bit for bit. Default False.
        memory: limit of the accounted memory: bytes, or a text as "2GB"; default that of the mesh, or
            1 GiB.
        threads: 0 (default): one for each core; the result does not depend on it.
        scratch: folder for scratch files; default that of the mesh, $TMPDIR, or /tmp.
        scratch_limit: the most bytes of scratch files at once, or a text.
        checkpoint: folder from which the same solve continues if it was killed.
        progress: a function of the part that is done, a bar of tqdm or rich, or True.
        strict: raise NotConverged instead of a warning NotConvergedWarning.

    Returns:
        The solution: (n,), or (n, k) of k right-hand sides, float64; NaN at vertices of no cell.

    Raises:
        InputError: an argument is wrong. MemoryLimitError: the mesh needs more; the sentence says how
        much. Error: the problem has no solution, a region no vertex, the disk is full.
    """
    described = problems.problem(added, {name: given.pop(name) for name in problems.DATA})
    names = ["Solution", *(name.capitalize() for name in described.get("outputs", []))]
    return {"problem": described, **given}, names


@_job
def deform(
    given: Dict[str, Any],
    added: Columns,
    handles: types.Handles,
    *,
    weights: Optional[types.Weights] = None,
    tolerance: Optional[float] = None,
    cycles: Optional[int] = None,
    normals: Optional[types.Normals] = None,
    max_cycles: Optional[int] = None,
    sweeps: Optional[int] = None,
    in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
    checkpoint: Optional[types.Path] = None,
) -> _Description:
    """Deforms the mesh: handles hold or move parts, the rest follows and keeps its details.

    Args:
        handles: a list of `smg.handle(...)`; the last one counts where several hold a vertex. Also a
            handle file (docs/deform.md) or its dict.
        weights: "clamped" (default), "cotangent" or "uniform".
        tolerance: the relative residual at which each of the two steps stops; default 1e-6.
        cycles: V-cycles of each step, instead of `tolerance`.
        normals: "recompute" (default) or "drop" a column Normals.
        max_cycles, sweeps, in_core, memory, threads, scratch, scratch_limit, checkpoint, progress,
        strict: as of `solve`; max_cycles of each step.

    Returns:
        The positions: (n, 3) float64. Components that no handle holds, and vertices of no cell, stay.
    """
    return {**given, "handles": problems.handles(added, handles)}, ["Position"]


@_job
def smooth(
    given: Dict[str, Any],
    added: Columns,
    *,
    size: Union[float, str, None] = None,
    steps: Optional[int] = None,
    hold: Optional[types.Places] = None,
    boundary: Optional[types.SmoothedBoundary] = None,
    keep_volume: Optional[bool] = None,
    keep_edges: Optional[float] = None,
    orient: Optional[bool] = None,
    column: Optional[types.Columns] = None,
    normals: Optional[types.Normals] = None,
    tolerance: Optional[float] = None,
    max_cycles: Optional[int] = None,
    sweeps: Optional[int] = None,
    in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
) -> _Description:
    """Smooths a surface, or a column of the vertices of any mesh, by implicit fairing.

    Args:
        size: waves of this length are halved: a number in the unit of the mesh, "6edges" (mean
            edges), or "1%" (of the diagonal of the bounds); default "4edges".
        steps: implicit steps, 1 to 1000; default 1.
        hold: what does not move: a region, a mask (booleans, (n,)), numbers of vertices, or a list.
        boundary: "smooth" (default of positions), "fixed", or "free" (default of a column).
        keep_volume: each step moves the surface so that it sweeps no volume; default True.
        keep_edges: degrees: edges at which the surface turns by more are kept.
        orient: in the mesh with the result, triangles are turned so that those of a body are wound
            alike, and outwards if it is closed. Some vertices may have other places in a file that
            is in stream order.
        column: smooths a column of the vertices instead of the positions: its name, an array (n,) or
            (n, k), which becomes the column Values, or {name: array}.
        normals: "recompute" (default) or "drop" a column Normals.
        tolerance, max_cycles (of each step), sweeps, in_core, memory, threads, scratch, scratch_limit,
        progress, strict: as of `solve`.

    Returns:
        The smoothed positions, (n, 3) float64, or the smoothed column, of its type.
    """
    names = ["Position"]
    if column is not None:
        names = added.named(column, "column", "Values")
        if len(names) != 1:
            raise InputError("column: one column is smoothed at a time.")
        given["column"] = names[0]
    return {**given, "hold": _where(added, hold)}, names


@_job
def blend(
    given: Dict[str, Any],
    added: Columns,
    columns: types.Columns,
    *,
    patch: Union[str, npt.ArrayLike],
    hold: Optional[types.Places] = None,
    anchor: Optional[float] = None,
    seam: Optional[types.Seam] = None,
    tolerance: Optional[float] = None,
    max_cycles: Optional[int] = None,
    sweeps: Optional[int] = None,
    in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
) -> _Description:
    """Removes the steps of columns between patches and keeps the gradients inside these.

    Args:
        columns: columns of the vertices: a name, a list of names, an array (n,) or (n, k), which
            becomes the column Values, or {name: array}.
        patch: the patch of each vertex or cell, any numbers: the name of a column, or an array (n,)
            or (m,).
        hold: what keeps its values: a region, a mask (booleans, (n,)), numbers of vertices, or a list.
        anchor: how strongly values are pulled towards the original ones, at least 0; default 0.01.
        seam: gradients between patches: "zero" (default), or "average" of those beside them.
        tolerance, max_cycles, sweeps, in_core, memory, threads, scratch, scratch_limit, progress,
        strict: as of `solve`.

    Returns:
        The blended column, of its type; of several the first one, the others by their names.
    """
    names = added.named(columns, "columns", "Values")
    if not isinstance(patch, str):
        given["patch"] = added.add(patch, "patch", components=(1,)).name
    return {**given, "columns": names, "hold": _where(added, hold)}, names


@_job
def distance(
    given: Dict[str, Any],
    added: Columns,
    sources: Optional[types.Places] = None,
    *,
    wall: Optional[bool] = None,
    source: Optional[bool] = None,
    group: Optional[bool] = None,
    direction: Optional[bool] = None,
    to: Optional[types.Places] = None,
    accuracy: Optional[types.Accuracy] = None,
    within: Optional[float] = None,
    max_passes: Optional[int] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None,
) -> _Description:
    """The distance of all vertices from some of them, along a surface or through a solid.

    Args:
        sources: where it is 0: a region, a mask (booleans, (n,)), numbers of vertices, or a list;
            needed without `wall`.
        wall: of tetrahedra, the distance in a straight line to the boundary, or to the part of it in
            `sources`. Default False.
        source: adds the column DistanceSource (int64), the number of the nearest source, -1: none.
        group: adds the column DistanceGroup (int32): in which of the listed `sources` the nearest one
            is, from 0; -1: none.
        direction: adds the column DistanceDirection (n, 3), the unit gradient.
        to: vertices whose shortest paths are wanted, as `sources`, at most 1,000; `paths` of the result
            has them. Of exact distances on a surface.
        accuracy: of paths on a surface: "exact", "approximate" (ten times as fast, too long on long
            thin triangles) or "auto", exact up to 1,000,000 vertices. Default "auto".
        within: of paths, a length in the unit of the mesh: vertices that are farther are not reached.
        max_passes: the most passes over the mesh; default 200.
        memory, threads, scratch, scratch_limit, progress, strict: as of `solve`.

    Returns:
        The distances: (n,) float64, in the unit of the mesh; infinite where no path leads. With further
        columns or `to` the function on arrays returns all of them by their names, and "paths".
    """
    del given["sources"]
    if sources is None and not wall:
        raise InputError("distance: give the sources, a region or numbers of vertices, or wall=True.")
    if within is not None and not within > 0:
        raise InputError("distance: within: %r is no length: it must be positive." % (within,))
    if wall and within is not None:
        raise InputError("distance: within: the largest distance is one of paths: leave it out with wall=True.")
    if to is not None and (wall or accuracy == "approximate"):
        raise InputError(
            "distance: to: shortest paths are those of exact distances on a surface: leave out %s."
            % ("wall=True" if wall else "accuracy='approximate'")
        )
    if wall and added.mesh.n_corners == 3:
        raise InputError("distance: wall: the distance to walls is that of tetrahedra; this mesh has triangles.")
    names = ["Distance"] + ["DistanceSource"] * bool(source) + ["DistanceGroup"] * bool(group)
    names += ["DistanceDirection"] * bool(direction)
    return {**given, "from": _where(added, sources), "to": _where(added, to)}, names


@_job
def simplify(
    given: Dict[str, Any],
    added: Columns,
    vertices: Optional[int] = None,
    *,
    error: Optional[float] = None,
    hold: Optional[types.Places] = None,
    memory: Optional[types.Size] = None,
    threads: Optional[int] = None,
    scratch: Optional[types.Path] = None,
    checkpoint: Optional[types.Path] = None,
) -> _Description:
    if vertices is None and error is None:
        raise InputError("simplify: give the number of vertices, or the error, or both.")
    held = None if hold is None else [_where_of_file(added, each) for each in as_regions(hold)]
    return {**given, "hold": held}, ["Position"]


#: The arguments of `solve` that say what the matrix is, and how it is treated.
OF_MATRIX = (
    "dirichlet", "robin", "soft", "conductivity", "screening", "weights", "problem", "columns", "sweeps",
    "memory", "threads",
)  # fmt: skip


def with_arguments_of(
    job: str, before: Sequence[str], names: Optional[Sequence[str]] = None
) -> Callable[[Callable], Callable]:
    """Gives a function that passes its arguments on the signature and docstring of a job.

    `before` are its own first arguments; `progress` and `strict` come last. With `names`, it takes these
    arguments and `progress` alone, and has its own docstring.
    """
    described = inspect.signature(DESCRIPTIONS[job]).parameters
    parameter = inspect.Parameter

    def give(function: Callable) -> Callable:
        first = [parameter(name, parameter.POSITIONAL_OR_KEYWORD) for name in before]
        last = [
            parameter("progress", parameter.KEYWORD_ONLY, default=None, annotation="Optional[types.Progress]"),
            parameter("strict", parameter.KEYWORD_ONLY, default=False, annotation="bool"),
        ]
        between = list(described.values())[1:]
        if names is None:
            function.__doc__ = DESCRIPTIONS[job].__doc__
        else:
            between, last = [described[name] for name in names], last[:1]
        own = inspect.signature(function)
        function.__signature__ = own.replace(  # type: ignore[attr-defined]
            parameters=[*first, *between, *last]
        )
        return function

    return give
