// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SmoothTesting.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

#include <functional>

namespace smg::testing
{
namespace
{

std::string errorOf(const StreamMesh& mesh, const std::function<void(Smoothing&)>& change)
{
  Smoothing options;
  change(options);
  return messageOf([&] { smoothed(mesh, options); });
}

#define EXPECT_SAYS(text, part) EXPECT_PRED_FORMAT2(::testing::IsSubstring, part, text)

} // namespace

TEST(SmoothErrors, OptionsOutOfRange)
{
  const StreamMesh mesh = toStream(torus(9, 6));
  for (const double size : { 0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY) })
  {
    EXPECT_SAYS(errorOf(mesh, [=](auto& o) { o.size.value = size; }),
      "(option --size) must be a positive number");
  }
  for (const double size : { 1e-300, 1e-100, 1e-50, 1e200 })
  {
    EXPECT_SAYS(errorOf(mesh,
                  [=](auto& o) {
                    o.size = { size, SmoothingSize::Mesh };
                  }),
      "is too small or too large to compute with: choose one from ");
  }
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.steps = 0; }), "steps must be from 1 to 1000");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.keepEdges = 0.0; }), "between 0 and 180 degrees");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.tolerance = 2.0; }), "tolerance");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.operators = "shi2006"; }), "use extended");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.memoryLimit = 100000; }),
    "1 MiB (100000 bytes): raise the memory limit");
  EXPECT_SAYS(errorOf(mesh,
                [](auto& o) {
                  o.checkpoint = { "folder", "mesh", "problem" };
                }),
    "smoothing has no checkpoints");
}

TEST(SmoothErrors, ColumnsAndPartsThatTheMeshDoesNotHave)
{
  StreamMesh mesh = toStream(torus(9, 6));
  std::vector<double> values(static_cast<std::size_t>(mesh.vertices()), 1.0);
  std::vector<std::int64_t> large(values.size(), 1);
  large[3] = -(std::int64_t(1) << 53) - 1;
  values[4] = NAN;
  mesh.vertexColumns = { makeColumn<double>("v", values),
    makeColumn<std::int64_t>("large", large) };
  mesh.cellColumns = { makeColumn<double>(
    "c", std::vector<double>(static_cast<std::size_t>(mesh.cells()))) };
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.column = "w"; }),
    "smooth: column: the mesh has no column 'w'; its vertices have 'v', 'large', its cells 'c'");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.column = "c"; }), "is a column of the cells");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.column = "v"; }),
    "'v' is not a finite number at vertex 4 of the stream");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.column = "large"; }),
    "'large' has an integer of 2^53 or more, which double precision cannot hold exactly, at vertex "
    "3 of the stream");
  EXPECT_SAYS(errorOf(mesh,
                [](auto& o)
                {
                  o.column = "v";
                  o.keepEdges = 20.0;
                }),
    "name no column, or keep no edges");
  EXPECT_SAYS(errorOf(mesh,
                [](auto& o)
                {
                  o.column = "v";
                  o.boundary = SmoothedBoundary::Smooth;
                }),
    "fix it or leave it free");
  EXPECT_SAYS(errorOf(mesh,
                [](auto& o) {
                  o.hold = { Region::Sphere{ { 0, 0, 0 }, 9 }, Region::Sphere{ { 50, 0, 0 }, 1 } };
                }),
    "smooth: hold[1]: no vertex of the mesh is in this region");
  EXPECT_SAYS(errorOf(mesh, [](auto& o) { o.hold = { OnBoundary{} }; }), "the mesh is closed");
}

TEST(SmoothErrors, PositionsOfTetrahedra)
{
  EXPECT_SAYS(errorOf(toStream(tetBox(3, 3, 3)), [](auto&) {}), "name a column of the vertices");
}

TEST(SmoothErrors, EverythingHeldAndEmptyMeshesStayAsTheyAre)
{
  const StreamMesh mesh = toStream(torus(9, 6));
  Smoothing options;
  options.hold = { smg::Everywhere{} };
  const Solved result = smoothed(mesh, options);
  EXPECT_TRUE(sameBits(result.values, pointsOf(mesh)));
  EXPECT_TRUE(result.report.converged);
  EXPECT_EQ(smoothed(StreamMesh{}, {}).values.rows(), 0);
}

TEST(SmoothErrors, MeshesWithoutAnyAreaStayAsTheyAre)
{
  StreamMesh mesh = toStream(grid(5, 4));
  for (std::size_t k = 1; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k] = 0.0;
  }
  const std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()), DegenerateCell);
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  EXPECT_SAYS(
    errorOf(mesh, [](auto&) {}), "give the size of the details to smooth (option --size) in");
  Smoothing options = plainStep();
  options.keepEdges = 30.0;
  EXPECT_TRUE(sameBits(smoothed(mesh, options).values, pointsOf(mesh)));
}

TEST(SmoothErrors, EdgesOfMeshesWithSlivers)
{
  for (const double height : { 1e-3, 1e-7, 1e-12 })
  {
    const StreamMesh mesh = toStream(sliverChains(13, 13, height));
    Smoothing options;
    options.steps = 2;
    options.keepEdges = 10.0;
    const Solved result = smoothed(mesh, options);
    EXPECT_TRUE(result.values.allFinite());
    EXPECT_TRUE(result.report.converged) << height;
    // The flat lattice stays flat, and within its bounds.
    EXPECT_LT(result.values.col(2).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE(diagonalOf(result.values), diagonalOf(pointsOf(mesh)) + 1e-9);
  }
}

} // namespace smg::testing
