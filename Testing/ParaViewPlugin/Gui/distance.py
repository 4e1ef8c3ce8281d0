# SPDX-License-Identifier: BSD-3-Clause
"""The steps of Examples/Distance/gui in the real ParaView: opens the bunny, marks the tip of an ear
with a Mesh Region, shows the distances from it, then from the boundary, and from the tip again while a
preview is shown, and saves the mesh: the same bits as those of smg distance.

    distance.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The environment variable SMG_PROGRAM names smg. The functions without arguments at the end are the
checkpoints, which run inside ParaView.
"""

import os
import subprocess
import sys

from paraview_gui import PROPERTIES, Session, read_arguments

EAR, RADIUS = (-0.0175, 0.187, -0.02), 0.008
FROM = '{"sphere": [-0.0175, 0.187, -0.02, 0.008]}'
WIDGET = "RegionFunction/ProxySelectionWidget/frame/ChosenProxyWidget/InteractiveSphere/"


def values(simple, path):
    """The bytes of the points and of their distances."""
    from paraview import servermanager
    from paraview.vtk.util.numpy_support import vtk_to_numpy

    data = servermanager.Fetch(simple.StreamingMeshReader(FileName=path))
    return [vtk_to_numpy(array).tobytes()
            for array in (data.GetPoints().GetData(), data.GetPointData().GetArray("Distance"))]


def play(arguments):
    from paraview import simple

    folder = os.path.abspath(arguments.folder)
    result, expected = (os.path.join(folder, name) for name in ("gui.vsm", "smg.vsm"))
    subprocess.run([os.environ["SMG_PROGRAM"], "distance", arguments.mesh, expected, "--quiet",
                    "--from", FROM], check=True)

    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.open(arguments.mesh)
    session.apply()
    session.checkpoint("opened")
    session.filter("MeshRegion")
    session.write_vector(WIDGET + "center", "XYZ", EAR)
    session.write(WIDGET + "radius", RADIUS)
    session.event(f"{PROPERTIES}/{WIDGET}show3DWidget", "set_boolean", "false")
    session.apply()
    session.filter("StreamingDistance")
    session.choose("Solve", "Preview")
    session.apply()
    session.checkpoint("measured_from_the_tip")
    session.picture("distance-region")
    session.checkpoint("select_region")
    session.choose("Region", "Boundary")
    session.apply()
    session.checkpoint("measured_from_the_boundary")
    session.picture("distance-boundary")
    session.choose("Region", "Function")
    session.apply()
    session.checkpoint("select_mesh")
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.checkpoint("select_distance")
    session.checkpoint("follow")
    session.save_data(result)
    session.run(arguments.timeout)

    simple.LoadPlugin(arguments.plugin, ns=simple.__dict__)
    assert values(simple, result) == values(simple, expected)
    os.write(1, b"passed\n")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

import json

from paraview.simple import *

notes = sys.modules.setdefault("distance_notes", type(sys)("distance_notes"))


def opened():
    notes.mesh = GetActiveSource()
    camera = GetActiveCamera()
    camera.SetPosition(-0.12, 0.22, 0.45)
    camera.SetFocalPoint(-0.017, 0.11, 0.0)
    camera.SetViewUp(0, 1, 0)
    Render()


def report():
    notes.distance.UpdatePropertyInformation()
    found = json.loads(notes.distance.GetPropertyValue("Report"))
    assert found["converged"], found
    assert "Converged " in notes.distance.GetPropertyValue("Outcome"), found
    return found


def largest():
    return notes.distance.PointData["Distance"].GetRange()[1]


def measured_from_the_tip():
    notes.distance = GetActiveSource()
    notes.region = notes.distance.Input
    assert notes.distance.From == ""
    found = report()
    assert found["vertices"] == 34834 and 1 < found["distance"]["sources"] < 500, found
    notes.largest = largest()
    Render()


def measured_from_the_boundary():
    Show(notes.distance)
    Hide(notes.region)
    notes.distance.UpdatePipeline()
    assert report()["distance"]["sources"] == 223, report()
    Render()


def select_region():
    SetActiveSource(notes.region)


def select_mesh():
    SetActiveSource(notes.mesh)


def select_distance():
    SetActiveSource(notes.distance)
    Render()
    assert report()["vertices"] <= 10000
    assert "these are distances on the preview" in notes.distance.GetPropertyValue("Notes")
    assert abs(largest() - notes.largest) < 0.1 * notes.largest


def follow():
    """The distances of the preview follow their region."""
    largest_of = set()
    for step in range(10):
        notes.region.RegionFunction.Center = [EAR[0], EAR[1] - 0.001 * step, EAR[2]]
        notes.distance.UpdatePipeline()
        largest_of.add(report()["distance"]["maximum"])
    assert len(largest_of) > 5, largest_of
    notes.region.RegionFunction.Center = list(EAR)
    notes.distance.UpdatePipeline()
