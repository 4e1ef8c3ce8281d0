// SPDX-License-Identifier: BSD-3-Clause
// make_mesh torus|scan|box N OUT.vsm : writes a mesh of about N vertices to measure with: a
// jittered torus of triangles, one with bumps of several sizes as a scan has them, or a jittered
// box of tetrahedra, in breadth-first order.

#include "IO/Container/VsmWriter.h"
#include "Testing/Support/Bumps.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/Refinement.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <string>

namespace
{

using namespace smg::testing;

/** Twice as many vertices around the torus as along its tube: its radii are 2 and 1. */
IndexedTestMesh jitteredTorus(double vertices)
{
  const int along = static_cast<int>(std::lround(std::sqrt(vertices / 2)));
  return torus(2 * along, along, 0.25);
}

/** Bumps as high as a third of the edges of each of three refinements. */
IndexedTestMesh scan(double vertices)
{
  IndexedTestMesh mesh = bumpy(jitteredTorus(vertices / 16), 0.3, 1);
  for (const std::uint64_t seed : { 2, 3 })
  {
    mesh = bumpy(refined(mesh), 0.3, seed);
  }
  return mesh;
}

IndexedTestMesh jitteredBox(double vertices)
{
  const int side = static_cast<int>(std::lround(std::cbrt(vertices)));
  return tetBox(side, side, side, 0.15);
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Makes a mesh to measure with.");
  std::string shape;
  double vertices = 0;
  std::string path;
  app.add_option("SHAPE", shape, "torus, scan or box")
    ->required()
    ->check(CLI::IsMember({ "torus", "scan", "box" }));
  app.add_option("N", vertices, "Vertices")->required()->check(CLI::Range(1e3, 1e8));
  app.add_option("OUT", path, "A .vsm file")->required();
  CLI11_PARSE(app, argc, argv);

  MemorySource source(toStream(shape == "torus"  ? jitteredTorus(vertices)
                               : shape == "scan" ? scan(vertices)
                                                 : jitteredBox(vertices)));
  smg::VsmWriter writer(path, source.info());
  for (smg::MeshBlock block; source.next(block);)
  {
    writer.append(block);
  }
  const smg::StreamInfo info = writer.finish();
  std::cout << path << ": " << info.vertices << " vertices, " << info.cells << " cells, span "
            << info.span << '\n';
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "make_mesh: " << error.what() << '\n';
  return 1;
}
