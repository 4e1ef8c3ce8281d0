# SPDX-License-Identifier: BSD-3-Clause
"""A mesh of a million vertices passes through pvpython in a small, fixed amount of memory."""

import os
import sys

import smg_testing as t
from paraview.simple import *


def resident(field):
    with open("/proc/self/status", encoding="utf-8") as status:
        for line in status:
            if line.startswith(field):
                return int(line.split()[1]) / 1024.0
    raise RuntimeError(field)


meshes = os.environ.get("SMG_TEST_DATA_DIR")
if not meshes:
    t.skip("SMG_TEST_DATA_DIR is empty")
container = os.path.join(t.make_folder(), "head.vsm")
t.run_smg("convert", os.path.join(meshes, "head_mri_1m.ply"), container)

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson
idle = resident("VmRSS")
reader = OpenDataFile(container)
reader.MaximumPointsInMemory, reader.PreviewPoints = 100000, 10000
reader.UpdatePipelineInformation()
reader.UpdatePipeline()
bounds = reader.GetDataInformation().GetBounds()
margin = 0.02 * (bounds[5] - bounds[4])
poisson = t.make_poisson(t.make_problem(reader, "Z", bounds[4] + margin, bounds[5] - margin))
poisson.MemoryLimit = 128
poisson.UpdatePipeline()
poisson.UpdatePropertyInformation()
assert poisson.GetPropertyValue("Converged") == 1
used = resident("VmHWM") - idle
print(f"{used:.0f} MiB above {idle:.0f} MiB, solver's pool "
      f"{poisson.GetPropertyValue('PeakMemory') / 2**20:.1f} MiB")
assert used < 150.0
print("passed")
