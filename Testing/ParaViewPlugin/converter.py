# SPDX-License-Identifier: BSD-3-Clause
"""The converter: a PLY is converted to a container once, which is then streamed past the guard."""

import json
import os
import sys

import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

folder = t.make_folder()
ply, container = os.path.join(folder, "bunny.ply"), os.path.join(folder, "bunny.vsm")
SaveData(ply, proxy=OpenDataFile(t.BUNNY))

# A new proxy, as made by the Sources menu, reports no error.
converter = StreamingMeshConverter()
converter.UpdatePipelineInformation()
assert not os.path.exists(container)
assert converter.Order == "Breadth First" and not converter.Overwrite
assert converter.MaximumPointsInMemory == 2000000

converter.FileName = ply
converter.OutputFileName = container
converter.MaximumPointsInMemory, converter.PreviewPoints = 1000, 10000
converter.PreviewPoints = 2000
converter.UpdatePipeline()
converter.UpdatePropertyInformation()
report = json.loads(converter.GetPropertyValue("Report"))
assert report["vertices"] == t.BUNNY_POINTS and report["order"] == "bfs", report
assert converter.GetPropertyValue("FullNumberOfCells") == t.BUNNY_CELLS
assert 200 < converter.GetDataInformation().GetNumberOfPoints() <= 2000
assert "OriginalId" in converter.GetPropertyValue("PointArrayInfo")
assert "OriginalId" in converter.PointData.keys()

# Filters get the real mesh; the container is used again.
solved = os.path.join(folder, "solved.vsm")
SaveData(solved, proxy=t.make_poisson(t.make_problem(converter)))
reader = OpenDataFile(solved)
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == t.BUNNY_POINTS
written = os.stat(container).st_mtime_ns
again = StreamingMeshConverter(FileName=ply, OutputFileName=container)
again.UpdatePipeline()
assert again.GetDataInformation().GetNumberOfPoints() == t.BUNNY_POINTS
assert os.stat(container).st_mtime_ns == written

# File > Reload Files converts a file again only if it has changed.
ReloadFiles(converter)
converter.UpdatePipeline()
assert os.stat(container).st_mtime_ns == written
converter.MaximumPointsInMemory = 2000000
with open(ply, "w", encoding="utf-8") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 3\n"
               "property float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
ReloadFiles(converter)
converter.UpdatePipeline()
assert converter.GetDataInformation().GetNumberOfPoints() == 3

# A replaced file offers what it has, and what was not chosen of the one before is not chosen.
replaced = os.path.join(folder, "replaced.ply")


def write_with(*columns):
    with open(replaced, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 3\n")
        file.writelines(f"property float {name}\n" for name in ("x", "y", "z") + columns)
        file.write("element face 1\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(f"{place} {'7 ' * len(columns)}\n" for place in ("0 0 0", "1 0 0", "0 1 0"))
        file.write("3 0 1 2\n")


write_with("heat", "age")
reader = StreamingMeshReader(FileName=replaced)
reader.UpdatePipeline()
assert set(reader.PointArrayStatus.Available) == {"heat", "age", "OriginalId"}, reader.PointArrayStatus.Available
reader.PointArrayStatus = ["heat", "OriginalId"]
for columns in (("age", "size"), ("heat", "size", "age")):
    write_with(*columns)
    ReloadFiles(reader)
    reader.UpdatePipeline()
    reader.UpdatePropertyInformation()
    available = set(reader.PointArrayStatus.Available)
    assert available == set(columns) | {"OriginalId"}, (columns, available)
    assert ("age" in reader.PointData.keys()) is False and "size" in reader.PointData.keys(), reader.PointData.keys()

hints = converter.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
assert hints.GetAttribute("category") == "Streaming Multigrid"
print("passed")
