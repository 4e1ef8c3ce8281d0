# SPDX-License-Identifier: BSD-3-Clause
"""The time steps of a VTKHDF file are those of ParaView's clock, for the reader and for filters behind it."""

import os
import sys

import numpy
import smg_testing as t
from hdf_file import HdfFile
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
folder = t.make_folder()
path = os.path.join(folder, "steps.vtkhdf")
TIMES, SCALES = [0.5, 1.5, 4.0], [1.0, 2.0, 3.0]

# A square that grows, with a temperature that rises.
n = 12
x, y = (a.ravel() for a in numpy.meshgrid(numpy.linspace(0, 1, n), numpy.linspace(0, 1, n)))
square = numpy.stack([x, y, 0 * x], 1)
corner = numpy.array([j * n + i for j in range(n - 1) for i in range(n - 1)])
triangles = numpy.concatenate([numpy.stack([corner, corner + 1, corner + n], 1),
                               numpy.stack([corner + 1, corner + n + 1, corner + n], 1)]).astype("int64")
cells, points, steps = len(triangles), len(square), len(TIMES)
with HdfFile(path, "/VTKHDF", "UnstructuredGrid") as file:
    file.dataset("NumberOfPoints", numpy.full(steps, points, "int64"))
    file.dataset("NumberOfCells", numpy.full(steps, cells, "int64"))
    file.dataset("NumberOfConnectivityIds", numpy.full(steps, 3 * cells, "int64"))
    file.dataset("Points", numpy.concatenate([scale * square for scale in SCALES]))
    file.dataset("Connectivity", numpy.tile(triangles.ravel(), steps))
    file.dataset("Offsets", numpy.tile(3 * numpy.arange(cells + 1, dtype="int64"), steps))
    file.dataset("Types", numpy.full(steps * cells, 5, "uint8"))
    file.group("PointData")
    file.dataset("PointData/Temperature", numpy.concatenate([x + 10 * time for time in TIMES]))
    file.group("Steps")
    file.attribute("Steps", "NSteps", steps)
    file.dataset("Steps/Values", numpy.array(TIMES))
    file.dataset("Steps/PartOffsets", numpy.arange(steps, dtype="int64"))
    file.dataset("Steps/NumberOfParts", numpy.ones(steps, "int64"))
    file.dataset("Steps/PointOffsets", points * numpy.arange(steps, dtype="int64"))
    file.dataset("Steps/CellOffsets", cells * numpy.arange(steps, dtype="int64"))
    file.dataset("Steps/ConnectivityIdOffsets", 3 * cells * numpy.arange(steps, dtype="int64"))
    file.group("Steps/PointDataOffsets")
    file.dataset("Steps/PointDataOffsets/Temperature", points * numpy.arange(steps, dtype="int64"))

reader = StreamingMeshReader(FileName=path)
distance = StreamingDistance(Input=reader, From='{"halfspace": [-1, 0, 0, 0]}')
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
assert list(reader.TimestepValues) == TIMES, reader.TimestepValues
assert list(scene.TimeKeeper.TimestepValues) == TIMES, scene.TimeKeeper.TimestepValues
assert (scene.StartTime, scene.EndTime) == (TIMES[0], TIMES[-1])
view = GetActiveViewOrCreate("RenderView")
Show(reader, view)
Show(distance, view)


def check(source, step, where):
    data = source.GetDataInformation()
    assert data.GetBounds()[1] == SCALES[step], (where, data.GetBounds())
    low, high = source.PointData["Temperature"].GetRange()
    assert abs(low - 10 * TIMES[step]) < 1e-12 and abs(high - low - 1) < 1e-12, (where, low, high)


def check_all(step, where):
    check(reader, step, where)
    check(distance, step, where)
    high = distance.PointData["Distance"].GetRange()[1]
    assert abs(high - SCALES[step]) < 1e-6 * SCALES[step], (where, high)


scene.GoToFirst()
check_all(0, "first")
scene.GoToNext()
check_all(1, "next")
scene.GoToLast()
check_all(2, "last")
# In any order, and between the steps: the last one that has begun.
for time, step in (0.5, 0), (4.0, 2), (1.5, 1), (1.4, 0), (3.9, 1), (-7.0, 0), (99.0, 2):
    for source in reader, distance:
        UpdatePipeline(time, proxy=source)
    check_all(step, time)
    assert t.client_object(reader).GetOutputDataObject(0).GetInformation().Has(
        t.client_object(reader).GetOutputDataObject(0).DATA_TIME_STEP())

# A file has the time step that is shown, with the values of the filter on it.
for go, step in (scene.GoToLast, 2), (scene.GoToFirst, 0), (scene.GoToNext, 1):
    go()
    saved = os.path.join(folder, f"step{step}.vsm")
    SaveData(saved, proxy=distance)
    again = StreamingMeshReader(FileName=saved)
    again.UpdatePipeline()
    check(again, step, saved)
    assert abs(again.PointData["Distance"].GetRange()[1] - SCALES[step]) < 1e-6 * SCALES[step]
    assert not list(again.TimestepValues)
    Delete(again)
