// SPDX-License-Identifier: BSD-3-Clause
/*
Distances along the surface of the Stanford bunny from the tip of an ear, out of core, in C++
without VTK.

The same from the command line is

    smg distance bunny.smb bunny-distance.vsm --from '{"nearest": [[-0.0175, 0.187, -0.02]]}'

What this lesson shows:
 1. DistanceDescription says from what the distance is: any part of a mesh that a problem or a
    handle can name. Here it is the vertex nearest to a point.
 2. distance() marches a front through a window of the mesh, on scratch files within a memory limit.
    It returns the columns of distanceColumns(), which are read range by range.
 3. ReplacedColumns is the mesh stream with these columns; a writer reads it block by block. The
    whole mesh is never in memory.

Run it:

    distances ../../Data/bunny.smb bunny-distance.vsm

    34834 vertices: settled in 1 pass
      the largest distance is 0.237836 m, the mean 0.142573 m
*/

#include <smg/Convert.h>
#include <smg/Distance.h>
#include <smg/SolvedMesh.h>
#include <smg/WriteMesh.h>

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: distances BUNNY DISTANCE.vsm|.ply|.vtp\n";
    return 2;
  }
  try
  {
    const auto mesh = smg::openMesh(argv[1]);

    smg::DistanceDescription description;
    description.from = { smg::NearestVertices{ { { -0.0175, 0.187, -0.02 } } } };
    smg::DistanceOptions options;
    options.memoryLimit = std::int64_t(128) << 20;
    const auto distances = smg::distance(*mesh, description, options);

    const smg::Report& report = distances->report();
    std::cout << report.vertices << " vertices: " << (report.converged ? "settled" : "not settled")
              << " in " << report.passes << (report.passes == 1 ? " pass" : " passes")
              << "\n  the largest distance is " << report.distance->maximum << " m, the mean "
              << report.distance->mean << " m\n";

    smg::ReplacedColumns result(mesh->reader(), *distances, smg::distanceColumns(description));
    for (const std::string& remark : smg::writeMesh(result, argv[2]))
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
