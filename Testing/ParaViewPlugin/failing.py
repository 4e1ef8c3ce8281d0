# SPDX-License-Identifier: BSD-3-Clause
"""The output of every filter and reader that fails is a complete empty data set: filters of ParaView behind it work on
it as on an empty clip. Its outcome is that of the last request, whatever has failed before. Each row of the table is a
filter and what makes it fail."""

import os
import sys

import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
folder = t.make_folder()

FAR = {"RegionFunction": "Sphere"}
NOWHERE = '[{"sphere": [9, 9, 9, 1]}]'
FILTERS = ((MeshRegion, FAR), (MeshHandle, FAR), (MeshCondition, FAR), (MeshRegion, {"Region": "Mask"}),
           (StreamingPoisson, {"Problem": '{"dirichlet": %s}' % NOWHERE}), (StreamingMeshDeformation, {}),
           (StreamingMeshSmoothing, {"Hold": NOWHERE}), (StreamingBlend, {}),
           (StreamingDistance, {"From": NOWHERE}), (StreamingMeshSimplification, {"ScratchDirectory": "/nowhere"}),
           (StreamingMeshPreview, {}))


def fail(make, properties, mesh):
    """A filter that works until it is told otherwise."""
    made = make(Input=mesh)
    for name, value in properties.items():
        setattr(made, name, value)
    if properties == FAR:
        made.RegionFunction.Center, made.RegionFunction.Radius = [9.0, 9.0, 9.0], 0.1
    return made


def line(source):
    return PlotOverLine(Input=source, Point1=[-1.0, 0.0, 0.0], Point2=[1.0, 0.0, 0.0])


def probe(source):
    return ProbeLocation(Input=source, ProbeType="Fixed Radius Point Source")


# Without Mesh Quality, which crashes on ParaView's own empty clip.
CONSUMERS = (line, probe, lambda source: ResampleWithDataset(SourceDataArrays=source, DestinationMesh=Sphere()),
             lambda source: ResampleWithDataset(SourceDataArrays=Wavelet(), DestinationMesh=source),
             lambda source: ResampleToImage(Input=source), lambda source: ExtractSurface(Input=source),
             lambda source: Glyph(Input=source), lambda source: Calculator(Input=source, Function="coordsX"),
             lambda source: AppendDatasets(Input=[source, Sphere()]), lambda source: AppendDatasets(Input=source),
             lambda source: AppendGeometry(Input=[source, Sphere()]), lambda source: Clip(Input=source),
             lambda source: Slice(Input=source), lambda source: CellCenters(Input=source),
             lambda source: CellSize(Input=source), lambda source: CleantoGrid(Input=source),
             lambda source: Connectivity(Input=source), lambda source: FeatureEdges(Input=source),
             lambda source: IntegrateVariables(Input=source), lambda source: Tetrahedralize(Input=source),
             lambda source: Transform(Input=source), lambda source: GenerateIds(Input=source),
             lambda source: GroupDatasets(Input=[source, Sphere()]))


def check_complete(source, failed=True):
    data = t.client_object(source).GetOutputDataObject(0)
    assert data.GetNumberOfPoints() == 0 and data.GetNumberOfCells() == 0, source
    assert data.GetPoints() is not None, (source, "no points")
    if data.IsA("vtkUnstructuredGrid"):
        assert data.GetCells() is not None and data.GetCellTypesArray() is not None, (source, "no cells")
    assert data.GetFieldData().HasArray("Failed") == failed, source


def consume(source):
    view = GetActiveViewOrCreate("RenderView")
    Show(source, view)
    Render(view)
    for make in CONSUMERS:
        after = make(source)
        after.UpdatePipeline()
        after.GetDataInformation().GetNumberOfPoints()
        Delete(after)
    for suffix in "vtp", "vtu", "ply", "vsm", "csv":
        path = os.path.join(folder, "failed." + suffix)
        SaveData(path, proxy=source)
        assert not os.path.exists(path), (source, suffix)
    Hide(source, view)


def outcome(source):
    source.UpdatePipeline()
    source.UpdatePropertyInformation()
    return source.GetPropertyValue("Outcome")


def check_outcomes(make, properties, mesh):
    """The filter fails by itself, behind a failed filter of ours, and behind one that ends its update; one after the other."""
    inputs = lambda: mesh, lambda: fail(MeshRegion, FAR, mesh), lambda: XMLPolyDataReader(FileName=["/nowhere.vtp"])
    alone = [outcome(fail(make, properties, each())) for each in inputs]
    assert alone[0] != alone[1] and "filter before this one" in alone[1], alone
    source = fail(make, properties, mesh)
    for first in range(3):
        for second in range(3):
            for each in first, second:
                source.Input = inputs[each]()
                assert outcome(source) == alone[each], (make, first, second, source.Outcome, alone)
    Delete(source)


with t.Silence():
    mesh = Sphere()
    mesh.UpdatePipeline()
    for make, properties in FILTERS:
        if make is not StreamingMeshPreview:
            check_outcomes(make, properties, mesh)

    # Filters of ParaView that are not for the type of the data say so.
    for mesh in Sphere(), Tetrahedralize(Input=Wavelet(WholeExtent=[-2, 2, -2, 2, -2, 2])):
        mesh.UpdatePipeline()
        for make, properties in FILTERS:
            source = fail(make, properties, mesh)
            if make is StreamingMeshPreview:
                source.Input = fail(MeshRegion, FAR, mesh)
            source.UpdatePipeline()
            check_complete(source)
            consume(source)
            # Two filters of ours in a row.
            after = StreamingDistance(Input=source)
            after.UpdatePipeline()
            check_complete(after)
            line(after).UpdatePipeline()
            Delete(after)
            Delete(source)

    # A reader whose file is replaced by something else.
    path = os.path.join(folder, "mesh.vsm")
    SaveData(path, proxy=Sphere())
    reader = StreamingMeshReader(FileName=path)
    reader.UpdatePipeline()
    distance = StreamingDistance(Input=reader)
    distance.UpdatePipeline()
    with open(path, "w", encoding="ascii") as file:
        file.write("<html>")
    reader.SMProxy.InvokeCommand("Refresh")
    for source in reader, distance, StreamingMeshReader(FileName="/nowhere.vsm"), \
            StreamingMeshConverter(FileName="/nowhere.ply", OutputFileName="/nowhere/mesh.vsm"):
        source.UpdatePipeline()
        check_complete(source)
        consume(source)

    # A filter that is aborted.
    smoothing = StreamingMeshSmoothing(Input=Sphere(ThetaResolution=200, PhiResolution=200))
    algorithm = t.client_object(smoothing)
    algorithm.AddObserver("ProgressEvent", lambda *_: algorithm.SetAbortExecute(1))
    smoothing.UpdatePipeline()
    check_complete(smoothing, failed=False)
    line(smoothing).UpdatePipeline()
os.write(1, b"passed\n")
