// SPDX-License-Identifier: BSD-3-Clause
/*
The Stanford bunny becomes smooth except for its head, out of core, in C++ without VTK.

The fur is a detail of a few millimetres: two implicit steps halve waves of 1 cm. The head is held.
The same from the command line:

    smg smooth bunny.smb bunny-smooth.vsm --size 0.01 --steps 2 \
      --hold '{"sphere": [-0.07, 0.14, 0.01, 0.04]}'

What this lesson shows:
 1. smooth() reads a mesh that can be read several times, here a VsmReader; each step is a solve on
    scratch files within a memory limit. It returns the positions, which are read range by range.
 2. The surface sweeps no volume: what it loses at bumps, it gains by a motion along its normals.
 3. MovedMesh is the mesh stream with new positions and all its columns; a writer reads it block by
    block. The whole mesh is never in memory.

Run it:

    smoothing ../../Data/bunny.smb bunny-smooth.vsm

    34834 vertices, 6155 held: converged in 18 passes
      step 1: 5 cycles, relative residual 2.10109e-10
      step 2: 5 cycles, relative residual 4.20471e-10
*/

#include <smg/Convert.h>
#include <smg/MovedMesh.h>
#include <smg/Smooth.h>
#include <smg/WriteMesh.h>

#include <iostream>

namespace
{

smg::SmoothingDescription allButTheHead()
{
  smg::SmoothingDescription smoothing;
  smoothing.size = { 0.01, smg::SmoothingSize::Mesh }; // the unit of the bunny is 1 m
  smoothing.steps = 2;
  smoothing.hold = { smg::Region::Sphere{ { -0.07, 0.14, 0.01 }, 0.04 } };
  return smoothing;
}

void print(const smg::Report& report)
{
  std::cout << report.vertices << " vertices, " << report.prescribed
            << " held: " << (report.converged ? "converged" : "not converged") << " in "
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
  if (argc != 3)
  {
    std::cerr << "usage: smoothing MESH SMOOTH.vsm|.ply|.vtp\n";
    return 2;
  }
  try
  {
    // Any mesh file is converted to a mesh stream; a stream keeps its order.
    const auto mesh = smg::openMesh(argv[1]);
    const auto positions = smg::smooth(*mesh, allButTheHead(), { .memoryLimit = 128 * smg::MiB });
    print(positions->report());

    // Existing normals are recomputed.
    const smg::MovedMesh moved(*mesh, *positions, smg::MovedNormals::Recompute);
    for (const std::string& remark : smg::writeMesh(*moved.source(), argv[2]))
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
