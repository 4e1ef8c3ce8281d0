# SPDX-License-Identifier: BSD-3-Clause
"""Streaming Multigrid: elliptic problems on meshes too large for memory, with NumPy.

::

    import streamingmultigrid as smg

    mesh = smg.open("scan.ply", memory="1GB")         # any format; read when it is needed
    print(mesh)
    print(mesh.estimate("smooth", size="8edges"))     # memory, time, before anything starts
    u = mesh.solve(dirichlet=[smg.plane(z=0) >> 0, smg.tag("part", 3) >> 1], source=2.0)
    u.report                                          # convergence, memory, conditions
    u.to_numpy()                                      # (n,), in the order of the file
    for block in u.blocks(max_points=1_000_000):      # or part by part
        block.points, block.cells, block["Solution"]
    u.save("out.vtu")

    u = smg.solve(V, F, dirichlet={0: 0.0, 99: 1.0})  # arrays in, an array out
    mesh.smooth(size="8edges", hold=mask).save("clean.ply")

Meshes: `open`, `mesh`, `from_pyvista`, which make a `Mesh` with the jobs `solve`, `deform`, `smooth`,
`blend`, `distance`, `simplify` and `solver`; on arrays the functions of these names. Regions: `plane`,
`above`, `below`, `halfspace`, `box`, `sphere`, `vertices`, `nearest`, `tag`, `mask`, `group`,
`boundary`, `everywhere`, combined by ``|``, ``&`` and ``~``; ``region >> value`` pairs one with a value, and so do `dirichlet`, `neumann`, `robin`
and `soft`. `of_vertices` and `of_cells` say what an array has rows for. Errors: `Error` and its subclasses. `progress` says how calls report how far they are.
"""

from ._columns import of_cells, of_vertices
from ._errors import (
    Error,
    InputError,
    MemoryLimitError,
    NotConverged,
    NotConvergedWarning,
    ReportWarning,
)
from ._field import Block, Field
from ._functions import ON_ARRAYS, simplify, solver
from ._interop import from_pyvista
from ._mesh import Mesh
from ._opening import mesh, open
from ._problem import Handle, handle
from ._regions import (
    Placed,  # noqa: F401, of types
    Region,
    above,
    below,
    boundary,
    box,
    dirichlet,
    everywhere,
    group,
    halfspace,
    mask,
    nearest,
    neumann,
    plane,
    robin,
    soft,
    sphere,
    tag,
    vertices,
)
from ._report import Estimate, Report, ShortestPath
from ._solver import Solver

globals().update(ON_ARRAYS)
__all__ = [  # not `open`: import * would replace that of Python
    *ON_ARRAYS,
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
    "group",
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

for _name in (*__all__, "open"):  # by which they are known, whatever the file
    if callable(globals()[_name]):
        globals()[_name].__module__ = __name__
del _name


def __getattr__(name: str) -> str:
    if name == "__version__":  # that of the library, which is loaded at its first use
        from ._library import version

        return version()
    raise AttributeError("module %r has no attribute %r" % (__name__, name))
