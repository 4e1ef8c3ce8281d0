# SPDX-License-Identifier: BSD-3-Clause
# Written by Testing/Python/make_stubs.py, of the signatures of the package.
from typing import Any, Callable, Dict, Iterable, Iterator, List, Literal, Mapping, Optional
from typing import Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _types as types
from . import progress as progress

__version__: str

class Block:
    n_points: int
    n_cells: int
    @property
    def points(self) -> npt.NDArray[Any]: ...
    @property
    def cells(self) -> npt.NDArray[Any]: ...
    @property
    def rows(self) -> npt.NDArray[Any]: ...
    @property
    def cell_rows(self) -> npt.NDArray[Any]: ...
    @property
    def ghost(self) -> npt.NDArray[Any]: ...
    def __getitem__(self, name: str) -> npt.NDArray[Any]: ...

class Handle: ...

class Mesh:
    name: str
    report: Optional[Report]
    def close(self) -> None: ...
    def __enter__(self) -> Mesh: ...
    def __exit__(self, *_: Any) -> None: ...
    def info(self, full: bool = False, progress: Optional[types.Progress] = None) -> Dict[str, Any]: ...
    @property
    def n_vertices(self) -> int: ...
    @property
    def n_points(self) -> int: ...
    @property
    def n_cells(self) -> int: ...
    @property
    def n_corners(self) -> int: ...
    @property
    def bounds(self) -> Tuple[float, ...]: ...
    @property
    def columns(self) -> Dict[str, Dict[str, Any]]: ...
    def keys(self) -> List[str]: ...
    def __contains__(self, name: Any) -> bool: ...
    @property
    def points(self) -> npt.NDArray[Any]: ...
    @property
    def cells(self) -> npt.NDArray[Any]: ...
    @property
    def elements(self) -> npt.NDArray[Any]: ...
    @property
    def n_elements(self) -> int: ...
    def read(
        self, name: str, cells: Optional[bool] = None, progress: Optional[types.Progress] = None
    ) -> npt.NDArray[Any]: ...
    def __getitem__(self, name: str) -> npt.NDArray[Any]: ...
    def __setitem__(self, name: str, values: npt.ArrayLike) -> None: ...
    def add(
        self, name: str, values: npt.ArrayLike, cells: Optional[bool] = None, *, copy: bool = True
    ) -> None: ...
    def blocks(
        self, max_points: int = 1000000, columns: Optional[Sequence[str]] = None
    ) -> Iterator[Block]: ...
    def save(
        self, path: types.Path, *, memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, text: bool = False, progress: Optional[types.Progress] = None
    ) -> None: ...
    def estimate(
        self, job: types.Job, *arguments: Any, path: Optional[types.Path] = None, **options: Any
    ) -> Estimate: ...
    def simplify(
        self, vertices: Optional[int] = None, *, error: Optional[float] = None,
        hold: Optional[types.Places] = None, path: Optional[types.Path] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, checkpoint: Optional[types.Path] = None,
        progress: Optional[types.Progress] = None
    ) -> Mesh: ...
    def select(self, region: types.Where, progress: Optional[types.Progress] = None) -> npt.NDArray[Any]: ...
    def solver(
        self, *, dirichlet: Optional[types.Conditions] = None, robin: Optional[types.Pairs] = None,
        soft: Optional[types.Pairs] = None, conductivity: Optional[types.Values] = None,
        screening: Optional[types.Values] = None, weights: Optional[types.Weights] = None,
        problem: Optional[types.Problem] = None, columns: Optional[int] = None, sweeps: Optional[int] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        progress: Optional[types.Progress] = None
    ) -> Solver: ...
    def to_pyvista(self) -> Any: ...
    def solve(
        self, *, dirichlet: Optional[types.Conditions] = None, source: Optional[types.Values] = None,
        flux: Optional[types.Values] = None, robin: Optional[types.Pairs] = None,
        soft: Optional[types.Pairs] = None, conductivity: Optional[types.Values] = None,
        screening: Optional[types.Values] = None, field: Optional[types.Value] = None,
        initial: Optional[types.Values] = None, weights: Optional[types.Weights] = None,
        outputs: Optional[Union[types.Output, Sequence[types.Output]]] = None, columns: Optional[int] = None,
        problem: Optional[types.Problem] = None, tolerance: Optional[Union[float, Literal["auto"]]] = None,
        acceleration: Optional[Literal["automatic", "none", "chebyshev", "cg"]] = None,
        max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        checkpoint: Optional[types.Path] = None, progress: Optional[types.Progress] = None,
        strict: bool = False
    ) -> Field: ...
    def deform(
        self, handles: types.Handles, *, weights: Optional[Literal["uniform", "cotangent", "clamped"]] = None,
        tolerance: Optional[float] = None, cycles: Optional[int] = None,
        normals: Optional[Literal["recompute", "drop"]] = None, max_cycles: Optional[int] = None,
        sweeps: Optional[int] = None, in_core: Optional[bool] = None, memory: Optional[types.Size] = None,
        threads: Optional[int] = None, scratch: Optional[types.Path] = None,
        scratch_limit: Optional[types.Size] = None, checkpoint: Optional[types.Path] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def smooth(
        self, *, size: Optional[Union[float, str]] = None, steps: Optional[int] = None,
        keep_edges: Optional[float] = None, keep_volume: Optional[bool] = None, orient: Optional[bool] = None,
        hold: Optional[types.Places] = None, boundary: Optional[Literal["smooth", "fixed", "free"]] = None,
        column: Optional[types.Columns] = None, normals: Optional[Literal["recompute", "drop"]] = None,
        tolerance: Optional[float] = None, max_cycles: Optional[int] = None, sweeps: Optional[int] = None,
        in_core: Optional[bool] = None, memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def blend(
        self, columns: types.Columns, *, patch: Union[str, npt.ArrayLike],
        hold: Optional[types.Places] = None, anchor: Optional[float] = None,
        seam: Optional[Literal["zero", "average"]] = None, tolerance: Optional[float] = None,
        max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def distance(
        self, sources: Optional[types.Places] = None, *, wall: Optional[bool] = None,
        source: Optional[bool] = None, group: Optional[bool] = None, direction: Optional[bool] = None,
        to: Optional[types.Places] = None, accuracy: Optional[Literal["auto", "exact", "approximate"]] = None,
        within: Optional[float] = None, max_passes: Optional[int] = None, memory: Optional[types.Size] = None,
        threads: Optional[int] = None, scratch: Optional[types.Path] = None,
        scratch_limit: Optional[types.Size] = None, progress: Optional[types.Progress] = None,
        strict: bool = False
    ) -> Field: ...
    def area(
        self, *, tag: Optional[Union[str, npt.ArrayLike]] = None, of: Optional[types.Places] = None,
        share: Optional[Literal["equal", "voronoi"]] = None, scale: Optional[float] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...

class Placed: ...

class Region:
    @property
    def has_center(self) -> bool: ...
    def __rshift__(self, value: Any) -> Placed: ...
    def __and__(self, other: Any) -> Region: ...
    def __or__(self, other: Any) -> Region: ...
    def __sub__(self, other: Any) -> Region: ...
    def __rand__(self, other: Any) -> Region: ...
    def __ror__(self, other: Any) -> Region: ...
    def __invert__(self) -> Region: ...
    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **_: Any) -> Any: ...

class ShortestPath:
    to: int
    source: int
    length: float
    points: npt.NDArray[Any]

class Solver:
    shape: Tuple[int, int]
    dtype: np.dtype
    report: Optional[Report]
    def solve(
        self, b: npt.ArrayLike, x0: Optional[npt.ArrayLike] = None, tol: float = 1e-08,
        max_cycles: Optional[int] = None, progress: Optional[types.Progress] = None, strict: bool = False
    ) -> npt.NDArray[Any]: ...
    def multiply(self, x: npt.ArrayLike) -> npt.NDArray[Any]: ...
    def precondition(self, r: npt.ArrayLike) -> npt.NDArray[Any]: ...
    def __matmul__(self, x: npt.ArrayLike) -> npt.NDArray[Any]: ...
    @property
    def A(self) -> Any: ...
    def aspreconditioner(self) -> Any: ...
    def close(self) -> None: ...
    def __enter__(self) -> Solver: ...
    def __exit__(self, *_: Any) -> None: ...

class Field(np.lib.mixins.NDArrayOperatorsMixin):
    mesh: Mesh
    names: Tuple[str, ...]
    @property
    def name(self) -> str: ...
    @property
    def shape(self) -> tuple: ...
    @property
    def ndim(self) -> int: ...
    @property
    def size(self) -> int: ...
    @property
    def dtype(self) -> np.dtype: ...
    def __len__(self) -> int: ...
    @property
    def n_vertices(self) -> int: ...
    @property
    def n_points(self) -> int: ...
    @property
    def n_cells(self) -> int: ...
    @property
    def columns(self) -> Dict[str, Dict[str, Any]]: ...
    def keys(self) -> List[str]: ...
    def __contains__(self, name: Any) -> bool: ...
    @property
    def report(self) -> Report: ...
    @property
    def paths(self) -> List[ShortestPath]: ...
    def to_numpy(self) -> npt.NDArray[Any]: ...
    def read(
        self, name: str, cells: Optional[bool] = None, progress: Optional[types.Progress] = None
    ) -> npt.NDArray[Any]: ...
    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> npt.NDArray[Any]: ...
    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any: ...
    def __getitem__(self, name: Any) -> Any: ...
    def as_mesh(self, progress: Optional[types.Progress] = None) -> Mesh: ...
    def blocks(
        self, max_points: int = 1000000, columns: Optional[Sequence[str]] = None
    ) -> Iterator[Block]: ...
    def save(
        self, path: types.Path, *, memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, text: bool = False, progress: Optional[types.Progress] = None
    ) -> Report: ...
    def to_pyvista(self) -> Any: ...
    def close(self) -> None: ...
    def __enter__(self) -> Field: ...
    def __exit__(self, *_: Any) -> None: ...
    def solve(
        self, *, dirichlet: Optional[types.Conditions] = None, source: Optional[types.Values] = None,
        flux: Optional[types.Values] = None, robin: Optional[types.Pairs] = None,
        soft: Optional[types.Pairs] = None, conductivity: Optional[types.Values] = None,
        screening: Optional[types.Values] = None, field: Optional[types.Value] = None,
        initial: Optional[types.Values] = None, weights: Optional[types.Weights] = None,
        outputs: Optional[Union[types.Output, Sequence[types.Output]]] = None, columns: Optional[int] = None,
        problem: Optional[types.Problem] = None, tolerance: Optional[Union[float, Literal["auto"]]] = None,
        acceleration: Optional[Literal["automatic", "none", "chebyshev", "cg"]] = None,
        max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        checkpoint: Optional[types.Path] = None, progress: Optional[types.Progress] = None,
        strict: bool = False
    ) -> Field: ...
    def deform(
        self, handles: types.Handles, *, weights: Optional[Literal["uniform", "cotangent", "clamped"]] = None,
        tolerance: Optional[float] = None, cycles: Optional[int] = None,
        normals: Optional[Literal["recompute", "drop"]] = None, max_cycles: Optional[int] = None,
        sweeps: Optional[int] = None, in_core: Optional[bool] = None, memory: Optional[types.Size] = None,
        threads: Optional[int] = None, scratch: Optional[types.Path] = None,
        scratch_limit: Optional[types.Size] = None, checkpoint: Optional[types.Path] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def smooth(
        self, *, size: Optional[Union[float, str]] = None, steps: Optional[int] = None,
        keep_edges: Optional[float] = None, keep_volume: Optional[bool] = None, orient: Optional[bool] = None,
        hold: Optional[types.Places] = None, boundary: Optional[Literal["smooth", "fixed", "free"]] = None,
        column: Optional[types.Columns] = None, normals: Optional[Literal["recompute", "drop"]] = None,
        tolerance: Optional[float] = None, max_cycles: Optional[int] = None, sweeps: Optional[int] = None,
        in_core: Optional[bool] = None, memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def blend(
        self, columns: types.Columns, *, patch: Union[str, npt.ArrayLike],
        hold: Optional[types.Places] = None, anchor: Optional[float] = None,
        seam: Optional[Literal["zero", "average"]] = None, tolerance: Optional[float] = None,
        max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def distance(
        self, sources: Optional[types.Places] = None, *, wall: Optional[bool] = None,
        source: Optional[bool] = None, group: Optional[bool] = None, direction: Optional[bool] = None,
        to: Optional[types.Places] = None, accuracy: Optional[Literal["auto", "exact", "approximate"]] = None,
        within: Optional[float] = None, max_passes: Optional[int] = None, memory: Optional[types.Size] = None,
        threads: Optional[int] = None, scratch: Optional[types.Path] = None,
        scratch_limit: Optional[types.Size] = None, progress: Optional[types.Progress] = None,
        strict: bool = False
    ) -> Field: ...
    def area(
        self, *, tag: Optional[Union[str, npt.ArrayLike]] = None, of: Optional[types.Places] = None,
        share: Optional[Literal["equal", "voronoi"]] = None, scale: Optional[float] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
        progress: Optional[types.Progress] = None, strict: bool = False
    ) -> Field: ...
    def simplify(
        self, vertices: Optional[int] = None, *, error: Optional[float] = None,
        hold: Optional[types.Places] = None, path: Optional[types.Path] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        scratch: Optional[types.Path] = None, checkpoint: Optional[types.Path] = None,
        progress: Optional[types.Progress] = None
    ) -> Mesh: ...
    def solver(
        self, *, dirichlet: Optional[types.Conditions] = None, robin: Optional[types.Pairs] = None,
        soft: Optional[types.Pairs] = None, conductivity: Optional[types.Values] = None,
        screening: Optional[types.Values] = None, weights: Optional[types.Weights] = None,
        problem: Optional[types.Problem] = None, columns: Optional[int] = None, sweeps: Optional[int] = None,
        memory: Optional[types.Size] = None, threads: Optional[int] = None,
        progress: Optional[types.Progress] = None
    ) -> Solver: ...
    def estimate(
        self, job: types.Job, *arguments: Any, path: Optional[types.Path] = None, **options: Any
    ) -> Estimate: ...
    def select(self, region: types.Where, progress: Optional[types.Progress] = None) -> npt.NDArray[Any]: ...

class Estimate(Dict[str, Any]):
    vertices: int
    cells: int
    counted: bool
    memory_bytes: int
    memory_limit: int
    scratch_bytes: int
    scratch_free: int
    output_bytes: int
    output_free: int
    passes: int
    cpu_seconds: float
    def to_dict(self) -> Dict[str, Any]: ...

class Report(Dict[str, Any]):
    vertices: int
    cells: int
    levels: List[Dict[str, Any]]
    passes: int
    resumed_passes: int
    cycles: int
    residuals: List[float]
    relative_to: str
    by_pass: List[Dict[str, Any]]
    stages: List[Dict[str, Any]]
    acceleration: str
    converged: bool
    steps: List[Dict[str, Any]]
    peak_nodes: int
    pool_bytes_peak: int
    rss_bytes_peak: int
    scratch_bytes_peak: int
    bytes_read: int
    bytes_written: int
    bytes_by_kind: List[Dict[str, Any]]
    seconds: Dict[str, float]
    cpu_seconds: float
    threads: int
    prescribed: int
    shared: int
    held: int
    degenerate_cells: int
    coincident_cells: int
    clamped_weights: int
    components: int
    free_components: int
    removed_source: List[float]
    errors: Dict[str, Any]
    conditions: List[Dict[str, Any]]
    energy: List[float]
    mean: List[float]
    minimum: List[Dict[str, Any]]
    parts: List[Dict[str, Any]]
    maximum: List[Dict[str, Any]]
    source: List[float]
    screening: List[float]
    balance: List[float]
    volume: Dict[str, Any]
    seams: List[Dict[str, Any]]
    clipped: int
    distance: Dict[str, Any]
    areas: Dict[str, Any]
    inverted: Dict[str, Any]
    vertices_before: int
    cells_before: int
    error: Optional[float]
    dropped_bodies: int
    merged_vertices: int
    resumed_vertices: int
    notes: List[str]
    warnings: List[str]
    def to_dict(self) -> Dict[str, Any]: ...

class Error(RuntimeError): ...

class NotConverged(Error):
    result: Any

class NotConvergedWarning(UserWarning): ...

class ReportWarning(UserWarning): ...

class InputError(Error, ValueError): ...

class MemoryLimitError(Error, MemoryError): ...

def above(x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None) -> Region: ...

def area(
    points: npt.ArrayLike, cells: npt.ArrayLike, *, tag: Optional[Union[str, npt.ArrayLike]] = None,
    of: Optional[types.Places] = None, share: Optional[Literal["equal", "voronoi"]] = None,
    scale: Optional[float] = None, memory: Optional[types.Size] = None, threads: Optional[int] = None,
    scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
    progress: Optional[types.Progress] = None, strict: bool = False
) -> Any: ...

def below(x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None) -> Region: ...

def blend(
    points: npt.ArrayLike, cells: npt.ArrayLike, columns: types.Columns, *, patch: Union[str, npt.ArrayLike],
    hold: Optional[types.Places] = None, anchor: Optional[float] = None,
    seam: Optional[Literal["zero", "average"]] = None, tolerance: Optional[float] = None,
    max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None, threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, progress: Optional[types.Progress] = None,
    strict: bool = False
) -> Any: ...

boundary: Region

def box(low: npt.ArrayLike, high: npt.ArrayLike) -> Region: ...

def deform(
    points: npt.ArrayLike, cells: npt.ArrayLike, handles: types.Handles, *,
    weights: Optional[Literal["uniform", "cotangent", "clamped"]] = None, tolerance: Optional[float] = None,
    cycles: Optional[int] = None, normals: Optional[Literal["recompute", "drop"]] = None,
    max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None, threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, checkpoint: Optional[types.Path] = None,
    progress: Optional[types.Progress] = None, strict: bool = False
) -> Any: ...

def dirichlet(region: types.Where, value: types.Value) -> Placed: ...

def distance(
    points: npt.ArrayLike, cells: npt.ArrayLike, sources: Optional[types.Places] = None, *,
    wall: Optional[bool] = None, source: Optional[bool] = None, group: Optional[bool] = None,
    direction: Optional[bool] = None, to: Optional[types.Places] = None,
    accuracy: Optional[Literal["auto", "exact", "approximate"]] = None, within: Optional[float] = None,
    max_passes: Optional[int] = None, memory: Optional[types.Size] = None, threads: Optional[int] = None,
    scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
    progress: Optional[types.Progress] = None, strict: bool = False
) -> Any: ...

everywhere: Region

def from_pyvista(dataset: Any, **options: Any) -> Mesh: ...

def halfspace(normal: npt.ArrayLike, offset: float) -> Region: ...

def handle(
    region: types.Where, *, fixed: bool = False, translate: Optional[Sequence[float]] = None,
    rotate: Union[Tuple[Sequence[float], float], Mapping[str, Any], None] = None,
    scale: Optional[float] = None, center: Optional[Sequence[float]] = None,
    target: Optional[types.Value] = None, rotation: Optional[types.Value] = None,
    log_scale: Optional[types.Value] = None
) -> Handle: ...

def mask(column_or_values: Union[str, npt.ArrayLike]) -> Region: ...

def mesh(
    points: npt.ArrayLike, cells: npt.ArrayLike, *, memory: Optional[types.Size] = None,
    threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, weld: Optional[float] = None, orient: Optional[bool] = None,
    order: Optional[types.Order] = None, progress: Optional[types.Progress] = None
) -> Mesh: ...

def nearest(points: npt.ArrayLike) -> Region: ...

def neumann(region: types.Where, value: types.Value) -> Placed: ...

def of_cells(values: npt.ArrayLike) -> npt.NDArray[Any]: ...

def of_vertices(values: npt.ArrayLike) -> npt.NDArray[Any]: ...

def open(
    path: types.Path, *, memory: Optional[types.Size] = None, threads: Optional[int] = None,
    scratch: Optional[types.Path] = None, scratch_limit: Optional[types.Size] = None,
    cells: Optional[types.Cells] = None, weld: Optional[float] = None, orient: Optional[bool] = None,
    time_step: Optional[int] = None, partition: Optional[int] = None, order: Optional[types.Order] = None,
    numbering: Optional[types.Numbering] = None, cache: Union[bool, types.Path, None] = None,
    progress: Optional[types.Progress] = None
) -> Mesh: ...

def plane(
    x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None,
    tolerance: Optional[float] = None
) -> Region: ...

def robin(region: types.Where, coefficient: types.Value, ambient: types.Value) -> Placed: ...

def simplify(
    points: npt.ArrayLike, cells: npt.ArrayLike, vertices: Optional[int] = None, *,
    error: Optional[float] = None, hold: Optional[types.Places] = None, memory: Optional[types.Size] = None,
    threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    progress: Optional[types.Progress] = None
) -> Tuple[npt.NDArray[Any], npt.NDArray[Any]]: ...

def smooth(
    points: npt.ArrayLike, cells: npt.ArrayLike, *, size: Optional[Union[float, str]] = None,
    steps: Optional[int] = None, keep_edges: Optional[float] = None, keep_volume: Optional[bool] = None,
    orient: Optional[bool] = None, hold: Optional[types.Places] = None,
    boundary: Optional[Literal["smooth", "fixed", "free"]] = None, column: Optional[types.Columns] = None,
    normals: Optional[Literal["recompute", "drop"]] = None, tolerance: Optional[float] = None,
    max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None, threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, progress: Optional[types.Progress] = None,
    strict: bool = False
) -> Any: ...

def soft(region: types.Where, weight: types.Value, value: types.Value) -> Placed: ...

def solve(
    points: npt.ArrayLike, cells: npt.ArrayLike, *, dirichlet: Optional[types.Conditions] = None,
    source: Optional[types.Values] = None, flux: Optional[types.Values] = None,
    robin: Optional[types.Pairs] = None, soft: Optional[types.Pairs] = None,
    conductivity: Optional[types.Values] = None, screening: Optional[types.Values] = None,
    field: Optional[types.Value] = None, initial: Optional[types.Values] = None,
    weights: Optional[types.Weights] = None,
    outputs: Optional[Union[types.Output, Sequence[types.Output]]] = None, columns: Optional[int] = None,
    problem: Optional[types.Problem] = None, tolerance: Optional[Union[float, Literal["auto"]]] = None,
    acceleration: Optional[Literal["automatic", "none", "chebyshev", "cg"]] = None,
    max_cycles: Optional[int] = None, sweeps: Optional[int] = None, in_core: Optional[bool] = None,
    memory: Optional[types.Size] = None, threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, checkpoint: Optional[types.Path] = None,
    progress: Optional[types.Progress] = None, strict: bool = False
) -> Any: ...

def solver(
    points: npt.ArrayLike, cells: npt.ArrayLike, *, dirichlet: Optional[types.Conditions] = None,
    robin: Optional[types.Pairs] = None, soft: Optional[types.Pairs] = None,
    conductivity: Optional[types.Values] = None, screening: Optional[types.Values] = None,
    weights: Optional[types.Weights] = None, problem: Optional[types.Problem] = None,
    columns: Optional[int] = None, sweeps: Optional[int] = None, memory: Optional[types.Size] = None,
    threads: Optional[int] = None, scratch: Optional[types.Path] = None,
    scratch_limit: Optional[types.Size] = None, progress: Optional[types.Progress] = None
) -> Solver: ...

def sphere(center: npt.ArrayLike, radius: float) -> Region: ...

def tag(column: str, value: Union[float, npt.ArrayLike]) -> Region: ...

def vertices(numbers_: Union[int, Iterable[int], npt.ArrayLike]) -> Region: ...

__all__ = [
    "solve",
    "deform",
    "smooth",
    "blend",
    "distance",
    "area",
    "Block",
    "Error",
    "Estimate",
    "Field",
    "Handle",
    "InputError",
    "MemoryLimitError",
    "Mesh",
    "NotConverged",
    "NotConvergedWarning",
    "Region",
    "Report",
    "ReportWarning",
    "ShortestPath",
    "Solver",
    "above",
    "below",
    "boundary",
    "box",
    "dirichlet",
    "everywhere",
    "from_pyvista",
    "halfspace",
    "handle",
    "mask",
    "mesh",
    "nearest",
    "neumann",
    "of_cells",
    "of_vertices",
    "plane",
    "robin",
    "simplify",
    "soft",
    "solver",
    "sphere",
    "tag",
    "vertices",
]
