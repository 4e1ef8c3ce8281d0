# SPDX-License-Identifier: BSD-3-Clause
"""Problems and handles: from words and arrays of Python to the JSON of problem and handle files."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _types as types
from ._arrays import numbers
from ._columns import Columns, said_of
from ._errors import InputError
from ._library import json_file
from ._regions import Placed, Region, as_region, everywhere, vertices

#: The arguments of `Mesh.solve` that are data of the problem.
DATA = (
    "dirichlet", "source", "flux", "robin", "soft", "conductivity", "screening", "field", "initial",
    "periodic", "interface", "weights", "outputs", "integrals", "columns", "problem",
)  # fmt: skip
#: More values of single vertices than this become a column.
_FEW = 64
_MOST_COLUMNS = 64

_Entry = Tuple[Region, Any]


def _entries(values: Any, what: str) -> List[_Entry]:
    """The places and values of one datum, later ones winning; a value alone holds everywhere."""
    if isinstance(values, Placed):
        placed = values.of_datum(what)
        return [(placed.region, placed.value)]
    if isinstance(values, Mapping):
        ids = list(values)
        if not all(isinstance(each, (int, np.integer)) for each in ids):
            raise InputError("%s: the keys of a dict are numbers of vertices." % what)
        return [(vertices(ids), list(values.values()))] if ids else []
    if isinstance(values, (list, tuple)) and any(
        isinstance(each, (Placed, Mapping)) for each in values
    ):
        return [entry for each in values for entry in _entries(each, what)]
    if isinstance(values, Region):
        raise InputError("%s: the region has no value: write region >> value." % what)
    if what == "dirichlet":
        raise InputError(
            "dirichlet: say where: region >> value, as smg.boundary >> 0 or smg.mask(array) >> values, "
            "or {vertex: value}; smg.everywhere >> values prescribes all."
        )
    return [(everywhere, values)]


class _Data:
    """Writes the values of a problem; all have the same number of components, `width`."""

    def __init__(self, columns: Columns, width: Optional[int]) -> None:
        self.columns = columns
        self.width = width

    def _ids(self, region: Region) -> Optional[np.ndarray]:
        return self.columns.mesh.merged().vertices(region._value) if region._kind == "vertices" else None

    def widths(self, region: Region, value: Any, what: str) -> Optional[int]:
        """The components that a value of the argument `what` has; None if it may have any."""
        if isinstance(value, str):
            return 3 if value == "position" else self.columns.components(value)
        array = numbers(value, what)
        if array.ndim == 0:
            return None
        if array.ndim == 2:
            return array.shape[1]
        ids = self._ids(region)
        # A list may be a number for each right-hand side: the cells are not read for that.
        is_list = isinstance(value, (list, tuple))
        if self.columns.has_rows(array, said_of(value), not is_list) or ids is not None and len(array) == len(ids):
            return 1  # a row for each vertex, cell, or vertex of the region
        # An array of another length is more likely a mistake than a number for each right-hand side.
        return len(array) if is_list and len(array) <= _MOST_COLUMNS else None

    def value(self, value: Any, what: str, cells: Optional[bool] = None) -> Any:
        """A value everywhere in a region: a number for each component, or the name of a column."""
        if isinstance(value, str):
            return value
        cells = self.columns.side(value, what, cells)
        array = numbers(value, what)
        self.columns.shape_as(array)
        width = self.width or 1
        if array.ndim == 0:
            return [array.item()] * width if width > 1 else array.item()
        rows = self.columns.has_rows(array, cells, not isinstance(value, (list, tuple)))
        if rows and array.shape == (width,) and width > 1:
            raise InputError(
                "%s: %d numbers may be one for each right-hand side, or one for each row: give an array "
                "(%d, %d)." % (what, width, width, width)
            )
        if array.shape == (width,) and not rows:
            return array.tolist()
        return self.columns.add(array, what, cells, (width,)).name

    def coefficient(self, value: Any, what: str, cells: Optional[bool] = None) -> Any:
        """A number, or the name of a column of one component."""
        if isinstance(value, str) or np.ndim(value) == 0:
            return value
        return self.columns.add(value, what, cells, (1,)).name

    def place(self, region: Region, what: str, write: Callable[..., Dict[str, Any]], *values: Any) -> list:
        """The entries of a region: one, or for values of single vertices one for each value."""
        ids = self._ids(region)
        apart = [self._per_vertex(ids, value, what) for value in values]
        if ids is None or not any(apart):
            return [{**region.where(self.columns), **write(*values)}]
        rows: List[Any] = [
            numbers(value, what) if own else [value] * len(ids) for own, value in zip(apart, values)
        ]
        groups: Dict[tuple, list] = {}
        keys: Dict[int, tuple] = {}
        for number, row in zip(ids.tolist(), zip(*rows)):
            key = tuple(item for value in row for item in np.ravel(value).tolist())
            if keys.setdefault(number, key) != key:
                raise InputError("%s: vertex %d has several values: give each vertex once." % (what, number))
            groups.setdefault(key, [row]).append(number)
        if len(groups) <= _FEW:
            return [{"vertices": numbers_, **write(*row)} for row, *numbers_ in groups.values()]
        return [
            {
                "vertices": ids.tolist(),
                **write(*(self._spread(ids, value) if own else value for own, value in zip(apart, values))),
            }
        ]

    def _per_vertex(self, ids: Optional[np.ndarray], value: Any, what: str) -> bool:
        if ids is None or isinstance(value, str) or np.ndim(value) == 0:
            return False
        array = numbers(value, what)
        return len(array) == len(ids) and (array.ndim == 2 or (self.width or 1) == 1)

    def _spread(self, ids: np.ndarray, values: Any) -> np.ndarray:
        rows = numbers(values, "value").astype(np.float64)
        spread = np.zeros((self.columns.mesh.n_vertices, *rows.shape[1:]))
        if ids.max() >= len(spread):
            raise InputError(
                "vertices: there is no vertex %d; the mesh has %d." % (ids.max(), len(spread))
            )
        spread[ids] = rows
        return spread


def _conductivity(value: Any, columns: Columns) -> Any:
    """A number, a tensor as the six numbers of the JSON, or the name of a column of the cells."""
    if isinstance(value, str) or np.ndim(value) == 0:
        return value
    columns.side(value, "conductivity", True)
    array = numbers(value, "conductivity")
    is_tensor = said_of(value) is None and array.shape in ((3,), (6,), (3, 3))
    if is_tensor and columns.has_rows(array, True):
        raise InputError(
            "conductivity: of a mesh of %d cells or elements, an array of the shape %s may be a tensor or a "
            "row for each cell: give the tensor as %s, or the rows as an array (%d, %d) or by smg.of_cells()."
            % (
                len(array),
                array.shape,
                "its six numbers" if array.shape[0] == 3 else "a matrix (3, 3)",
                len(array),
                6 if array.ndim == 2 else 1,
            )
        )
    if (array.ndim == 3 or is_tensor) and array.shape[-2:] == (3, 3):
        if not np.array_equal(array, np.swapaxes(array, -1, -2)):
            raise InputError("conductivity: a tensor must be symmetric.")
        array = array[..., (0, 1, 2, 0, 1, 0), (0, 1, 2, 1, 2, 2)]  # xx yy zz xy yz xz
    if is_tensor and array.shape == (3,):
        array = np.concatenate([array, np.zeros(3)])
    if is_tensor and array.shape == (6,):
        return array.tolist()
    return columns.add(array, "conductivity", True, (1, 3, 6)).name


def _several(entries: List[_Entry], write: Callable[[Any], Any], columns: Columns) -> Any:
    """A datum that is one value, or a list of values with their places."""
    if len(entries) == 1 and entries[0][0] is everywhere:
        return write(entries[0][1])
    return [{**region.where(columns), "value": write(value)} for region, value in entries]


def problem(columns: Columns, given: Mapping[str, Any]) -> Dict[str, Any]:
    """The JSON of a problem file, of the arguments of `Mesh.solve`; arrays are added to `columns`."""
    base = given.get("problem") or {}
    if not isinstance(base, Mapping):
        base = json_file(base, "problem")
    found = dict(base)
    placed = {
        name: _entries(given[name], name)
        for name in ("dirichlet", "flux", "source", "initial")
        if given.get(name) is not None
    }
    pairs = {
        "robin": _coefficients(given.get("robin"), "robin", "smg.boundary >> (coefficient, ambient)"),
        "soft": _coefficients(given.get("soft"), "soft", "region >> (weight, value)"),
    }
    asked = given.get("columns")
    data = _Data(columns, base.get("columns") if asked is None else asked)
    if data.width is None:
        found_widths = {
            data.widths(region, value, what)
            for what, entries in [
                *placed.items(), *((what, [(r, v) for r, _, v in each]) for what, each in pairs.items())
            ]
            for region, value in entries
        }
        widths = {width for width in found_widths if width is not None and width != 1}
        if len(widths) > 1:
            raise InputError(
                "The values have %s components: give `columns`, and values of as many or of one number."
                % " and ".join(map(str, sorted(widths)))
            )
        data.width = widths.pop() if widths else None
    if data.width is not None:
        found["columns"] = int(data.width)

    for name, cells in (("dirichlet", False), ("flux", False)):
        if name in placed:
            found[name] = [
                written
                for region, value in placed[name]
                for written in data.place(
                    region, name, lambda v: {"value": data.value(v, name, cells)}, value  # noqa: B023
                )
            ]
    for name, of in (("source", None), ("initial", False)):
        if name in placed:
            entries = placed[name]
            found[name] = _several(entries, lambda v: data.value(v, name, of), columns)  # noqa: B023
    for name, (first, second) in (("robin", ("coefficient", "ambient")), ("soft", ("weight", "value"))):
        if pairs[name]:
            found[name] = [
                written
                for region, coefficient, value in pairs[name]
                for written in data.place(
                    region,
                    name,
                    lambda c, v: {  # noqa: B023
                        first: data.coefficient(c, name, False),  # noqa: B023
                        second: data.value(v, name, False),  # noqa: B023
                    },
                    coefficient,
                    value,
                )
            ]
    if given.get("conductivity") is not None:
        found["conductivity"] = _several(
            _entries(given["conductivity"], "conductivity"), lambda v: _conductivity(v, columns), columns
        )
    if given.get("screening") is not None:
        found["screening"] = _several(
            _entries(given["screening"], "screening"),
            lambda v: data.coefficient(v, "screening"),
            columns,
        )
    field = given.get("field")
    if field is not None:
        width = 3 * (data.width or 1)
        found["field"] = (
            field if isinstance(field, str) else columns.add(field, "field", True, (3, width)).name
        )
    if given.get("periodic") is not None:
        found["periodic"] = _periodic(given["periodic"], columns)
    if given.get("interface") is not None:
        found["interface"] = [
            {**region.where(columns), "coefficient": value}
            for region, value in _entries(given["interface"], "interface")
        ]
    for name in ("weights", "outputs", "integrals"):
        if given.get(name) is not None:
            found[name] = [given[name]] if name == "outputs" and isinstance(given[name], str) else given[name]
    return found


def _periodic(values: Any, columns: Columns) -> list:
    """The pairs of sides, (from, to) or (from, to, jump), as in a problem file."""
    pairs = values if isinstance(values, list) else [values]
    found = []
    for pair in pairs:
        if not isinstance(pair, tuple) or len(pair) not in (2, 3):
            raise InputError(
                'periodic: %r is no pair of sides: write ("left", "right"), or with a jump '
                '("left", "right", 1.0); of several in a list.' % (pair,)
            )
        sides = [side if isinstance(side, str) else as_region(side).where(columns) for side in pair[:2]]
        jump = {"jump": np.asarray(pair[2]).tolist()} if len(pair) == 3 else {}
        found.append({"sides": sides, **jump})
    return found


def _coefficients(values: Any, what: str, form: str) -> list:
    """Of robin and soft: (region, coefficient, value) of each entry."""
    if values is None:
        return []
    entries = values if isinstance(values, list) else [values]
    found = []
    for entry in entries:
        placed = entry.of_datum(what) if isinstance(entry, Placed) else Placed(everywhere, entry)
        region, pair = placed.region, placed.value
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise InputError("%s: an entry is %s, or a list of these." % (what, form))
        found.append((region, *pair))
    return found


class Handle:
    """A part of a mesh that is held or moved; see `handle()`."""

    def __init__(self, region: Region, motion: Dict[str, Any]) -> None:
        self.region, self.motion = region, motion

    def __repr__(self) -> str:
        words = ["%s=%r" % item for item in self.motion.items()]
        return "smg.handle(%s)" % ", ".join([repr(self.region), *words])

    def description(self, columns: Columns) -> Dict[str, Any]:
        """The handle as in a handle file."""
        where = self.region.where(columns)
        if not where:  # a handle file has no word for all of the mesh
            where = {"mask": columns.add(np.ones(columns.mesh.n_vertices, bool), "mask", False, (1,)).name}
        written: Dict[str, Any] = {"region": where}
        for key, value in self.motion.items():
            if key in ("target", "rotation", "logScale") and not isinstance(value, str):
                value = self._of_vertices(value, key, columns)
            written[key] = value
        return written


    def _of_vertices(self, value: Any, key: str, columns: Columns) -> Any:
        """One value for all vertices of the handle, the column with one for each, or those for points."""
        array = numbers(value, key)
        if columns.has_rows(array, columns.side(value, key, False)):
            return columns.add(array, key, False, (1,) if key == "logScale" else (3,)).name
        if array.ndim > 1 and self.region._kind != "nearest":
            raise InputError(
                "handle: %s: the shape is %s; it must have a row for each of the %d vertices, or be one value."
                % ({"logScale": "log_scale"}.get(key, key), array.shape, columns.mesh.n_vertices)
            )
        return value


def handle(
    region: types.Where,
    *,
    fixed: bool = False,
    translate: Optional[Sequence[float]] = None,
    rotate: Union[Tuple[Sequence[float], float], Mapping[str, Any], None] = None,
    scale: Optional[float] = None,
    center: Optional[Sequence[float]] = None,
    target: Optional[types.Value] = None,
    rotation: Optional[types.Value] = None,
    log_scale: Optional[types.Value] = None,
) -> Handle:
    """A part of a mesh that a deformation holds or moves, for `Mesh.deform`.

    Args:
        region: a region; a mask or numbers of vertices.
        fixed: the part stays where it is.
        translate: 3 numbers, in the unit of the mesh.
        rotate: ``(axis, degrees)`` with an axis of 3 numbers; more than a turn is possible.
        scale: a factor, 1e-20 to 1e20.
        center: of rotation and scale, 3 numbers; by default that of a sphere or box.
        target: where each vertex goes: an array (n, 3) with a row for each vertex of the mesh, of
            which the rows in the region count, or the name of a column; 3 numbers; with
            ``smg.nearest(points)`` an array (k, 3) with a row for each point.
        rotation: with `target`, the rotation vector of each vertex, in radians: (n, 3), a name, or 3
            numbers; default 0.
        log_scale: with `target`, the natural logarithm of the scale: (n,), a name, or a number;
            default 0.

    Rotation and scale come first, about the same center, then the translation.
    """
    motion: Dict[str, Any] = {"fixed": True} if fixed else {}
    if rotate is not None:
        if isinstance(rotate, Mapping):
            motion["rotate"] = dict(rotate)
        else:
            try:
                axis, degrees = rotate
            except (TypeError, ValueError):
                raise InputError(
                    "handle: rotate: %r is not (axis, degrees), with an axis of 3 numbers." % (rotate,)
                ) from None
            motion["rotate"] = {"axis": axis, "degrees": degrees}
        if center is not None:
            motion["rotate"]["center"] = center
    words = {
        "translate": translate,
        "scale": scale,
        "center": center if rotate is None else None,
        "target": target,
        "rotation": rotation,
        "logScale": log_scale,
    }
    motion.update((key, value) for key, value in words.items() if value is not None)
    part = as_region(region)
    turned = motion.get("rotate", {"center": center} if scale is not None else None)
    if not part.has_center and turned is not None and turned.get("center") is None:
        raise InputError("handle: %r has no center to turn or scale about: give center=." % part)
    if not motion:
        raise InputError(
            "handle: say what it does: fixed=True, translate=, rotate=, scale= or target=."
        )
    return Handle(part, motion)


def handles(columns: Columns, given: Any) -> Dict[str, Any]:
    """The JSON of a handle file, of one handle, a list of handles, a dict or a path."""
    if isinstance(given, Handle):
        given = [given]
    if isinstance(given, (list, tuple)):
        if not all(isinstance(each, Handle) for each in given):
            raise InputError("handles: a list of smg.handle(...) is needed.")
        return {"handles": [each.description(columns) for each in given]}
    if isinstance(given, Mapping):
        return dict(given)
    return json_file(given, "handles")
