# SPDX-License-Identifier: BSD-3-Clause
"""The types of arguments, for type checkers and editors."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Literal, Mapping, Sequence, Tuple, Union

import numpy.typing as npt

if TYPE_CHECKING:
    from . import Handle, Placed, Region

Path = Union[str, "os.PathLike[str]"]
Size = Union[int, float, str]  # of memory: bytes, or a text with a unit
Progress = Union[bool, Callable[[float], Any], Any]  # a bar of tqdm or rich, too: see progress.py

# Where: a region; a mask; numbers of vertices; the name of a column; WHERE of a problem file.
Where = Union["Region", npt.ArrayLike, Dict[str, Any]]
Places = Union[Where, Sequence[Any]]
# What: numbers, an array, a column or "position"; with a region, or a list of these.
Value = Union[npt.ArrayLike, str]
Values = Union[Value, "Placed", Sequence[Any]]
Conditions = Union["Placed", Mapping[int, Any], Sequence[Union["Placed", Mapping[int, Any]]]]
#: A pair of periodic sides, with a jump, or several.
Sides = Union[Tuple[Any, ...], List[Tuple[Any, ...]]]
Pairs = Union["Placed", Tuple[Any, Any], List[Union["Placed", Tuple[Any, Any]]]]  # robin, soft
Columns = Union[str, Sequence[str], npt.ArrayLike, Mapping[str, npt.ArrayLike]]
Handles = Union["Handle", Sequence["Handle"], Path, Mapping[str, Any]]
Problem = Union[Path, Mapping[str, Any]]

Weights = Literal["cotangent", "clamped", "uniform"]
Output = Literal["gradient", "flux", "gradient at vertices"]
GroupName = Union[str, int]
Order = Literal["bfs", "spectral", "axis", "keep"]
Numbering = Literal["columns", "rows"]
Cells = Literal["triangles", "tets"]
Job = str  # in the stub of the package one of the names
