# SPDX-License-Identifier: BSD-3-Clause
"""Filters of ParaView between the reader of a preview and regions: what is shown has the boundary that ParaView's own
filters see; solving or saving ends with a sentence on what to do, not with a crash; after an error the filters before
show what they showed.

filtered_previews.py PLUGIN"""

import os
import sys

import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
folder = t.make_folder()
ball = os.path.join(folder, "ball.vtp")
SaveData(ball, proxy=Sphere(ThetaResolution=60, PhiResolution=60))
cube = os.path.join(folder, "cube.vtu")
SaveData(cube, proxy=Tetrahedralize(Input=Wavelet(WholeExtent=[0, 12, 0, 12, 0, 12])))

FILTERS = {
    "Clip": (lambda source: Clip(Input=source), (ball, cube)),
    "Threshold": (lambda source: Threshold(Input=Elevation(Input=source), Scalars=["POINTS", "Elevation"],
                                           LowerThreshold=0, UpperThreshold=0.5), (ball, cube)),
    "Slice": (lambda source: Slice(Input=source), (ball, cube)),
    "Extract Surface": (lambda source: ExtractSurface(Input=Clip(Input=source)), (ball, cube)),
    "Decimate": (lambda source: Decimate(Input=source), (ball,)),
    "Reflect": (lambda source: Reflect(Input=source), (ball, cube)),
    "Append": (lambda source: AppendDatasets(Input=[source, Sphere()]), (ball, cube)),
}
REGIONS = {"Boundary": {"Region": "Boundary"}, "Points": {"Region": "Points", "Points": [-0.5, 0.0, 0.0]},
           "Ids": {"Region": "Ids", "Ids": [5]}, "Everywhere": {"Region": "Everywhere"}}


def outcome(source):
    source.UpdatePipeline()
    source.UpdatePropertyInformation()
    return source.GetPropertyValue("Outcome")


def points_of(source):
    info = source.GetDataInformation()
    return info.GetNumberOfPoints(), info.GetBounds()


with t.Silence():
    for name, (make, files) in FILTERS.items():
        for file in files:
            reader = StreamingMeshReader(FileName=file, MaximumPointsInMemory=1000, PreviewPoints=400)
            reader.UpdatePipeline()
            before = points_of(reader)
            assert before[0] <= 400, (name, before)
            filtered = make(reader)
            for region, properties in REGIONS.items():
                for is_shown in (False, True):
                    marked = MeshRegion(Input=filtered, **properties)
                    if is_shown:
                        marked.UpdatePipeline()
                    distance = StreamingDistance(Input=marked)
                    found = outcome(distance)
                    failed = found.startswith("Failed")
                    handle = MeshHandle(Input=filtered, **properties)
                    outcome(handle)
                    SaveData(os.path.join(folder, "saved.vsm"), proxy=handle)
                    reader.UpdatePipeline()
                    assert not failed or points_of(reader) == before, (name, region, found, points_of(reader), before)
                    for each in (distance, handle, marked):
                        Delete(each)

# The rim of a clipped preview is that of the surface, not all of it.
for preview_points in (300, 1500, 100000):
    reader = StreamingMeshReader(FileName=ball, MaximumPointsInMemory=1000, PreviewPoints=preview_points)
    clip = Clip(Input=reader)
    clip.ClipType.Origin = [0.013, 0.0, 0.0]
    edges = FeatureEdges(Input=ExtractSurface(Input=clip), FeatureEdges=0, NonManifoldEdges=0)
    edges.UpdatePipeline()
    region = MeshRegion(Input=clip, Region="Boundary")
    outcome(region)
    assert region.GetPropertyValue("NumberOfHeldPoints") == edges.GetDataInformation().GetNumberOfPoints()
os.write(1, b"passed\n")
