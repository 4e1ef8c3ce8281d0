// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Blend.h"

#include "Testing/Solver/BlendTesting.h"
#include "Testing/Solver/DirectBlend.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace smg::testing
{
namespace
{

StreamMesh bumpySurface()
{
  IndexedTestMesh mesh = shuffled(torus(48, 24, 0.2));
  return toStream(mesh);
}

StreamMesh solid()
{
  IndexedTestMesh mesh = shuffled(tetBox(9, 8, 7, 0.15));
  for (double& x : mesh.positions)
  {
    x = 0.5 * (x - 3.5);
  }
  return toStream(mesh);
}

StreamMesh patched(StreamMesh mesh)
{
  addColumn<std::int32_t>(mesh, "patch", { quarter });
  addColumn(mesh, "c", { recordedSignal, [](const double* p) { return quarter(p) * p[2]; } });
  return mesh;
}

SolveOptions tight()
{
  SolveOptions options;
  options.tolerance = 1e-10;
  options.coreNodes = 0;
  return options;
}

/** The largest difference over edges between vertices of different patches. */
double largestStep(const StreamMesh& mesh, const std::function<double(std::int64_t)>& value)
{
  double largest = 0.0;
  const int size = cornersOf(mesh.cellType);
  for (std::size_t c = 0; c < mesh.corners.size(); c += size)
  {
    for (int i = 0; i < size * size; ++i)
    {
      const std::int64_t a = mesh.corners[c + i / size], b = mesh.corners[c + i % size];
      const bool crosses = mesh.vertexColumns[0].value(a) != mesh.vertexColumns[0].value(b);
      largest = crosses ? std::max(largest, std::fabs(value(a) - value(b))) : largest;
    }
  }
  return largest;
}

} // namespace

TEST(Blend, EqualsADirectSolve)
{
  for (const StreamMesh& mesh : { patched(bumpySurface()), patched(solid()) })
  {
    for (const double anchor : { 0.0, 0.01, 30.0 })
    {
      BlendDescription description = blendOf({ "c" });
      description.anchor = anchor;
      const auto blended = blend(MemoryMesh(mesh), description, tight());
      EXPECT_TRUE(blended->report().converged);
      EXPECT_LT(relativeError(valuesOf(*blended), DirectBlend(mesh).solve(anchor)), 1e-7) << anchor;
    }
  }
}

TEST(Blend, AveragedGradientsRestoreALinearFunction)
{
  // Each patch has an offset of its own.
  const VertexFunction linear = [](const double* p)
  { return 2.0 * p[0] - 0.7 * p[1] + 0.3 * p[2]; };
  const VertexFunction recorded = [&](const double* p) { return linear(p) + 5.0 * quarter(p); };
  IndexedTestMesh plane = grid(30, 25);
  for (double& x : plane.positions)
  {
    x = 0.2 * (x - 12.0);
  }
  for (StreamMesh mesh : { toStream(shuffled(plane)), solid() })
  {
    addColumn<std::int32_t>(mesh, "patch", { quarter });
    addColumn(mesh, "c", { recorded, [&](const double* p) { return -3.0 * recorded(p); } });
    BlendDescription description = blendOf({ "c" });
    description.anchor = 0.0;
    for (const SeamGradient seam : { SeamGradient::Average, SeamGradient::Zero })
    {
      description.seam = seam;
      const Eigen::MatrixXd values = valuesOf(*blend(MemoryMesh(mesh, 70), description, tight()));
      Eigen::MatrixXd error(values.rows(), 2);
      for (Eigen::Index v = 0; v < values.rows(); ++v)
      {
        const double wanted = linear(&mesh.positions[3 * v]);
        error.row(v) << values(v, 0) - wanted, values(v, 1) + 3.0 * wanted;
      }
      const double spread =
        (error.colwise().maxCoeff() - error.colwise().minCoeff()).cwiseAbs().maxCoeff();
      EXPECT_TRUE(seam == SeamGradient::Average ? spread < 1e-5 : spread > 0.1) << spread;
    }
  }
}

TEST(Blend, AveragedGradientsAreThoseOfTheCellsAround)
{
  const StreamMesh mesh = patched(solid());
  BlendDescription description = blendOf({ "c" });
  description.seam = SeamGradient::Average;
  const auto blended = blend(MemoryMesh(mesh, 50), description, tight());
  EXPECT_LT(relativeError(valuesOf(*blended), DirectBlend(mesh).averaged().solve(0.01)), 1e-7);
  SolveOptions inCore = tight();
  inCore.inCore = true;
  EXPECT_TRUE(
    sameBits(valuesOf(*blend(MemoryMesh(mesh), description, inCore)), valuesOf(*blended)));
}

TEST(Blend, HeldPartsKeepTheirValues)
{
  const StreamMesh mesh = patched(bumpySurface());
  const auto isHeld = [](const ElementProblem::Point& p) { return p[0] >= 2.0 || p[1] <= -2.5; };
  BlendDescription description = blendOf({ "c" });
  description.anchor = 0.0;
  description.hold = { Region::HalfSpace{ { 1, 0, 0 }, 2.0 },
    Region::HalfSpace{ { 0, -1, 0 }, 2.5 } };
  const auto blended = blend(MemoryMesh(mesh), description, tight());
  const Eigen::MatrixXd values = valuesOf(*blended);
  EXPECT_LT(relativeError(values, DirectBlend(mesh).solve(0.0, isHeld)), 1e-7);
  std::int64_t held = 0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (isHeld(ElementProblem::Point::Map(&mesh.positions[3 * v])))
    {
      EXPECT_EQ(values(v, 0), mesh.vertexColumns[1].value(v, 0));
      ++held;
    }
  }
  EXPECT_EQ(blended->report().prescribed, held);
}

TEST(Blend, SeamsVanish)
{
  StreamMesh mesh = toStream(sphere(6));
  addColumn<std::int32_t>(mesh, "patch", { quarter });
  addColumn(mesh, "recorded", { recordedSignal });
  addColumn<float>(mesh, "offset", { quarter, [](const double* p) { return -3.0 * quarter(p); } });
  const auto blended = blend(MemoryMesh(mesh), blendOf({ "offset", "recorded" }));
  const Eigen::MatrixXd values = valuesOf(*blended);
  const std::vector<Report::Seam>& seams = blended->report().seams;
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_EQ(seams[0].column, "offset");
  EXPECT_EQ(seams[1].column, "recorded");
  EXPECT_EQ(seams[0].before, 9.0); // opposite patches meet at both ends of the axis
  EXPECT_EQ(seams[1].before,
    largestStep(mesh, [&](std::int64_t v) { return mesh.vertexColumns[1].value(v); }));
  EXPECT_EQ(seams[1].after, largestStep(mesh, [&](std::int64_t v) { return values(v, 2); }));
  for (const Report::Seam& seam : seams)
  {
    EXPECT_LE(seam.after, 0.02 * seam.before) << seam.column;
  }
  // Constants with offsets become one constant, their mean.
  const Eigen::VectorXd offset = values.col(0);
  EXPECT_LT(offset.maxCoeff() - offset.minCoeff(), 0.02 * 3.0);
}

TEST(Blend, WhatIsSmoothStays)
{
  // The other component has two patches without a step between them.
  StreamMesh mesh = toStream(disjointUnion(torus(60, 30), sphere(5), { 9, 0, 0 }));
  addColumn<std::uint16_t>(mesh, "patch", { [](const double* p) {
    return p[0] < 5 ? 7.0 : p[2] < 0.3 ? 1.0 : 2.0;
  } });
  addColumn(mesh, "c", { smoothSignal });
  const auto blended = blend(MemoryMesh(mesh), blendOf({ "c" }));
  const Eigen::MatrixXd values = valuesOf(*blended);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double before = mesh.vertexColumns[1].value(v);
    if (mesh.positions[3 * v] < 5)
    {
      EXPECT_EQ(values(v, 0), before);
    }
    else
    {
      EXPECT_NEAR(values(v, 0), before, 0.06);
    }
  }
}

TEST(Blend, WithoutSeamsNothingChanges)
{
  StreamMesh mesh = bumpySurface();
  addColumn<std::int8_t>(mesh, "patch", { [](const double*) { return -3.0; } });
  addColumn(mesh, "c", { smoothSignal });
  const auto blended = blend(MemoryMesh(mesh), blendOf({ "c" }));
  const Eigen::MatrixXd values = valuesOf(*blended);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    EXPECT_EQ(values(v, 0), mesh.vertexColumns[1].value(v));
  }
  ASSERT_FALSE(blended->report().notes.empty());
  EXPECT_TRUE(contains(blended->report().notes.back(), "No edge connects two patches"));
  EXPECT_EQ(blended->report().seams.at(0).after, 0.0);
}

TEST(Blend, SaysThatAColumnIsNoPatch)
{
  StreamMesh mesh = bumpySurface();
  addColumn(mesh, "height", { [](const double* p) { return p[2]; } });
  addColumn(mesh, "c", { smoothSignal });
  BlendDescription description = blendOf({ "c" });
  description.patch = "height";
  const auto blended = blend(MemoryMesh(mesh), description);
  ASSERT_FALSE(blended->report().notes.empty());
  EXPECT_TRUE(contains(blended->report().notes.back(), "cells lie between patches"));
}

TEST(Blend, LabelsOfCellsLeaveTheVerticesBetweenThemWithoutPatch)
{
  StreamMesh mesh = solid();
  const std::int64_t vertices = mesh.vertices();
  std::vector<double> cellLabels;
  std::vector<std::set<double>> around(vertices);
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const std::int64_t* corner = &mesh.corners[4 * c];
    cellLabels.push_back(quarter(&mesh.positions[3 * corner[0]]) - 0.5);
    std::for_each(corner, corner + 4, [&](std::int64_t v) { around[v].insert(cellLabels.back()); });
  }
  std::vector<float> labels;
  for (std::int64_t v = 0; v < vertices; ++v)
  {
    labels.push_back(static_cast<float>(
      around[v].size() == 1 ? *around[v].begin() : 1000.0 + static_cast<double>(v)));
  }
  StreamMesh byVertices = mesh;
  byVertices.vertexColumns.push_back(makeColumn<float>("patch", labels));
  addColumn(byVertices, "c", { recordedSignal });
  mesh.cellColumns.push_back(makeColumn<double>("patch", cellLabels));
  addColumn(mesh, "c", { recordedSignal });
  const auto expected = blend(MemoryMesh(byVertices), blendOf({ "c" }));
  const auto blended = blend(MemoryMesh(mesh, 17), blendOf({ "c" }));
  EXPECT_TRUE(sameBits(valuesOf(*blended), valuesOf(*expected)));
  EXPECT_EQ(blended->report().seams.at(0).before, expected->report().seams.at(0).before);
  EXPECT_EQ(blended->report().seams.at(0).after, expected->report().seams.at(0).after);
  EXPECT_GT(blended->report().seams.at(0).before, 1.0);
}

/** Rounding over so small an anchor would move the values. */
TEST(Blend, AnAnchorBelowRoundingIsNone)
{
  const StreamMesh mesh = patched(bumpySurface());
  BlendDescription description = blendOf({ "c" });
  description.anchor = 0.0;
  const Eigen::MatrixXd expected = valuesOf(*blend(MemoryMesh(mesh), description, tight()));
  for (const double anchor : { 9e-9, 1e-12, 1e-300 })
  {
    description.anchor = anchor;
    EXPECT_EQ(valuesOf(*blend(MemoryMesh(mesh), description, tight())), expected);
  }
  // The next larger one changes it by a little.
  description.anchor = 1e-8;
  const Eigen::MatrixXd near = valuesOf(*blend(MemoryMesh(mesh), description, tight()));
  EXPECT_LT((near - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.cwiseAbs().maxCoeff());
}

} // namespace smg::testing
