// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Blend.h"

#include "Testing/Solver/BlendTesting.h"
#include "Testing/Support/DirectElements.h"
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

/** The minimum itself, with the blended values as the unknowns, by finite elements in memory. */
class DirectBlend
{
public:
  explicit DirectBlend(const StreamMesh& mesh)
    : Mesh(mesh)
    , System(mesh)
  {
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      this->VertexAt[key(this->System.vertex(v))] = v;
    }
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      this->CellAt[key(this->System.centroid(c))] = c;
    }
  }

  Eigen::MatrixXd solve(double anchor, const ElementProblem::Where& held = {})
  {
    const auto points =
      Eigen::Map<const Eigen::Matrix3Xd>(this->Mesh.positions.data(), 3, this->Mesh.vertices());
    const double screening =
      anchor / (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).squaredNorm();
    const auto value = [this](const Point& p) { return this->values(this->VertexAt.at(key(p))); };
    this->System.Columns = this->Mesh.vertexColumns[1].spec.components;
    this->System.VertexScreening = [=](const Point&) { return screening; };
    this->System.VertexSource = [=](const Point& p) -> Eigen::VectorXd
    { return screening * value(p); };
    this->System.Initial = value;
    this->System.CellField = [this](const Point& p)
    { return this->field(this->CellAt.at(key(p))); };
    if (held)
    {
      this->System.DirichletConditions = { { held, value } };
    }
    return DirectElements(this->System).solve();
  }

private:
  using Point = ElementProblem::Point;
  using Key = std::array<double, 3>;
  static Key key(const Point& p) { return { p[0], p[1], p[2] }; }

  Eigen::VectorXd values(std::int64_t v) const
  {
    Eigen::VectorXd values(this->System.Columns);
    for (int k = 0; k < this->System.Columns; ++k)
    {
      values[k] = this->Mesh.vertexColumns[1].value(v, k);
    }
    return values;
  }

  /** The gradient of each column, by least squares, or 0. */
  Eigen::MatrixXd field(std::int64_t cell) const
  {
    const int size = cornersOf(this->Mesh.cellType);
    const std::int64_t* corner = &this->Mesh.corners[size * cell];
    Eigen::MatrixXd edges(size - 1, 3), steps(size - 1, this->System.Columns);
    bool inside = true;
    for (int j = 1; j < size; ++j)
    {
      edges.row(j - 1) = this->System.vertex(corner[j]) - this->System.vertex(corner[0]);
      steps.row(j - 1) = this->values(corner[j]) - this->values(corner[0]);
      inside = inside && this->Mesh.vertexColumns[0].value(corner[j]) ==
                           this->Mesh.vertexColumns[0].value(corner[0]);
    }
    // The smallest solution is that in the plane of a triangle.
    return edges.completeOrthogonalDecomposition().solve((inside ? 1.0 : 0.0) * steps);
  }

  const StreamMesh& Mesh;
  ElementProblem System;
  std::map<Key, std::int64_t> VertexAt, CellAt;
};

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

TEST(Blend, DoesNotDependOnBlocksThreadsAndMemory)
{
  const StreamMesh mesh = patched(bumpySurface());
  const auto expected = blend(MemoryMesh(mesh), blendOf({ "c" }));
  SolveOptions inCore;
  inCore.inCore = true;
  inCore.threads = 1;
  SolveOptions streamed;
  streamed.coreNodes = 0;
  streamed.blockNodes = 100;
  streamed.threads = 3;
  for (const SolveOptions& options : { inCore, streamed })
  {
    for (const std::int64_t cells : { 1, 77 })
    {
      const auto blended = blend(MemoryMesh(mesh, cells), blendOf({ "c" }), options);
      EXPECT_TRUE(sameBits(valuesOf(*blended), valuesOf(*expected)));
      EXPECT_LE(blended->report().pool_bytes_peak, options.memoryLimit);
    }
  }
}

TEST(Blend, ValuesAreReadInAnyRange)
{
  const StreamMesh mesh = patched(toStream(torus(80, 40)));
  const auto blended = blend(MemoryMesh(mesh), blendOf({ "c" }));
  const Eigen::MatrixXd all = valuesOf(*blended);
  for (const auto& [first, count] : { std::pair{ 3000, 200 }, { 1000, 1100 }, { 5, 0 }, { 0, 1 } })
  {
    std::vector<double> values(2 * static_cast<std::size_t>(count));
    blended->read(first, count, values);
    for (int i = 0; i < count; ++i)
    {
      EXPECT_EQ(values[2 * i], all(first + i, 0));
      EXPECT_EQ(values[2 * i + 1], all(first + i, 1));
    }
  }
}

} // namespace smg::testing
