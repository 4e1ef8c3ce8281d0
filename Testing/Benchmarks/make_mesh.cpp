// SPDX-License-Identifier: BSD-3-Clause
// make_mesh torus|box N OUT.vsm : writes a mesh of about N vertices to measure with: a jittered
// torus of triangles or a jittered box of tetrahedra, in breadth-first order.

#include "IO/Container/VsmWriter.h"
#include "Testing/Support/MemorySource.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <string>

int main(int argc, char** argv)
try
{
  CLI::App app("Makes a mesh to measure with.");
  std::string shape;
  double vertices = 0;
  std::string path;
  app.add_option("SHAPE", shape, "torus or box")
    ->required()
    ->check(CLI::IsMember({ "torus", "box" }));
  app.add_option("N", vertices, "Vertices")->required()->check(CLI::Range(1e2, 1e8));
  app.add_option("OUT", path, "A .vsm file")->required();
  CLI11_PARSE(app, argc, argv);

  using namespace smg::testing;
  // Twice as many around the torus as along its tube: its radii are 2 and 1.
  const int along = static_cast<int>(std::lround(std::sqrt(vertices / 2)));
  const int side = static_cast<int>(std::lround(std::cbrt(vertices)));
  MemorySource source(
    toStream(shape == "torus" ? torus(2 * along, along, 0.25) : tetBox(side, side, side, 0.15)));
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
