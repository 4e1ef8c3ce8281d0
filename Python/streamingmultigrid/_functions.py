# SPDX-License-Identifier: BSD-3-Clause
"""The jobs on arrays: NumPy in, NumPy out."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _jobs as jobs
from . import _types as types
from ._mesh import Mesh
from ._opening import mesh
from ._solver import Solver

_OPENING = ("memory", "threads", "scratch", "scratch_limit")


def _opened(points: Any, cells: Any, options: Dict[str, Any]) -> Mesh:
    return mesh(points, cells, **{key: options[key] for key in _OPENING if key in options})


def _read(field: Any) -> Any:
    """The values; of several columns all, by their names. What the whole report warns of becomes
    warnings of Python here, since nobody will ask for it."""
    _ = field.report
    if len(field.names) == 1:
        return field.to_numpy()
    return {field.name: field.to_numpy(), **{name: field.read(name) for name in field.names[1:]}}


def _on_arrays(job: str) -> Any:
    """The function that does a job whose result is a field on the mesh of two arrays."""

    @jobs.with_arguments_of(job)
    def function(
        points: npt.ArrayLike,
        cells: npt.ArrayLike,
        *arguments: Any,
        progress: Optional[types.Progress] = None,
        strict: bool = False,
        **options: Any,
    ) -> Any:
        with _opened(points, cells, options) as opened:
            field = getattr(opened, job)(*arguments, progress=progress, strict=strict, **options)
            if options.get("to") is None:
                return _read(field)
            _ = field.report
            return {**{name: field.read(name) for name in field.names}, "paths": field.paths}

    first, rest = (function.__doc__ or "").split("\n", 1)
    function.__doc__ = first + "\n" + _ARRAYS + rest
    function.__name__ = function.__qualname__ = job
    return function


_ARRAYS = """
    The arrays `points`, (n, 3) numbers, or (n, 2) with z = 0, and `cells`, (m, 3) or (m, 4) integers,
    are the mesh. The result is an array; of several columns a dict of arrays by their names. What the
    report warns of is a ReportWarning; for the report itself, use ``smg.mesh(points, cells)`` and its
    method of this name.
"""

#: By the names of the jobs.
ON_ARRAYS: Dict[str, Any] = {job: _on_arrays(job) for job in jobs.OF_FIELDS}


@jobs.with_arguments_of("simplify")
def simplify(
    points: npt.ArrayLike,
    cells: npt.ArrayLike,
    *arguments: Any,
    progress: Optional[types.Progress] = None,
    **options: Any,
) -> Tuple[np.ndarray, np.ndarray]:
    """A surface with fewer vertices, each of which is one of the surface.

    Args:
        points, cells: (n, 3) or (n, 2) numbers and (m, 3) integers.
        {arguments}
        progress: as of `smg.solve`.

    Returns:
        Its points, (k, 3) float64, and triangles, (l, 3) int64.
    """
    with _opened(points, cells, options) as opened:
        with opened.simplify(*arguments, progress=progress, **options) as small:
            return small.points, small.cells


@jobs.with_arguments_of("solve", (*jobs.OF_MATRIX, "scratch", "scratch_limit"))
def solver(
    points: npt.ArrayLike,
    cells: npt.ArrayLike,
    *,
    on_disk: bool = False,
    progress: Optional[types.Progress] = None,
    **options: Any,
) -> Solver:
    """The equations of a problem on arrays, with their hierarchy, for many right-hand sides.

    Args:
        points, cells: (n, 3) or (n, 2) numbers, and (m, 3) or (m, 4) integers.
        options: the arguments of `smg.solve` that say what the matrix is (`conductivity`, `screening`,
            `dirichlet`, `robin`, `soft`, `weights`), and `sweeps`, `memory`, `threads`. Without a
            Dirichlet condition, screening, soft constraint or Robin condition, A is singular.
        on_disk: keep the hierarchy on scratch files, within the limit `memory`.

    ::

        s = smg.solver(V, F, dirichlet=smg.boundary >> 0)
        x = s.solve(b, tol=1e-10)
        x, info = scipy.sparse.linalg.cg(s.A, b, x0=s.precondition(b), M=s.aspreconditioner())
    """
    with _opened(points, cells, options) as opened:
        of_mesh = ("scratch", "scratch_limit")
        return opened.solver(
            on_disk=on_disk, progress=progress, **{k: v for k, v in options.items() if k not in of_mesh}
        )
