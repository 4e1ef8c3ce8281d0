// SPDX-License-Identifier: BSD-3-Clause
/*
The Stanford bunny turns its head, out of core, in C++ without VTK.

Its base is fixed, its head turned by 70 degrees and scaled by 1.3, an ear turned by 90 degrees; the
rest of the mesh follows and keeps its details. A handle file defines the held regions and their
motion, as for the program smg: smg deform MESH OUT --handles bunny.json.

What this lesson shows:
 1. A DeformationDescription says which vertices are held and how they move; a program sets it or
    reads it from a file. (For handles that no description can say, derive from Handles.)
 2. deform() reads the mesh stream once, works on scratch files within a memory limit, and returns
    the new positions, which are read range by range. Two problems are solved on one hierarchy:
    first the rotations and scales between the handles, then the positions of the vertices.
 3. MovedMesh is the mesh stream with new positions and all its columns; a writer reads it block by
    block. The whole mesh is never in memory.

Run it:

    deformation ../../Data/bunny.smb ../bunny.json bunny-deformed.vsm

    34834 vertices, 69451 cells: converged in 11 passes
      rotation: 5 cycles, relative residual 1.89328e-07
      position: 5 cycles, relative residual 8.73883e-08
*/

#include <smg/Convert.h>
#include <smg/Deform.h>
#include <smg/DeformationDescription.h>
#include <smg/DescriptionFiles.h>
#include <smg/MovedMesh.h>
#include <smg/WriteMesh.h>

#include <iostream>

namespace
{

void print(const smg::Report& report)
{
  std::cout << report.vertices << " vertices, " << report.cells
            << " cells: " << (report.converged ? "converged" : "not converged") << " in "
            << report.passes << " passes\n";
  for (const smg::Report::Step& step : report.steps)
  {
    std::cout << "  " << step.name << ": " << step.cycles << " cycles, relative residual "
              << step.residual << "\n";
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: deformation MESH HANDLES.json DEFORMED.vsm|.ply|.vtp|.vtu\n";
    return 2;
  }
  try
  {
    // Any mesh file is converted to a mesh stream; a stream keeps its order.
    const auto mesh = smg::openMesh(argv[1]);
    smg::DeformOptions options;
    options.memoryLimit = 128 * smg::MiB;
    const auto positions = smg::deform(*mesh, smg::readHandleFile(argv[2]), options, argv[2]);
    print(positions->report());

    // Existing normals are recomputed.
    const smg::MovedMesh moved(*mesh, *positions, smg::MovedNormals::Recompute);
    for (const std::string& remark : smg::writeMesh(*moved.source(), argv[3]))
    {
      std::cout << remark << "\n";
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
