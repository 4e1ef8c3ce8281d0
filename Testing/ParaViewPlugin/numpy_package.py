# SPDX-License-Identifier: BSD-3-Clause
"""numpy_package.py PLUGIN : in pvpython, the NumPy package beside the plugin and the wrapped classes,
on the same libraries, each loaded once; both have the same solution, bit for bit."""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

LoadPlugin(sys.argv[1], ns=globals())
import streamingmultigrid as smg
from streamingmultigrid.vtk import vtkStreamingPoisson

bunny = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "bunny.smb")
u = smg.open(bunny).solve(dirichlet=[smg.below(y=0.05) >> 0, smg.above(y=0.18) >> 1])

poisson = StreamingPoisson(Input=StreamingMeshReader(FileName=bunny))
poisson.Problem = (
    '{"dirichlet": [{"halfspace": [0, -1, 0, -0.05], "value": 0},'
    ' {"halfspace": [0, 1, 0, 0.18], "value": 1}]}')
data = servermanager.Fetch(poisson).GetPointData()
solution = vtk_to_numpy(data.GetArray("Solution"))
original = data.GetArray("OriginalId")
ids = vtk_to_numpy(original) if original else np.arange(len(solution))
assert np.array_equal(u.to_numpy()[ids], solution)
assert isinstance(poisson.SMProxy.GetClientSideObject(), vtkStreamingPoisson)

loaded = {}
with open("/proc/self/maps", encoding="utf-8") as maps:
    for line in maps:
        name = os.path.basename(line.split()[-1])
        if name.startswith(("libsmg", "libstreamingmultigrid", "libvtkStreamingMultigrid")):
            loaded.setdefault(name.split(".so")[0], set()).add(line.split()[-1])
assert {"libsmgSolver", "libsmgIOCore", "libstreamingmultigrid"} <= set(loaded), loaded
assert all(len(paths) == 1 for paths in loaded.values()), loaded
print("passed")
