// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/NotNumbers.h"
#include "Testing/Support/ScratchError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

// Every failure is an Error with one sentence, and leaves no scratch file.

namespace smg::testing
{
namespace
{

/** The message of the Error of a deformation. */
std::string errorOfDeform(MeshSource& source, Handles& handles, const DeformOptions& options = {})
{
  return scratchErrorOf(
    options, [&](const DeformOptions& scratch) { deform(source, handles, scratch); });
}

std::string errorOfDeform(
  const StreamMesh& mesh, Handles& handles, const DeformOptions& options = {})
{
  MemorySource source(mesh, 100);
  return errorOfDeform(source, handles, options);
}

StreamMesh testMesh()
{
  return toStream(torus(60, 30, 0.3));
}

/** Some held vertex other than the first. */
std::int64_t heldVertex(const ArrayHandles& handles)
{
  const auto& mask = handles.Values.mask;
  return std::find_if(mask.begin() + mask.size() / 2, mask.end(), [](auto m) { return m > 0; }) -
         mask.begin();
}

} // namespace

TEST(DeformationErrors, NothingHeld)
{
  const StreamMesh mesh = testMesh();
  ArrayHandles handles(mesh.vertices());
  for (const bool core : { false, true })
  {
    DeformOptions options = withCycles(2);
    options.inCore = core;
    EXPECT_TRUE(contains(errorOfDeform(mesh, handles, options), "nothing to deform"))
      << errorOfDeform(mesh, handles, options);
  }
}

TEST(DeformationErrors, NumbersThatAreNotFiniteAtAHeldVertex)
{
  const StreamMesh mesh = testMesh();
  const ArrayHandles good = figureHandles(mesh);
  const std::int64_t vertex = heldVertex(good);
  for (const double bad : { NotANumber, Infinite, -Infinite })
  {
    for (int entry = 0; entry < 7; ++entry)
    {
      ArrayHandles handles = good;
      VertexHandles& values = handles.Values;
      (entry < 3    ? values.target[3 * vertex + entry]
        : entry < 6 ? values.rotation[3 * vertex + entry - 3]
                    : values.logScale[vertex]) = bad;
      const std::string sentence = errorOfDeform(mesh, handles, withCycles(2));
      EXPECT_TRUE(contains(sentence, "finite")) << entry << ": " << sentence;
      EXPECT_TRUE(contains(sentence, std::to_string(vertex))) << entry << ": " << sentence;
    }
  }
}

TEST(DeformationErrors, WhatIsSaidOfFreeVerticesIsNotLookedAt)
{
  const StreamMesh mesh = testMesh();
  ArrayHandles handles = figureHandles(mesh);
  const Solved expected = deformMesh(mesh, handles, withCycles(2));
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (handles.Values.mask[v] == 0)
    {
      handles.Values.logScale[v] = NotANumber;
      handles.Values.target[3 * v] = Infinite;
      handles.Values.rotation[3 * v + 1] = NotANumber;
    }
  }
  EXPECT_TRUE(sameBits(deformMesh(mesh, handles, withCycles(2)).values, expected.values));
}

TEST(DeformationErrors, ScalesBeyondReason)
{
  const StreamMesh mesh = testMesh();
  ArrayHandles handles = figureHandles(mesh);
  for (const double logScale : { 47.0, -50.0, 100.0, 300.0, 1e4 })
  {
    std::fill(handles.Values.logScale.begin(), handles.Values.logScale.end(), logScale);
    EXPECT_TRUE(contains(errorOfDeform(mesh, handles, withCycles(2)), "scale")) << logScale;
  }
}

TEST(DeformationErrors, TargetsBeyondReason)
{
  const StreamMesh mesh = testMesh();
  ArrayHandles handles = figureHandles(mesh);
  for (double& target : handles.Values.target)
  {
    target *= 1e200;
  }
  EXPECT_TRUE(contains(errorOfDeform(mesh, handles, withCycles(2)), "range of numbers"));
}

TEST(DeformationErrors, OptionsOutOfRange)
{
  const StreamMesh mesh = testMesh();
  const std::vector<std::function<void(DeformOptions&)>> faults{
    [](DeformOptions& o) { o.cycles = -1; },
    [](DeformOptions& o) { o.cycles = std::numeric_limits<int>::min(); },
    [](DeformOptions& o) { o.operators = "none"; },
    [](DeformOptions& o) { o.sweeps = 0; },
    [](DeformOptions& o) { o.tolerance = 0.0; },
    [](DeformOptions& o) { o.tolerance = NotANumber; },
    [](DeformOptions& o) { o.maxCycles = 0; },
    [](DeformOptions& o) { o.memoryLimit = 0; },
    [](DeformOptions& o) { o.threads = -1; },
    [](DeformOptions& o) { o.blockNodes = 0; },
    [](DeformOptions& o) { o.coreNodes = -1; },
  };
  ArrayHandles handles = figureHandles(mesh);
  for (std::size_t k = 0; k < faults.size(); ++k)
  {
    DeformOptions options;
    faults[k](options);
    EXPECT_NE(messageOf([&] { checkOptions(options); }), "") << "fault " << k;
    EXPECT_NE(errorOfDeform(mesh, handles, options), "") << "fault " << k;
  }
  EXPECT_EQ(messageOf([] { checkOptions(DeformOptions()); }), "");
}

TEST(DeformationErrors, OfTheHandlesPassThrough)
{
  /** Handles that fail in the middle of the mesh. */
  class Failing : public ArrayHandles
  {
  public:
    using ArrayHandles::ArrayHandles;
    void at(const MeshBlock& block, VertexHandles& handles) override
    {
      if (block.firstVertex > 900)
      {
        throw Error("the handles end");
      }
      ArrayHandles::at(block, handles);
    }
  };
  const StreamMesh mesh = testMesh();
  Failing handles(mesh.vertices());
  handles.Values = figureHandles(mesh).Values;
  EXPECT_EQ(errorOfDeform(mesh, handles), "the handles end");
}

TEST(DeformationErrors, HandlesOfAnotherSize)
{
  /** Handles that change the number of entries and hold all vertices. */
  class Resizing : public Handles
  {
  public:
    explicit Resizing(std::size_t size)
      : Size(size)
    {
    }
    void at(const MeshBlock&, VertexHandles& handles) override
    {
      handles.clear(this->Size);
      std::fill(handles.mask.begin(), handles.mask.end(), 1);
    }

  private:
    std::size_t Size;
  };
  const StreamMesh mesh = testMesh();
  for (const std::size_t size : { 0, 1, 100000 })
  {
    Resizing handles(size);
    EXPECT_TRUE(
      contains(errorOfDeform(mesh, handles), "handles of " + std::to_string(size) + " vertices"));
  }
}

} // namespace smg::testing
