# SPDX-License-Identifier: BSD-3-Clause
"""After a failure a filter says nothing of its last result: each property that informs has the value that it has
before any result, for every filter of the plugin, whether it failed itself or one before it did."""

import os
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkOutputWindow, vtkStringOutputWindow

vtkOutputWindow.SetInstance(vtkStringOutputWindow())  # the errors are wanted
LoadPlugin(sys.argv[1], ns=globals())

# What failed, what something would cost and what the input is say so of themselves; builds are counted for ever.
SAID_OTHERWISE = {"Outcome", "Error", "Estimate", "HeldBounds", "NumberOfBuilds"}


def information(proxy):
    proxy.UpdatePropertyInformation()
    values = {}
    iterator = proxy.SMProxy.NewPropertyIterator()
    while not iterator.IsAtEnd():
        name, one = iterator.GetKey(), iterator.GetProperty()
        if one.GetInformationOnly() and name not in SAID_OTHERWISE and hasattr(one, "GetNumberOfElements"):
            values[name] = [str(one.GetElement(k)) for k in range(one.GetNumberOfElements())]
        iterator.Next()
    return values


def make_all():
    reader = StreamingMeshReader(FileName=t.BUNNY)
    scan = Calculator(Input=reader, Function="coordsY > 0.1", ResultArrayName="Scan")
    light = Calculator(Input=scan, Function="coordsX", ResultArrayName="Light")
    region = MeshRegion(Input=light, Region="Ids", Ids=[5])
    cold = MeshCondition(Input=light, Region="Ids", Ids=[5])
    hot = MeshCondition(Input=cold, Region="Ids", Ids=[900], Value=1)
    handle = MeshHandle(Input=light, Region="Ids", Ids=[5])
    filters = [region, hot, handle,
               StreamingPoisson(Input=hot), StreamingDistance(Input=region), StreamingMeshSmoothing(Input=light),
               StreamingMeshDeformation(Input=handle), StreamingBlend(Input=light, Patch="Scan", Arrays=["Light"]),
               StreamingMeshSimplification(Input=light, NumberOfVertices=500),
               StreamingMeshPreview(Input=light, PreviewPoints=500)]
    return reader, filters


def update(proxy):
    try:
        proxy.UpdatePipeline()
    except RuntimeError:
        pass


_, fresh = make_all()
before = [information(proxy) for proxy in fresh]
assert sum(len(values) for values in before) > 30, before
reader, filters = make_all()
for proxy, none in zip(filters, before):
    name = proxy.GetXMLName()
    reader.PreviewPoints = 10000
    update(proxy)
    succeeded = information(proxy)
    assert succeeded != none, name
    outcome = proxy.SMProxy.GetProperty("Outcome")
    assert not proxy.GetPropertyValue("Error"), (name, proxy.GetPropertyValue("Error"))
    reader.PreviewPoints = 1  # out of its range
    update(proxy)
    assert information(proxy) == none, (name, information(proxy), none)
    assert proxy.GetPropertyValue("Error"), name
    said = proxy.GetPropertyValue("Outcome") if outcome else "Failed"
    assert "ailed" in said or "Not" in said, (name, said)
    reader.PreviewPoints = 10000
    update(proxy)
    assert information(proxy).keys() == succeeded.keys() and information(proxy) != none, name
    # Its own failure.
    pieces = servermanager.vtkSMPropertyHelper(proxy.SMProxy, "NumberOfPieces")
    pieces.Set(-1)
    proxy.SMProxy.UpdateVTKObjects()
    update(proxy)
    assert information(proxy) == none, (name, information(proxy), none)
    pieces.Set(0)
    proxy.SMProxy.UpdateVTKObjects()
# What failed has no size, and is no piece of a mesh.
empty = MeshHandle(Input=Sphere(), Region="Selection")
estimated = [proxy for proxy in filters if proxy.SMProxy.GetProperty("Estimate")]
assert len(estimated) == 6, estimated
for proxy in estimated:
    proxy.Input = empty
    update(proxy)
    proxy.UpdatePropertyInformation()
    assert proxy.GetPropertyValue("Estimate").startswith("Not known: the input has failed"), proxy.GetXMLName()
os.write(1, b"passed\n")
