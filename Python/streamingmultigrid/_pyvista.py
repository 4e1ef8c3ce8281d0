# SPDX-License-Identifier: BSD-3-Clause
"""What PyVista 0.48 and later finds by entry points: a reader of .vsm files, and an accessor.

::

    pyvista.read("scan.vsm").smg.smooth(size="8edges").plot()
"""

from __future__ import annotations

import functools
from typing import Any

import pyvista

from . import _jobs as jobs
from ._interop import from_pyvista
from ._mesh import Mesh
from ._opening import open as open_mesh


def read(path: Any, **options: Any) -> Any:
    """A mesh file of any format as a PyVista dataset, in memory; options as of `smg.open`."""
    with open_mesh(path, **options) as mesh:
        return mesh.to_pyvista()


@pyvista.register_dataset_accessor("smg", pyvista.DataSet)
class Accessor:
    """The jobs of Streaming Multigrid on a dataset of PyVista; they return a new dataset."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def mesh(self, **options: Any) -> Any:
        """The dataset as a mesh of Streaming Multigrid; see `smg.from_pyvista`."""
        return from_pyvista(self._dataset, **options)


def _method(job: str) -> Any:
    @functools.wraps(getattr(Mesh, job))
    def method(self: Accessor, *arguments: Any, **options: Any) -> Any:
        return getattr(self.mesh(), job)(*arguments, **options).to_pyvista()

    return method


for _job in jobs.JOBS:
    setattr(Accessor, _job, _method(_job))
