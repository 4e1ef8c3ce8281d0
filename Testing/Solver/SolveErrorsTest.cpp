// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/NotNumbers.h"
#include "Testing/Support/ScratchError.h"

#include <gtest/gtest.h>

#include <functional>

// Every failure is an Error with one sentence, and leaves no scratch file.

namespace smg::testing
{
namespace
{

/** The message of the Error of a solve. */
std::string errorOfSolve(MeshSource& source, Problem& problem, const SolveOptions& options = {})
{
  return scratchErrorOf(
    options, [&](const SolveOptions& scratch) { solve(source, problem, scratch); });
}

std::string errorOfSolve(const StreamMesh& mesh, Problem& problem, const SolveOptions& options = {})
{
  MemorySource source(mesh, 100);
  return errorOfSolve(source, problem, options);
}

std::string errorOfBlocks(std::vector<MeshBlock> blocks)
{
  BlockSource source(CellType::Triangle, std::move(blocks));
  ArrayProblem problem;
  return errorOfSolve(source, problem);
}

} // namespace

TEST(SolveErrors, NumbersThatAreNotFinite)
{
  const StreamMesh mesh = toStream(torus(30, 20));
  for (const double bad : { NotANumber, Infinite, -Infinite })
  {
    for (const std::int64_t vertex : { std::int64_t(0), std::int64_t(333), mesh.vertices() - 1 })
    {
      StreamMesh broken = mesh;
      broken.positions[3 * vertex + 1] = bad;
      ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
      EXPECT_TRUE(contains(errorOfSolve(broken, problem), "finite")) << vertex;
      ArrayProblem value = problem;
      value.Value[vertex] = bad;
      EXPECT_TRUE(contains(errorOfSolve(mesh, value), "finite"));
      ArrayProblem source = problem;
      source.Source.resize(mesh.vertices());
      source.Source[vertex] = bad;
      EXPECT_TRUE(contains(errorOfSolve(mesh, source), "finite"));
    }
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    problem.Target = [bad](const double* p, const double*, double* d)
    { d[0] = p[0] > 2 ? bad : 0.0; };
    EXPECT_TRUE(contains(errorOfSolve(mesh, problem), "finite"));
    problem.Target = {};
    problem.Screening = bad;
    EXPECT_TRUE(contains(errorOfSolve(mesh, problem), "screening"));
  }
}

TEST(SolveErrors, ConditionsOfAnotherSize)
{
  struct Resizing : ArrayProblem
  {
    std::vector<double> VertexConditions::*Which = nullptr;
    void conditions(const MeshBlock& block, VertexConditions& conditions) override
    {
      ArrayProblem::conditions(block, conditions);
      (conditions.*this->Which).push_back(0.0);
    }
  };
  const StreamMesh mesh = toStream(grid(4, 4));
  for (const auto which :
    { &VertexConditions::value, &VertexConditions::source, &VertexConditions::screening })
  {
    Resizing problem;
    problem.Which = which;
    EXPECT_NE(
      errorOfSolve(mesh, problem).find("changed the size of its conditions"), std::string::npos);
  }
}

TEST(SolveErrors, ConditionsThatAreNone)
{
  /** All vertices have the Dirichlet condition 3, which does not exist. */
  class Strange : public ArrayProblem
  {
  public:
    ConditionCounts conditionCounts() const override { return { 3, 0, 0 }; }
    void conditions(const MeshBlock& /*block*/, VertexConditions& conditions) override
    {
      std::ranges::fill(conditions.dirichlet, 3);
    }
  };
  Strange problem;
  EXPECT_TRUE(contains(errorOfSolve(toStream(torus(10, 10)), problem), "conditionCounts"));
}

TEST(SolveErrors, ValuesWhoseSquaresOverflow)
{
  const StreamMesh mesh = toStream(torus(30, 20));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  for (double& value : problem.Value)
  {
    value *= 1e300;
  }
  EXPECT_NE(errorOfSolve(mesh, problem), "");
}

TEST(SolveErrors, ValuesThatOverflowTheCoarseLevels)
{
  const StreamMesh mesh = toStream(torus(60, 40));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
  for (double& value : problem.Value)
  {
    value *= 1e40;
  }
  const std::string sentence = errorOfSolve(mesh, problem);
  EXPECT_TRUE(contains(sentence, "overflow")) << sentence;
  EXPECT_TRUE(contains(sentence, "scale the prescribed values")) << sentence;
}

TEST(SolveErrors, ValidBlocksAreNone)
{
  EXPECT_EQ(errorOfBlocks(twoBlocks()), "");
}

TEST(SolveErrors, AVertexUsedAfterItWasFinal)
{
  auto blocks = twoBlocks();
  blocks[0].finalized = 2;
  const std::string sentence = errorOfBlocks(blocks);
  EXPECT_TRUE(contains(sentence, "cell 1")) << sentence;
  EXPECT_TRUE(contains(sentence, "vertex 1")) << sentence;
  EXPECT_TRUE(contains(sentence, "final")) << sentence;
}

TEST(SolveErrors, ACornerOutOfRange)
{
  for (const std::int64_t corner : { std::int64_t(4), std::int64_t(-1), INT64_MAX, INT64_MIN })
  {
    auto blocks = twoBlocks();
    blocks[1].corners[2] = corner;
    const std::string sentence = errorOfBlocks(blocks);
    EXPECT_TRUE(contains(sentence, "cell 1")) << sentence;
    EXPECT_TRUE(contains(sentence, std::to_string(corner))) << sentence;
  }
  auto blocks = twoBlocks();
  blocks[0].corners[2] = 3;
  EXPECT_TRUE(contains(errorOfBlocks(blocks), "vertex 3"));
}

TEST(SolveErrors, BlocksThatDoNotFollowEachOther)
{
  auto blocks = twoBlocks();
  blocks[1].firstVertex = 5;
  EXPECT_TRUE(contains(errorOfBlocks(blocks), "5"));
  blocks = twoBlocks();
  blocks[1].finalized = 9;
  EXPECT_TRUE(contains(errorOfBlocks(blocks), "9"));
  blocks = twoBlocks();
  blocks[1].corners.pop_back();
  EXPECT_NE(errorOfBlocks(blocks), "");
  blocks = twoBlocks();
  blocks[1].positions.pop_back();
  EXPECT_NE(errorOfBlocks(blocks), "");
}

TEST(SolveErrors, FinalVerticesThatBecomeFewer)
{
  auto blocks = twoBlocks();
  blocks[0].finalized = 1;
  blocks[1].finalized = 0;
  EXPECT_TRUE(contains(errorOfBlocks(blocks), "does not decrease"));
}

TEST(SolveErrors, AMeshWithoutVertices)
{
  EXPECT_TRUE(contains(errorOfBlocks({}), "no vertices"));
}

TEST(SolveErrors, OptionsOutOfRange)
{
  const StreamMesh mesh = toStream(torus(10, 10));
  const std::vector<std::function<void(SolveOptions&)>> faults{
    [](SolveOptions& o) { o.operators = "none"; },
    [](SolveOptions& o) { o.sweeps = 0; },
    [](SolveOptions& o) { o.sweeps = 21; },
    [](SolveOptions& o) { o.tolerance = 0.0; },
    [](SolveOptions& o) { o.tolerance = 1.0; },
    [](SolveOptions& o) { o.tolerance = -1e-6; },
    [](SolveOptions& o) { o.tolerance = NotANumber; },
    [](SolveOptions& o) { o.maxCycles = 0; },
    [](SolveOptions& o) { o.memoryLimit = 0; },
    [](SolveOptions& o) { o.memoryLimit = -5; },
    [](SolveOptions& o) { o.threads = -1; },
    [](SolveOptions& o) { o.blockNodes = 0; },
    [](SolveOptions& o) { o.coreNodes = -1; },
  };
  for (std::size_t k = 0; k < faults.size(); ++k)
  {
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Uniform);
    SolveOptions options;
    faults[k](options);
    EXPECT_NE(errorOfSolve(mesh, problem, options), "") << "fault " << k;
  }
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Uniform);
  problem.Columns = 0;
  EXPECT_NE(errorOfSolve(mesh, problem), "");
  problem.Columns = 1;
  problem.Screening = -1.0;
  EXPECT_NE(errorOfSolve(mesh, problem), "");
}

} // namespace smg::testing
