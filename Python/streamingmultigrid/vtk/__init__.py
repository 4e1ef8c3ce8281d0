# SPDX-License-Identifier: BSD-3-Clause
"""The VTK classes of Streaming Multigrid, for the Python that VTK was built for.

::

    from streamingmultigrid.vtk import vtkStreamingMeshReader, vtkStreamingPoisson
"""

from .vtkStreamingMultigridIO import *  # noqa: F401, F403
from .vtkStreamingMultigridFilters import *  # noqa: F401, F403
