# SPDX-License-Identifier: BSD-3-Clause
"""No array property is ever set automatically, regardless of the active arrays of the input. Lists of arrays, also that
of colours, offer arrays of points and cells alone, and nothing internal. Of the output the arrays are active that are of
the input, but for the scalars that a filter makes."""

import sys

import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson


INTERNAL = {"GlobalIds", "vtkGhostType"}  # StreamFinalized is of pieces alone
LISTS = {"StreamingPoisson": 7, "MeshCondition": 2, "MeshHandle": 2, "MeshRegion": 2, "StreamingBlend": 2,
         "StreamingMeshSmoothing": 1}


def visible(source):
    """The arrays of points and cells that a user may see."""
    return (set(source.PointData.keys()) | set(source.CellData.keys())) - INTERNAL


def check_colours(source, when):
    """What Color By offers."""
    display = Show(source, GetActiveViewOrCreate("RenderView"))
    domain = display.GetProperty("ColorArrayName").SMProperty.FindDomain("vtkSMArrayListDomain")
    offered = {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}
    assert offered - {"None"} == visible(source) - {"CellFlags"}, (when, offered, visible(source))
    Hide(source)


def check(source, when):
    for name in LISTS:
        proxy = globals()[name](Input=source)
        checked = 0
        for name in proxy.ListProperties():
            domain = proxy.GetProperty(name).SMProperty.FindDomain("vtkSMArrayListDomain")
            if domain:
                value = proxy.GetPropertyValue(name)
                chosen = value if isinstance(value, str) else ([None] + list(value))[-1]
                assert chosen in ("None", "", None), (when, name, value)
                offered = {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}
                assert "None" in offered or name == "Arrays", (when, name, offered)
                assert offered - {"None"} <= visible(source), (when, name, offered)
                checked += 1
        assert checked == LISTS[proxy.SMProxy.GetXMLName()], (proxy, checked)


reader = OpenDataFile(t.BUNNY)
check(reader, "before an update")
reader.UpdatePipeline()
check(reader, "after an update")
calculators = t.make_problem(reader)
check(calculators, "behind two calculators")
calculators.UpdatePipeline()
check(calculators, "behind two calculators that were updated")
display = Show(calculators, CreateView("RenderView"))
ColorBy(display, ("POINTS", "Mask"))
check(calculators, "while it is coloured by another array")

conditions = MeshCondition(Input=MeshCondition(Input=calculators, Region="Everywhere"), Region="Everywhere")
check(conditions, "behind conditions")
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
reader.UpdatePipeline()
check(reader, "behind a preview")
# Behind every filter, with its marks and its report, and behind one that has failed.
region = MeshRegion(Input=conditions, Region="Everywhere")
for source in (reader, conditions, region, MeshHandle(Input=reader, Region="Everywhere"), StreamingPoisson(Input=conditions),
               StreamingDistance(Input=region), StreamingMeshSmoothing(Input=region),
               StreamingMeshDeformation(Input=MeshHandle(Input=reader, Region="Everywhere")),
               StreamingMeshSimplification(Input=reader, NumberOfVertices=1000), StreamingMeshPreview(Input=reader)):
    source.UpdatePipeline()
    check_colours(source, "by " + source.SMProxy.GetXMLName())
    check(source, "behind " + source.SMProxy.GetXMLName())
# What is active stays so, of points and of cells.
ACTIVE = {"Scalars": 1, "Vectors": 3, "Normals": 3, "TCoords": 2}


def activate(*sets):
    """Makes arrays active that are called as the attributes."""
    for data in sets:
        for name, components in ACTIVE.items():
            array = numpy_to_vtk(numpy.resize(numpy.arange(7.0), (data.GetNumberOfTuples(), components)), deep=1)
            array.SetName("Own" + name)
            data.AddArray(array)
            getattr(data, "SetActive" + name)("Own" + name)


def active(source):
    source.UpdatePipeline()
    data = t.client_object(source).GetOutputDataObject(0)
    names = [[getattr(each, "Get" + name)() for name in ACTIVE] for each in (data.GetPointData(), data.GetCellData())]
    return [[array.GetName() if array else None for array in each] for each in names]


marked = Sphere(ThetaResolution=40, PhiResolution=40)
marked.UpdatePipeline()
producer = PVTrivialProducer()
mesh = t.client_object(marked).GetOutputDataObject(0).NewInstance()
mesh.ShallowCopy(t.client_object(marked).GetOutputDataObject(0))
activate(mesh.GetPointData(), mesh.GetCellData())
t.client_object(producer).SetOutput(mesh)
own = ["Own" + name for name in ACTIVE]
assert active(producer) == [own, own]
point = {"Region": "Ids", "Ids": [3]}
handles = MeshHandle(Input=MeshHandle(Input=producer, **point), Region="Ids", Ids=[5])
for scalars, cells, filtered in (
        ("HandleMask", own, handles), ("RegionMask", own, MeshRegion(Input=producer, **point)),
        ("Condition1", own, MeshCondition(Input=producer, **point)), (own[0], own, MeshCondition(Input=producer, Region="Boundary")),
        (own[0], own, StreamingMeshDeformation(Input=handles)),
        ("HandleMask", own, StreamingMeshDeformation(Input=handles, KeepHandleArrays=1)),
        ("RegionMask", own, StreamingMeshDeformation(Input=MeshRegion(Input=handles, **point))),
        ("Solution", own, StreamingPoisson(Input=MeshCondition(Input=producer, Value=1.0, **point))),
        ("Distance", own, StreamingDistance(Input=producer, From='{"vertices": [3]}')),
        (own[0], own, StreamingMeshSmoothing(Input=producer)), (own[0], own, StreamingMeshSmoothing(Input=producer, Array=own[0])),
        (own[0], own, StreamingBlend(Input=producer, Patch=own[0], Arrays=[own[1]])),
        (own[0], [None] * 4, StreamingMeshSimplification(Input=producer, NumberOfVertices=500))):
    assert active(filtered) == [[scalars] + own[1:], cells], (filtered.SMProxy.GetXMLName(), active(filtered), scalars)
assert active(StreamingMeshPreview(Input=Elevation(Input=reader)))[0] == active(Elevation(Input=reader))[0] == \
    ["Elevation", None, "Normals", None]

# Points and cells with arrays of one name: what is chosen is taken.
both = ProgrammableFilter(Input=Sphere(ThetaResolution=20, PhiResolution=14), Script="""
import numpy
output.ShallowCopy(inputs[0].VTKObject)
points = numpy.linspace(1, 3, output.GetNumberOfPoints())
cells = numpy.linspace(5, 1, output.GetNumberOfCells())
for data, values, own in ((output.PointData, points, "OwnPoints"), (output.CellData, cells, "OwnCells")):
    data.append(values, "Both")
    data.append(values, own)
output.CellData.append(numpy.resize(numpy.arange(7.0), (len(cells), 3)), "Flow")
output.PointData.append(numpy.resize(numpy.arange(5.0), (len(points), 3)), "Flow")
output.CellData.append(numpy.resize(numpy.arange(7.0), (len(cells), 3)), "OwnFlow")
""")
held = MeshCondition(Input=both, Region="Ids", Ids=[0, 100])


def solved(**settings):
    values = t.points_of(StreamingPoisson(Input=held, **settings), "Solution")
    assert values.shape[1] == 1, settings
    return values


for name, others in (("ConductivityArray", {"Source": ["POINTS", "OwnPoints"]}), ("Source", {}),
                     ("ScreeningArray", {"Source": ["POINTS", "OwnPoints"]})):
    of_both = {where: solved(**{name: [where, "Both"]}, **others) for where in ("POINTS", "CELLS")}
    assert numpy.array_equal(of_both["POINTS"], solved(**{name: ["POINTS", "OwnPoints"]}, **others)), name
    assert numpy.array_equal(of_both["CELLS"], solved(**{name: ["CELLS", "OwnCells"]}, **others)), name
    # A name alone means the only array of it, though ParaView makes one of points out of that of the cells.
    assert numpy.array_equal(of_both["CELLS"], solved(**{name: "OwnCells"}, **others)), name
    assert not numpy.allclose(of_both["POINTS"], of_both["CELLS"]), name
flow = solved(FieldArray=["CELLS", "OwnFlow"])
for chosen in ("Flow", "OwnFlow", ["CELLS", "Flow"], ["POINTS", "Flow"]):
    assert numpy.array_equal(solved(FieldArray=chosen), flow), chosen

# A result in the place of an array is not what that was to VTK, and can be saved.
ATTRIBUTES = ("Normals", "TCoords", "Tensors", "GlobalIds", "PedigreeIds", "Tangents", "EdgeFlag", "RationalWeights",
              "HigherOrderDegrees", "Vectors")
attributed = ProgrammableFilter(Input=Sphere(ThetaResolution=20, PhiResolution=14), Script="""
import numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray
output.ShallowCopy(inputs[0].VTKObject)
points = output.VTKObject.GetPointData()
points.Initialize()
components = {"Normals": 3, "TCoords": 2, "Tensors": 9, "Tangents": 3, "HigherOrderDegrees": 3, "Vectors": 3}
from vtkmodules.util.numpy_support import numpy_to_vtk
for name in %r:
    values = numpy.resize(numpy.arange(7.0), (output.GetNumberOfPoints(), components.get(name, 1)))
    array = numpy_to_vtk(values, deep=1)
    if name.endswith("Ids"):
        array = vtkIdTypeArray()
        for i in range(output.GetNumberOfPoints()):
            array.InsertNextValue(i)
    array.SetName("An" + name)
    points.AddArray(array)
    assert points.SetActiveAttribute("An" + name, %r.index(name)) >= 0, name
""" % (ATTRIBUTES, ("Scalars", "Vectors", "Normals", "TCoords", "Tensors", "GlobalIds", "PedigreeIds", "EdgeFlag", "Tangents",
                    "RationalWeights", "HigherOrderDegrees")))
for name in ATTRIBUTES:
    condition = MeshCondition(Input=attributed, Region="Everywhere", Condition="Dirichlet", Value=2)
    filtered = StreamingPoisson(Input=condition, ResultArrayName="An" + name)
    filtered.UpdatePipeline()
    points = t.client_object(filtered).GetOutputDataObject(0).GetPointData()
    array = points.GetAbstractArray("An" + name)
    assert array.GetNumberOfComponents() == 1 and array.GetTuple1(7) == 2, name
    for type in range(1, len(ATTRIBUTES) + 1):  # of 0, the scalars, it is
        assert points.GetAbstractAttribute(type) is not array, (name, type)
    assert points.GetScalars() is array
    moved = Transform(Input=filtered)
    moved.Transform.Rotate = [0, 90, 0]
    assert t.points_of(moved, "An" + name).shape[1] == 1, name

# Its shading is that of the mesh.
assert Show(reader, GetActiveView()).SelectNormalArray == "Normals"
reader.MaximumPointsInMemory = 2000000

# A scan in millimetres, in a typical script: the harmonic field stays between its end values.
scaled = Transform(Input=reader)
scaled.Transform.Scale = [1000.0] * 3
scaled.UpdatePipeline()
poisson = t.make_poisson(t.make_problem(scaled, low=1000 * t.FEET, high=1000 * t.EARS))
poisson.UpdatePipeline()
values = t.points_of(poisson, "Solution")
poisson.UpdatePropertyInformation()
assert poisson.GetPropertyValue("Converged") == 1
for axis, (low, high) in enumerate(zip(*[iter(scaled.GetDataInformation().GetBounds())] * 2)):
    margin = 0.05 * (high - low)
    assert low - margin < values[:, axis].min() and values[:, axis].max() < high + margin, axis
print("passed")
