// SPDX-License-Identifier: BSD-3-Clause
// make_mesh torus|scan|gyroid|box N OUT : writes a mesh of about N vertices to measure with: a
// jittered torus of triangles, one with bumps of several sizes as a scan has them, a noisy
// isosurface (see noisyGyroid()), or a jittered box of tetrahedra.
//
// make_mesh finer MESH TIMES OUT : refines the mesh of a file (PLY, OBJ, OFF, STL, Medit, Gmsh or
// VTK): every triangle becomes four, every tetrahedron eight, TIMES times. Each triangle made takes
// about 60 bytes of memory, but none in an OUT.ply with --shuffle and without noise.
//
// --noise A moves every vertex along its normal, by up to A mean edges to either side.
//
// OUT.vsm is in breadth-first order. OUT.ply (triangles) and OUT.vtk (tetrahedra), both binary, are
// in the order that the mesh is made in, or with --shuffle in a random one, the worst case for a
// conversion.

#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/Benchmarks/FinerTetrahedra.h"
#include "Testing/Benchmarks/IndexedFile.h"
#include "Testing/Benchmarks/SplitTriangles.h"
#include "Testing/Support/Bumps.h"
#include "Testing/Support/Isosurface.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/Refinement.h"
#include "smg/Error.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

namespace
{

using namespace smg::testing;

/** Twice as many vertices around the torus as along its tube, since its radii are 2 and 1. */
IndexedTestMesh jitteredTorus(double vertices)
{
  const int along = static_cast<int>(std::lround(std::sqrt(vertices / 2)));
  return torus(2 * along, along, 0.25);
}

/** Bumps of a third of the edge length of each of three refinements. */
IndexedTestMesh scan(double vertices)
{
  IndexedTestMesh mesh = bumpy(jitteredTorus(vertices / 16), 0.3, 1);
  for (const std::uint64_t seed : { 2, 3 })
  {
    mesh = bumpy(refined(mesh), 0.3, seed);
  }
  return mesh;
}

IndexedTestMesh isosurface(double vertices)
{
  constexpr double VerticesOfOne = 41.5; // about so many times the square of the samples an axis
  return noisyGyroid(static_cast<int>(std::lround(std::sqrt(vertices / VerticesOfOne))), 0.02);
}

IndexedTestMesh jitteredBox(double vertices)
{
  const int side = static_cast<int>(std::lround(std::cbrt(vertices)));
  return tetBox(side, side, side, 0.15);
}

IndexedTestMesh finer(const std::string& path, int times)
{
  IndexedTestMesh mesh = smg::benchmark::readIndexed(path);
  for (int i = 0; i < times; ++i)
  {
    mesh = mesh.cellType == smg::CellType::Triangle ? refined(mesh)
                                                    : smg::benchmark::finerTetrahedra(mesh);
  }
  return mesh;
}

struct Options
{
  double vertices = 0;
  std::string mesh, out;
  int times = 0;
  bool isShuffled = false;
  double noise = 0;
  std::uint64_t seed = 1;

  /** Whether the result may be written without being made in memory. */
  bool isStreamed(const std::string& shape) const
  {
    return shape == "finer" && this->isShuffled && this->noise == 0 && this->out.ends_with(".ply");
  }

  IndexedTestMesh made(const std::string& shape) const
  {
    IndexedTestMesh mesh = this->smooth(shape);
    return this->noise > 0 ? bumpy(mesh, this->noise, this->seed) : std::move(mesh);
  }

private:
  IndexedTestMesh smooth(const std::string& shape) const
  {
    return shape == "torus"    ? jitteredTorus(this->vertices)
           : shape == "scan"   ? scan(this->vertices)
           : shape == "gyroid" ? isosurface(this->vertices)
           : shape == "box"    ? jitteredBox(this->vertices)
                               : finer(this->mesh, this->times);
  }
};

void writeStream(const IndexedTestMesh& mesh, const std::string& path)
{
  MemorySource source(toStream(mesh));
  smg::VsmWriter writer(path, source.info());
  for (smg::MeshBlock block; source.next(block);)
  {
    writer.append(block);
  }
  std::cout << ", span " << writer.finish().span;
}

void write(const IndexedTestMesh& mesh, const Options& options)
{
  std::cout << options.out << ": " << mesh.vertices() << " vertices, " << mesh.cells() << " cells";
  if (options.out.ends_with(".vsm"))
  {
    writeStream(mesh, options.out);
  }
  else
  {
    smg::benchmark::writeIndexed(
      mesh, options.out, options.isShuffled ? std::optional(options.seed) : std::nullopt);
  }
  std::cout << '\n';
}

void addOptions(CLI::App& app, Options& options)
{
  for (const auto& [shape, what] :
    { std::pair("torus", "A jittered torus of triangles"),
      std::pair("scan", "A torus with bumps of several sizes"),
      std::pair("gyroid", "A noisy isosurface"), std::pair("box", "A jittered box of tetrahedra") })
  {
    app.add_subcommand(shape, what)
      ->add_option("N", options.vertices, "Vertices")
      ->required()
      ->check(CLI::Range(1e3, 1e8));
  }
  CLI::App* refinement = app.add_subcommand("finer", "The mesh of a file, refined");
  refinement->add_option("MESH", options.mesh, "Its file")->required()->check(CLI::ExistingFile);
  refinement->add_option("TIMES", options.times, "How often")->required()->check(CLI::Range(0, 10));
  for (CLI::App* shape : app.get_subcommands({}))
  {
    shape->add_option("OUT", options.out, "A .vsm, .ply or .vtk file")->required();
    shape->add_flag(
      "--shuffle", options.isShuffled, "Vertices and cells of a .ply or .vtk in a random order");
    shape->add_option("--seed", options.seed, "Of order and noise")->capture_default_str();
    shape
      ->add_option(
        "--noise", options.noise, "Mean edges by which vertices move along normals; triangles")
      ->check(CLI::Range(0.0, 10.0));
  }
  app.require_subcommand(1);
}

void writeFiner(const Options& options)
{
  const IndexedTestMesh mesh = smg::benchmark::readIndexed(options.mesh);
  if (mesh.cellType != smg::CellType::Triangle)
  {
    throw smg::Error(options.out + ": tetrahedra are written as .vtk.");
  }
  smg::benchmark::writeSplit(mesh, std::int64_t(1) << options.times, options.out, options.seed);
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Makes a mesh to measure with.");
  Options options;
  addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  if (options.isShuffled && options.out.ends_with(".vsm"))
  {
    throw smg::Error(options.out + ": a stream has its own order; shuffle a .ply or a .vtk.");
  }
  const std::string shape = app.get_subcommands().front()->get_name();
  options.isStreamed(shape) ? writeFiner(options) : write(options.made(shape), options);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "make_mesh: " << error.what() << '\n';
  return 1;
}
