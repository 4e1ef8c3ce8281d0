// SPDX-License-Identifier: BSD-3-Clause
// A heat sink on a chip, with names for its parts and faces, for Gmsh 4:
//
//     gmsh -3 heat_sink.geo -o heat_sink.msh
//
// Lengths are in millimetres here and in metres in the mesh; z points up.
SetFactory("OpenCASCADE");
Mesh.ScalingFactor = 0.001;
Mesh.MeshSizeMax = 2.7;

Box(1) = {10, 10, 0, 14, 14, 2}; // the chip
Box(2) = {0, 0, 2, 34, 34, 4};   // the base on it
For fin In {0 : 4}
  Box(3 + fin) = {8 * fin, 0, 6, 2, 34, 12};
EndFor
BooleanFragments{ Volume{1 : 7}; Delete; }{} // parts that touch share the face between them

solder() = Surface In BoundingBox {9, 9, -1, 25, 25, 1};
air() = CombinedBoundary{ Volume{1 : 7}; };
air() -= Surface In BoundingBox {9, 9, -1, 25, 25, 3}; // the chip

Physical Volume("chip") = {1};
Physical Volume("heat sink") = {2 : 7};
Physical Surface("solder") = solder(); // the bottom of the chip
Physical Surface("air") = air();       // all of the heat sink that the chip does not cover
