// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/BlendTesting.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

StreamMesh meshOfErrors()
{
  StreamMesh mesh = toStream(grid(9, 8));
  addColumn<std::int32_t>(mesh, "patch", { quarter });
  addColumn(mesh, "c", { recordedSignal });
  addColumn(mesh, "wide", std::vector<VertexFunction>(60, smoothSignal));
  addColumn(mesh, "rest", std::vector<VertexFunction>(4, smoothSignal));
  addColumn<float>(mesh, "nan", { [](const double* p) { return p[0] > 3 ? NAN : 1.0F; } });
  addColumn<std::int64_t>(mesh, "large", { [](const double*) { return 9007199254740992.0; } });
  addColumn<std::int64_t>(mesh, OriginalIdName, { [](const double*) { return 5.0; } });
  mesh.cellColumns.push_back(makeColumn<double>(
    "ofCells", std::vector<double>(static_cast<std::size_t>(mesh.cells()), NAN)));
  return mesh;
}

std::string blendErrorOf(const BlendDescription& description, const SolveOptions& options = {})
{
  return messageOf([&] { blend(MemoryMesh(meshOfErrors()), description, options); });
}

} // namespace

TEST(BlendErrors, OfTheDescription)
{
  EXPECT_EQ(blendErrorOf(blendOf({ "c" })), "");
  const auto expect = [](const std::vector<std::string>& columns, const std::string& part) {
    EXPECT_TRUE(contains(blendErrorOf(blendOf(columns)), part)) << blendErrorOf(blendOf(columns));
  };
  expect({}, "blend: columns: must name at least one column");
  expect({ "b" }, "columns: the mesh has no column 'b'; its vertices have 'patch', 'c'");
  expect({ "ofCells" }, "'ofCells' is a column of the cells");
  expect({ "c", "c" }, "name 'c' twice");
  expect({ "patch" }, "'patch' numbers the patches");
  expect({ OriginalIdName }, "numbers the vertices");
  expect({ "wide", "c", "rest" }, "have 65 components together; at most 64");
  BlendDescription description = blendOf({ "wide", "rest" });
  EXPECT_EQ(blendErrorOf(description), "");
  for (const double anchor : { -1.0, static_cast<double>(NAN), HUGE_VAL })
  {
    description.anchor = anchor;
    EXPECT_TRUE(
      contains(blendErrorOf(description), "anchor: must be a finite number of at least 0"));
  }
  description = blendOf({ "c" });
  description.hold = { Everywhere{}, Region::Sphere{ { 99, 0, 0 }, 1 } };
  EXPECT_TRUE(
    contains(blendErrorOf(description), "hold[1]: no vertex of the mesh is in this region"));
}

TEST(BlendErrors, OfPatchesAndValues)
{
  const auto patchError = [](const std::string& name)
  {
    BlendDescription description = blendOf({ "c" });
    description.patch = name;
    return blendErrorOf(description);
  };
  EXPECT_TRUE(contains(patchError("none"), "patch: the mesh has no column 'none'"));
  EXPECT_TRUE(contains(patchError("wide"), "has 60 components, but must have one"));
  EXPECT_TRUE(contains(patchError("nan"), "'nan' is not a number at vertex 5 of the original mesh"))
    << patchError("nan");
  EXPECT_TRUE(contains(patchError("ofCells"), "'ofCells' is not a number in cell 0"));
  EXPECT_TRUE(contains(patchError("large"), "has an integer of 2^53 or more at vertex 5"));
  EXPECT_TRUE(
    contains(blendErrorOf(blendOf({ "c", "nan" })), "'nan' is not a finite number at vertex 5"));
  EXPECT_TRUE(
    contains(blendErrorOf(blendOf({ "large" })), "'large' has an integer of 2^53 or more"))
    << blendErrorOf(blendOf({ "large" }));
}

TEST(BlendErrors, AMeshWithoutExtentStays)
{
  StreamMesh point;
  point.positions.assign(12, 0.5);
  point.corners = { 0, 1, 2, 1, 2, 3 };
  addColumn(point, "patch", { [n = 0](const double*) mutable { return n++ / 2; } });
  addColumn(point, "c", { [n = 0](const double*) mutable { return 5.0 * n++; } });
  const auto blended = blend(MemoryMesh(point), blendOf({ "c" }));
  std::vector<double> values(4);
  blended->read(0, 4, values);
  EXPECT_EQ(values, (std::vector<double>{ 0, 5, 10, 15 }));
  EXPECT_EQ(blended->report().seams.at(0).after, 10.0);
}

TEST(BlendErrors, OfTheMemoryLimit)
{
  // What the errors name includes what the blend itself holds.
  StreamMesh mesh = toStream(torus(200, 60));
  addColumn<std::int32_t>(mesh, "patch", { quarter });
  addColumn(mesh, "wide", std::vector<VertexFunction>(40, smoothSignal));
  SolveOptions options;
  options.coreNodes = 0;
  const auto message = [&]
  { return messageOf([&] { blend(MemoryMesh(mesh), blendOf({ "wide" }), options); }); };
  int errors = 0;
  for (options.memoryLimit = 1 << 14; !message().empty(); options.memoryLimit *= 2, ++errors)
  {
    const std::string text = message();
    EXPECT_TRUE(contains(text, " MiB (" + std::to_string(options.memoryLimit) + " bytes): raise"))
      << text;
    const std::size_t bytes = text.find_first_of("0123456789", text.find('('));
    EXPECT_GT(std::stoll(text.substr(bytes)), options.memoryLimit) << text;
    ASSERT_LT(errors, 30);
  }
  EXPECT_GT(errors, 5);
  options.memoryLimit = 1000;
  EXPECT_TRUE(contains(blendErrorOf(blendOf({ "c" }), options), "limit"));
  options.memoryLimit = 0;
  EXPECT_TRUE(contains(blendErrorOf(blendOf({ "c" }), options), "must be positive"));
}

} // namespace smg::testing
