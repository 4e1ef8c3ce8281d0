# SPDX-License-Identifier: BSD-3-Clause
"""Equations with their hierarchy, kept in memory for many right-hand sides."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_void_p
from typing import Any, Dict, Iterator, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _jobs as jobs
from . import _types as types
from ._arrays import counted, numbers, table, vector
from ._columns import Columns
from ._errors import InputError, NotConverged, ReportWarning, warn
from ._library import NativeHandle, call, call_reporting, json_text, parse
from ._regions import Placed
from .progress import reporting
from ._report import Report, not_converged, warn_of


def _with_unused_values(options: Mapping[str, Any]) -> Iterator[str]:
    """The conditions that have values other than 0, of which a solver needs the places alone."""
    for name in ("dirichlet", "robin", "soft"):
        given = options.get(name)
        entries = given if isinstance(given, (list, tuple)) else [given]
        values = [each.value if name == "dirichlet" else each.value[-1] for each in entries if isinstance(each, Placed)]
        values += list(given.values()) if isinstance(given, Mapping) else []
        if any(isinstance(value, str) or np.any(np.asarray(value)) for value in values):
            yield name


class Solver:
    """A x = b for many b: made by `smg.solver` or `Mesh.solver`.

    A, (n, n), is the stiffness of the mesh with screening, soft constraints and Robin terms of the
    problem; its rows at vertices with a Dirichlet condition, and of no cell, are those of the identity:
    b has the prescribed values there. Rows are vertices in the order of the file or of the arrays.

    A solver may be used by one thread at a time; calls of others wait.
    """

    shape: Tuple[int, int]  #: (n, n)
    dtype: np.dtype
    report: Optional[Report]  #: of the last `solve`; None before the first

    def __init__(self, mesh: Any, progress: Any, options: Mapping[str, Any]) -> None:
        own = {
            name: options[name]
            for name in ("memory", "threads", "sweeps", "on_disk")
            if options.get(name) is not None
        }
        for name in ("source", "flux", "field", "initial"):
            if options.get(name) is not None:
                raise InputError(
                    "solver: %s is part of the right-hand side, which solve() gets: leave it out." % name
                )
        for name in _with_unused_values(options):
            warn(
                "solver: the values of %s are part of the right-hand side, which solve() gets: those that "
                "are given here are not used." % name,
                ReportWarning,
            )
        columns = Columns(mesh)
        problem, _ = jobs.JOBS["solve"](columns, **{k: v for k, v in options.items() if k not in own})
        used = {key: value for key, value in problem.items() if value is not None}
        unknown = set(used) - {"problem"}
        if unknown:
            raise InputError(
                "solver: %s is no argument of it, but perhaps of its solve()." % sorted(unknown)[0]
            )
        description = {**mesh.defaults("memory", "threads"), **own, **used}
        self._handle = NativeHandle("solver", *(column.values for column in columns.added))
        with reporting(progress, "solver") as report, mesh.with_columns(columns) as pointer:
            call_reporting(
                "smg_open_solver",
                (pointer, json_text(description)),
                report,
                byref(self._handle.pointer),
            )
        n = mesh.n_vertices
        self.shape = (n, n)
        self.dtype = np.dtype(np.float64)
        self.report = None

    def solve(
        self,
        b: npt.ArrayLike,
        x0: Optional[npt.ArrayLike] = None,
        tol: float = 1e-8,
        max_cycles: Optional[int] = None,
        progress: Optional[types.Progress] = None,
        strict: bool = False,
        out: Optional[np.ndarray] = None,
    ) -> np.ndarray:
        """Solves A x = b.

        Args:
            b: (n,), or (n, k) of k right-hand sides, numbers of any type.
            x0: initial values, of the shape of b; default 0.
            tol: the relative residual to stop at, ||b - A x|| / ||b - A x0||, between 0 and 1.
            max_cycles: the most V-cycles of each right-hand side; default 50. `report.cycles` counts those
                of all together.
            progress: a function of the part that is done, a bar of tqdm or rich, or True.
            strict: raise NotConverged instead of a warning NotConvergedWarning.
            out: an array for x, C-contiguous float64 of the shape of b, as a `numpy.memmap`; default a new
                one. With a hierarchy on disk, b and out may be larger than the memory.

        Returns:
            x, of the shape of b, float64; `out` if that is given.
        """
        right = vector(b, "b", self.shape[0])
        if not right.size:
            raise InputError("b: the shape is %s: there is no right-hand side." % (right.shape,))
        x = np.zeros(right.shape) if out is None else out
        fits = isinstance(x, np.ndarray) and x.flags.c_contiguous and x.flags.writeable
        if not fits or x.shape != right.shape or x.dtype != np.float64:
            raise InputError(
                "out: must be a C-contiguous array of float64 of the shape of b, %s." % (right.shape,)
            )
        if np.may_share_memory(x, right):
            raise InputError("out: shares memory with b.")
        start = np.zeros(()) if x0 is None else numbers(x0, "x0")
        if x0 is not None and start.shape != right.shape:
            raise InputError("x0: the shape is %s; that of b is %s." % (start.shape, right.shape))
        if x is not start:
            x[...] = start
        options: Dict[str, Any] = {"tolerance": tol, "max_cycles": max_cycles}
        result = c_char_p()
        with reporting(progress, "solve") as report, self._handle as solver:
            call_reporting(
                "smg_solver_solve",
                (solver, byref(table(right)), x.ctypes.data_as(c_void_p), json_text(options)),
                report,
                byref(result),
            )
            self.report = Report(parse(result))
        if strict and not self.report.get("converged", True):
            raise NotConverged(not_converged(self.report), x)
        warn_of(self.report, set())
        return x

    def multiply(self, x: npt.ArrayLike) -> np.ndarray:
        """A x, of the shape of x: (n,) or (n, k)."""
        return self._apply("smg_solver_multiply", x, "x")

    def precondition(self, r: npt.ArrayLike) -> np.ndarray:
        """M r: one V-cycle, a symmetric positive definite approximation of the inverse of A.

        r and the result: (n,) or (n, k); each column has a V-cycle.
        """
        return self._apply("smg_solver_precondition", r, "r")

    def _apply(self, function: str, values: Any, name: str) -> np.ndarray:
        given = np.asarray(vector(values, name, self.shape[0]), np.float64)
        columns = np.ascontiguousarray(given.reshape(len(given), -1).T)
        found = np.empty_like(columns)
        with self._handle as solver:
            for column, result in zip(columns, found):
                call(
                    function,
                    solver,
                    column.ctypes.data_as(c_void_p),
                    result.ctypes.data_as(c_void_p),
                )
        return np.ascontiguousarray(found.T).reshape(given.shape)

    def __matmul__(self, x: npt.ArrayLike) -> np.ndarray:
        return self.multiply(x)

    @property
    def A(self) -> Any:  # noqa: N802, the letter of the equations
        """A as a scipy.sparse.linalg.LinearOperator.

        It is symmetric on vectors that are 0 at vertices with a Dirichlet condition: begin conjugate
        gradients with a vector that has the prescribed values, for instance ``precondition(b)``.
        """
        return self._operator(self.multiply)

    def aspreconditioner(self) -> Any:
        """M as a scipy.sparse.linalg.LinearOperator, which is symmetric:
        ``cg(s.A, b, x0=s.precondition(b), M=s.aspreconditioner())``.
        """
        return self._operator(self.precondition, rmatvec=lambda r: self.precondition(np.reshape(r, -1)))

    def _operator(self, function: Any, **transposed: Any) -> Any:
        from scipy.sparse.linalg import LinearOperator

        return LinearOperator(
            self.shape,
            matvec=lambda x: function(np.reshape(x, -1)),
            matmat=function,
            dtype=self.dtype,
            **transposed,
        )

    def close(self) -> None:
        """Frees the memory; also done when nothing refers to the solver any more."""
        self._handle.close()

    def __enter__(self) -> "Solver":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<Solver of %s>" % counted(self.shape[0], "vertex", "vertices")
