# SPDX-License-Identifier: BSD-3-Clause
"""Where something holds on a mesh, and what: regions, and regions with a value.

``region >> value`` pairs a region with a value: ``smg.plane(z=0) >> 20.0``.
"""

from __future__ import annotations

import functools
from typing import Any, Dict, Iterable, List, NoReturn, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _types as types
from ._arrays import numbers, plain
from ._columns import Columns, said_of, saying
from ._errors import InputError

_FAR = 1e300  # beyond every coordinate
_AXES = "xyz"


class Region:
    """A part of the vertices of a mesh; made by the functions of this module.

    A cell or a boundary facet belongs to a region if all its corners do; regions by a column of the
    cells select cells, their vertices and their facets. Several regions are given as a list, or
    combined vertex by vertex: ``a | b``, ``a & b``, ``a - b``, ``~a``.
    """

    @property
    def has_center(self) -> bool:
        """Whether the region has a point of its own to turn or scale about."""
        return self._kind in ("box", "sphere")

    def __init__(self, kind: str, value: Any) -> None:
        self._kind, self._value = kind, value

    def __rshift__(self, value: Any) -> "Placed":
        return Placed(self, value)

    def __repr__(self) -> str:
        value = self._value
        parts = {
            "halfspace": lambda: [value[:3], value[3]],
            "box": lambda: [value[:3], value[3:]],
            "sphere": lambda: [value[:3], value[3]],
            "tag": lambda: value,
        }.get(self._kind, lambda: [value])()
        return "smg.%s(%s)" % (self._kind, ", ".join(map(repr, parts)))

    def __bool__(self) -> bool:
        raise TypeError("A region is neither true nor false: combine regions with &, | and ~, not with and, or and not.")

    def __and__(self, other: Any) -> "Region":
        return _Combined("&", self, as_region(other))

    def __or__(self, other: Any) -> "Region":
        return _Combined("|", self, as_region(other))

    def __sub__(self, other: Any) -> "Region":
        return _Combined("&", self, ~as_region(other))

    def __rand__(self, other: Any) -> "Region":
        return as_region(other) & self

    def __ror__(self, other: Any) -> "Region":
        return as_region(other) | self

    def __rsub__(self, other: Any) -> "Region":
        return as_region(other) - self

    def __invert__(self) -> "Region":
        return _Combined("~", self)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **_: Any) -> Any:
        if ufunc in (np.bitwise_and, np.bitwise_or, np.subtract):  # an array, a mask, on the left
            first, second = map(as_region, inputs)
            return {np.bitwise_and: first.__and__, np.bitwise_or: first.__or__}.get(ufunc, first.__sub__)(second)
        raise InputError("A region stands before the value: region >> value.")

    def where(self, context: Any) -> Dict[str, Any]:
        """WHERE of a problem file; `context` (columns.Columns) adds masks and knows the bounds."""
        if self._kind == "vertices":
            return {"vertices": context.mesh.merged().vertices(self._value)}
        return {self._kind: self._value}

    def selected(self, mesh: Any, progress: Any = None) -> Tuple[np.ndarray, bool]:
        """The mask of the region, (n,) bool, and whether it is that of the cells."""
        if self._kind == "tag":
            name, value = self._value
            return _read(mesh, name) == value, name not in mesh.columns["vertices"]
        return mesh.select_vertices(self.where(Columns(mesh)), progress), False


class Placed:
    """A region with its value: what ``region >> value`` makes, for any datum, and `dirichlet` and the like,
    of which `of` is the argument of `Mesh.solve`."""

    def __init__(self, region: Region, value: Any, of: Optional[str] = None) -> None:
        self.region, self.value, self.of = region, value, of

    def __repr__(self) -> str:
        return "%r >> %r" % (self.region, self.value)

    __array_ufunc__ = None  # an array on the left leaves these operators to this class

    def refuse(self, *_: Any) -> NoReturn:
        """Where a region is needed; the operators of one, too."""
        raise InputError(
            "%r has a value, where a region without one is needed. As >> comes before & and |, regions are "
            "combined in parentheses: (a & b) >> value. Several with their values are a list." % (self,)
        )

    __and__ = __or__ = __sub__ = __rand__ = __ror__ = __rsub__ = __rshift__ = refuse

    def of_datum(self, name: str) -> "Placed":
        """Itself. Raises InputError if it is of another datum."""
        if self.of not in (None, name):
            raise InputError("%s: %r is of another kind: it belongs to %s=." % (name, self, self.of))
        return self


class _Everywhere(Region):
    def __init__(self) -> None:
        super().__init__("everywhere", True)

    def __repr__(self) -> str:
        return "smg.everywhere"

    def where(self, context: Any) -> Dict[str, Any]:
        return {}

    def selected(self, mesh: Any, progress: Any = None) -> Tuple[np.ndarray, bool]:
        return np.ones(mesh.n_vertices, bool), False


class _Boundary(Region):
    def __init__(self) -> None:
        super().__init__("boundary", True)

    def __repr__(self) -> str:
        return "smg.boundary"


class _Plane(Region):
    def __init__(self, axis: int, at: float, tolerance: Optional[float]) -> None:
        super().__init__("plane", {_AXES[axis]: at})
        self._axis, self._at, self._tolerance = axis, at, tolerance

    def __repr__(self) -> str:
        return "smg.plane(%s=%r)" % (_AXES[self._axis], self._at)

    def where(self, context: Any) -> Dict[str, Any]:
        tolerance = 1e-6 * context.diagonal() if self._tolerance is None else self._tolerance
        box = [-_FAR] * 3 + [_FAR] * 3
        box[self._axis], box[self._axis + 3] = self._at - tolerance, self._at + tolerance
        return {"box": box}


class _Mask(Region):
    def __init__(self, values: Any) -> None:
        super().__init__("mask", values)

    def __repr__(self) -> str:
        if isinstance(self._value, str):
            return "smg.mask(%r)" % self._value
        return "smg.mask(<%d of %d>)" % (np.count_nonzero(self._value), len(self._value))

    def where(self, context: Any) -> Dict[str, Any]:
        if isinstance(self._value, str):
            return {"mask": self._value}
        return {"mask": context.add(self._value, "mask", components=(1,)).name}

    def selected(self, mesh: Any, progress: Any = None) -> Tuple[np.ndarray, bool]:
        if isinstance(self._value, str):
            values, of_cells = _read(mesh, self._value), self._value not in mesh.columns["vertices"]
        else:
            column = Columns(mesh).add(self._value, "mask", components=(1,))
            values, of_cells = column.values, column.cells
        if values.dtype.kind == "f" and np.isnan(values).any():
            raise InputError("mask: a value is NaN, which neither selects nor leaves out.")
        return values != 0, of_cells


def _read(mesh: Any, name: str) -> np.ndarray:
    """A column of one component."""
    values = mesh.read(name)
    if values.ndim != 1:
        raise InputError("%r: the column has %d components; one is needed." % (name, values.shape[1]))
    return values


class _Group(Region):
    def __init__(self, names: List[Union[str, int]]) -> None:
        super().__init__("group", names)

    def __repr__(self) -> str:
        return "smg.group(%s)" % ", ".join(map(repr, self._value))


class _Combined(Region):
    """Regions that are combined by |, & or ~, vertex by vertex: a mask, which is made when it is used.

    Of regions by columns of the cells alone it is a mask of the cells; with others, a cell counts by
    its vertices. With a group, whose facets no mask has, the job combines them as it reads the mesh:
    vertex by vertex, facet by facet, cell by cell.
    """

    def __init__(self, operation: str, *parts: Region) -> None:
        super().__init__("combined", parts)
        self._operation = operation

    def __repr__(self) -> str:
        if self._operation == "~":
            return "~%r" % self._value
        return "(%s)" % (" %s " % self._operation).join(map(repr, self._value))

    def _has_group(self) -> bool:
        return any(
            part._has_group() if isinstance(part, _Combined) else part._kind == "group"
            for part in self._value
        )

    def where(self, context: Any) -> Dict[str, Any]:
        if self._has_group():
            places = [part.where(context) for part in self._value]
            if not all(places):
                raise InputError("%r: smg.everywhere cannot be combined with groups." % self)
            return {"not": places[0]} if self._operation == "~" else {"any" if self._operation == "|" else "all": places}
        mask, of_cells = self.selected(context.mesh)
        if not mask.any():
            raise InputError("%r: nothing is in this region." % self)
        return {"mask": context.add(mask, "mask", of_cells, (1,)).name}

    def selected(self, mesh: Any, progress: Any = None) -> Tuple[np.ndarray, bool]:
        if self._has_group():
            return Region.selected(self, mesh, progress)
        (first, of_cells), *others = [part.selected(mesh, progress) for part in self._value]
        if self._operation == "~":
            return ~first, of_cells
        second, second_of_cells = others[0]
        if of_cells != second_of_cells:
            first = _vertices_of(mesh, first) if of_cells else first
            second = _vertices_of(mesh, second) if second_of_cells else second
        both = first | second if self._operation == "|" else first & second
        return both, of_cells and second_of_cells


def _vertices_of(mesh: Any, mask: np.ndarray) -> np.ndarray:
    """The vertices of the cells of a mask."""
    found = np.zeros(mesh.n_vertices, bool)
    found[mesh.cells[mask].reshape(-1)] = True
    return found


#: All of the mesh: ``conductivity=[smg.everywhere >> 25, ...]``; a value alone means the same.
everywhere: Region = _Everywhere()

#: The boundary: edges of exactly one triangle, faces of exactly one tetrahedron. An error if there is
#: none.
boundary: Region = _Boundary()


def _one_axis(coordinates: Dict[str, Optional[float]], name: str) -> tuple:
    given = [(axis, at) for axis, at in enumerate(coordinates.values()) if at is not None]
    if len(given) != 1:
        raise InputError("%s: give one of x, y and z, as in %s(z=0)." % (name, name))
    axis, at = given[0]
    return axis, float(at)


def _vector(values: Any, length: int, name: str) -> List[float]:
    array = numbers(values, name)
    if array.shape != (length,) or not np.isfinite(array).all():
        raise InputError("%s: %r are not %d finite numbers." % (name, values, length))
    return [float(value) for value in array]


def plane(
    x: Optional[float] = None,
    y: Optional[float] = None,
    z: Optional[float] = None,
    tolerance: Optional[float] = None,
) -> Region:
    """The vertices on the plane of one coordinate, as ``plane(z=0)``.

    Args:
        x, y, z: one of them, in the unit of the mesh.
        tolerance: the largest distance from the plane, in the unit of the mesh; by default 1e-6 of
            the diagonal of the bounds of the mesh, which is more than coordinates in single precision
            are rounded by.
    """
    axis, at = _one_axis({"x": x, "y": y, "z": z}, "plane")
    return _Plane(axis, at, tolerance)


def above(
    x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None
) -> Region:
    """The vertices whose coordinate is at least this, as ``above(z=1.5)``."""
    axis, at = _one_axis({"x": x, "y": y, "z": z}, "above")
    return halfspace([float(axis == each) for each in range(3)], at)


def below(
    x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None
) -> Region:
    """The vertices whose coordinate is at most this, as ``below(z=0.1)``."""
    axis, at = _one_axis({"x": x, "y": y, "z": z}, "below")
    return halfspace([-float(axis == each) for each in range(3)], -at)


def halfspace(normal: npt.ArrayLike, offset: float) -> Region:
    """The vertices p with ``normal . p >= offset``; `normal` has any length but 0."""
    return Region("halfspace", [*_vector(normal, 3, "halfspace"), float(offset)])


def box(low: npt.ArrayLike, high: npt.ArrayLike) -> Region:
    """The vertices between two corners (3 numbers each), both included."""
    return Region("box", [*_vector(low, 3, "box"), *_vector(high, 3, "box")])


def sphere(center: npt.ArrayLike, radius: float) -> Region:
    """The vertices at most `radius` from `center` (3 numbers)."""
    return Region("sphere", [*_vector(center, 3, "sphere"), float(radius)])


def vertices(numbers_: Union[int, Iterable[int], npt.ArrayLike]) -> Region:
    """Vertices by their numbers in the file or the rows of the arrays, from 0; an error for a simplified
    mesh, whose column OriginalId has other numbers.

    As a value, an array with a row for each of the numbers gives each its own:
    ``vertices([4, 7]) >> [1.0, 2.0]``.
    """
    given: Any = numbers_
    if not isinstance(given, np.ndarray):
        given = np.atleast_1d(np.asarray(given if np.isscalar(given) else list(given)))
    ids = numbers(given, "vertices")
    if ids.size and ids.dtype.kind not in "iu" or given.dtype == bool:
        raise InputError("vertices: numbers of vertices are integers; of a mask use smg.mask().")
    if ids.ndim != 1 or ids.size == 0 or ids.min() < 0:
        raise InputError("vertices: a list of numbers of at least 0 is needed, and not an empty one.")
    return Region("vertices", ids)


def nearest(points: npt.ArrayLike) -> Region:
    """The vertex nearest to a point, (3,), or to each of several points, (k, 3)."""
    array = np.atleast_2d(numbers(points, "nearest"))
    if array.ndim != 2 or array.shape[1] != 3 or not len(array):
        raise InputError("nearest: the shape is %s; it must be (3,) or (k, 3)." % (array.shape,))
    return Region("nearest", array.tolist())


def tag(column: str, value: Union[float, npt.ArrayLike]) -> Region:
    """Where a column of one component, of the vertices or cells, has the value, or one of several values,
    as ``tag("part", [3, 7])``."""
    values = numbers(value, "tag")
    if values.ndim > 1 or not values.size or values.dtype.kind not in "iuf" or np.isnan(values).any():
        raise InputError("tag: %r is neither a number nor a list of numbers." % (value,))
    regions = [Region("tag", [column, plain(each)]) for each in values.reshape(-1)]
    return functools.reduce(Region.__or__, regions)


def group(*names: Union[str, int]) -> Region:
    """What the mesher has named: the facets, vertices or cells of a group, as ``group("inlet")``.

    Args:
        names: names of groups, or their numbers; of several any counts, and ``*`` stands for any
            characters: ``group("wall*")``. `Mesh.groups` lists them.

    A value at vertices holds at the corners of the facets; fluxes act on exactly the facets,
    conductivities in exactly the cells. An unknown name is an Error that lists those there are.
    """
    if not names or not all(isinstance(name, (str, int, np.integer)) and name != "" for name in names):
        raise InputError("group: names of groups are needed, or their numbers, as in smg.group('inlet').")
    return _Group([name if isinstance(name, str) else int(name) for name in names])


def mask(column_or_values: Union[str, npt.ArrayLike]) -> Region:
    """Where a column is not 0, or an array with a row for each vertex, cell or element (`Mesh.elements`)."""
    if isinstance(column_or_values, str):
        return _Mask(column_or_values)
    values = numbers(column_or_values, "mask")
    if values.ndim != 1:
        raise InputError("mask: the shape is %s; it must be (n,)." % (values.shape,))
    return _Mask(saying(values, said_of(column_or_values)))


def as_region(value: Any) -> Region:
    """A region; of booleans the mask, of integers these vertices, of a dict WHERE of a problem file."""
    if isinstance(value, Region):
        return value
    if isinstance(value, Placed):
        value.refuse()
    if isinstance(value, dict) and len(value) == 1:
        return Region(*next(iter(value.items())))
    if isinstance(value, str):
        return mask(value)
    array = np.asarray(value)
    if not array.size:
        raise InputError("%r: numbers of vertices are needed, or a mask, and there are none." % (value,))
    if array.dtype.kind == "b":
        return mask(value)
    if array.dtype.kind in "iu":
        if array.size > 2 and array.max(initial=0) <= 1:  # a mask that a column has kept
            raise InputError(
                "An array of 0 and 1: smg.mask(array) if it is a mask, smg.vertices([0, 1]) if these "
                "are numbers of vertices."
            )
        return vertices(np.atleast_1d(array))
    if array.dtype.kind == "f":
        raise InputError(
            "%r: numbers of vertices are integers, and a mask has booleans: use smg.mask(array)." % (value,)
        )
    raise InputError(
        "%r is no region: use smg.sphere(), smg.mask() ..., a mask (an array of booleans), or "
        "numbers of vertices." % (value,)
    )


def as_regions(value: Any) -> List[Region]:
    """The regions of one, or of a list of them."""
    if isinstance(value, (list, tuple)) and not all(isinstance(each, (int, bool)) for each in value):
        return [as_region(each) for each in value]
    return [as_region(value)]


# Conditions by name, where `region >> value` would need a region of its own, as of a mask.


def dirichlet(region: types.Where, value: types.Value) -> Placed:
    """u = value at the vertices of a region, for ``solve(dirichlet=...)``; as ``region >> value``.

    Args:
        region: a region; a mask, or numbers of vertices.
        value: as of `Mesh.solve`; of numbers of vertices also a row for each.
    """
    return Placed(as_region(region), value, "dirichlet")


def neumann(region: types.Where, value: types.Value) -> Placed:
    """(K grad u - q) . n = value on the part of the boundary in a region, positive into the body, for
    ``solve(flux=...)``; as ``region >> value``. `region` and `value` are as of `dirichlet`."""
    return Placed(as_region(region), value, "flux")


def robin(region: types.Where, coefficient: types.Value, ambient: types.Value) -> Placed:
    """(K grad u - q) . n = coefficient * (ambient - u) on the part of the boundary in a region, for
    ``solve(robin=...)``; as ``region >> (coefficient, ambient)``. `region` is as of `dirichlet`."""
    return Placed(as_region(region), (coefficient, ambient), "robin")


def soft(region: types.Where, weight: types.Value, value: types.Value) -> Placed:
    """Adds weight * (u - value), a density, at the vertices of a region, for ``solve(soft=...)``; as
    ``region >> (weight, value)``. `region` is as of `dirichlet`."""
    return Placed(as_region(region), (weight, value), "soft")
