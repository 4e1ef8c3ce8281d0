# SPDX-License-Identifier: BSD-3-Clause
"""The region that a new Mesh Region holds is a part of each of ParaView's sources and passes through none of their
points, so that rounding decides nothing; what is inside and what is outside of a shape are all points."""

import sys

import numpy
import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())


def held(source, **properties):
    """The mask of the region, after the shape has been fitted to the source."""
    region = MeshRegion(Input=source, **properties)
    region.UpdatePipeline()
    mask = t.points_of(region, "RegionMask")[:, 0] != 0
    sphere = region.RegionFunction.Center[:] + [region.RegionFunction.Radius] if "Region" not in properties and (
        region.RegionFunction.GetXMLName() == "Sphere") else None
    Delete(region)
    return mask, sphere


made = [Sphere(), Sphere(ThetaResolution=64, PhiResolution=64), Box(), Cylinder(), Cylinder(Resolution=100), Cone(), Plane(),
        Plane(XResolution=20, YResolution=20), Disk(), Superquadric(), Arrow(), StreamingMeshReader(FileName=t.BUNNY)]
for shape in made:
    source = Triangulate(Input=shape) if shape.GetXMLName() != "StreamingMeshReader" else shape
    for factor in 1.0, 1000.0:
        moved = source
        if factor != 1.0 and source is not shape:
            moved = Transform(Input=source)
            moved.Transform.Scale, moved.Transform.Translate = [factor] * 3, [5e5, 4e6, 100.0]
        moved.UpdatePipeline()
        mask, sphere = held(moved)
        points = t.vtk_to_numpy(servermanager.Fetch(moved).GetPoints().GetData()).astype(float)
        assert 0.02 < mask.mean() < 0.7, (shape, factor, mask.mean())
        if factor == 1.0:
            distances = numpy.linalg.norm(points - sphere[:3], axis=1)
            assert abs(distances - sphere[3]).min() > 1e-5 * sphere[3], (shape, sphere)
        assert (held(moved, InsideOut=1)[0] == ~mask).all(), (shape, factor)
# The law also holds where points lie exactly on the shape.
ball = AppendGeometry(Input=[Sphere(Radius=1.0), Sphere(Radius=2.0)])
ball.UpdatePipeline()
for name, properties in (("Sphere", {"Center": [0, 0, 0], "Radius": 1.0}), ("Plane", {"Origin": [0, 0, 0], "Normal": [0, 0, 1]}),
                         ("Cylinder", {"Center": [0, 0, 0], "Axis": [0, 0, 1], "Radius": 1.0})):
    masks = []
    for outside in 0, 1:
        region = MeshRegion(Input=ball, RegionFunction=name, InsideOut=outside)
        for key, value in properties.items():
            setattr(region.RegionFunction, key, value)
        region.UpdatePipeline()
        masks.append(t.points_of(region, "RegionMask")[:, 0] != 0)
    assert (masks[0] ^ masks[1]).all(), (name, masks)
print("passed")
