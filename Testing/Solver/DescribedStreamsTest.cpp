// SPDX-License-Identifier: BSD-3-Clause
// Described problems on streams of any blocks.
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/DescribedProblem.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

class DescribedStreams : public ::testing::Test
{
protected:
  StreamMesh Mesh = describedMesh();
  MemorySource Source{ Mesh };
};

} // namespace

TEST_F(DescribedStreams, TheSolutionDoesNotDependOnBlocksWithoutVertices)
{
  ProblemDescription description;
  description.conductivity = { { Everywhere{}, "k" }, { ColumnTag{ "tag", 3 }, "K" } };
  description.source = { { Everywhere{}, "k" } };
  description.screening = { { Everywhere{}, "k" } };
  description.field = "q";
  description.flux = { { Region::HalfSpace{ { 1, 0, 0 }, 1.5 }, "k" } };
  description.robin = { { Region::Box{ { -1, -1, -1 }, { 9, 9, 0.5 } }, "k", 1.0 } };
  description.dirichlet = { { ColumnMask{ "mask" }, 0.0 } };
  // Blocks of one cell mostly have no vertices, and two threads read each into another MeshBlock.
  const auto solved = [&](std::int64_t blockCells, int threads)
  {
    DescribedProblem problem(description, this->Source.info());
    this->Source.rewind(blockCells);
    problem.prepare(this->Source);
    this->Source.rewind(blockCells);
    SolveOptions options;
    options.threads = threads;
    options.tolerance = 1e-10;
    return solveMesh(this->Source, problem, options).values;
  };
  const Eigen::MatrixXd expected = solved(1000000, 1);
  for (const int threads : { 1, 2, 3 })
  {
    for (const std::int64_t blockCells : { 1, 3, 50 })
    {
      EXPECT_TRUE(sameBits(solved(blockCells, threads), expected))
        << threads << " threads, blocks of " << blockCells << " cells";
    }
  }
}

TEST_F(DescribedStreams, PreparingChecksTheStream)
{
  class Damaged : public MemorySource
  {
  public:
    using MemorySource::MemorySource;
    bool next(MeshBlock& block) override
    {
      const bool isBlock = this->MemorySource::next(block);
      if (isBlock && this->Blocks++ == 3)
      {
        this->damage(block);
      }
      return isBlock;
    }
    std::function<void(MeshBlock&)> damage;

  private:
    int Blocks = 0;
  };
  const std::vector<std::pair<std::function<void(MeshBlock&)>, std::string>> faults{
    { [](MeshBlock& block) { block.corners[0] = 1000000; }, "is not defined yet" },
    { [](MeshBlock& block) { block.corners[0] = -1; }, "was declared final" },
    { [](MeshBlock& block) { block.finalized = -5; }, "does not decrease" },
  };
  for (const Where& where :
    { Where(OnBoundary{}), Where(ColumnTag{ "tag", 3 }), Where(ColumnMask{ "mask" }) })
  {
    ProblemDescription description;
    description.dirichlet = { { where, 0.0 } };
    for (const auto& [damage, message] : faults)
    {
      DescribedProblem problem(description, this->Source.info());
      Damaged source(this->Mesh, 7);
      source.damage = damage;
      expectError([&] { problem.prepare(source); }, message);
    }
  }
}

TEST_F(DescribedStreams, TheNearestVertexIsTheFirstOfTheNearestOnes)
{
  // More vertices than are searched at once, on a lattice: many are equally near.
  const StreamMesh mesh = toStream(shuffled(tetBox(26, 25, 24)));
  Random random(3);
  NearestVertices nearest;
  std::set<std::int64_t> expected;
  for (int n = 0; n < 40; ++n)
  {
    std::array<double, 3> point{};
    std::ranges::generate(point, [&] { return 0.5 * static_cast<double>(random.below(56)) - 2; });
    nearest.points.push_back(point);
    const auto distance = [&](std::int64_t v)
    {
      const double* p = &mesh.positions[3 * v];
      return std::pow(p[0] - point[0], 2) + std::pow(p[1] - point[1], 2) +
             std::pow(p[2] - point[2], 2);
    };
    std::int64_t first = 0;
    for (std::int64_t v = 1; v < mesh.vertices(); ++v)
    {
      first = distance(v) < distance(first) ? v : first;
    }
    expected.insert(first);
  }
  ProblemDescription description;
  description.dirichlet = { { nearest, 1.0 } };
  for (const std::int64_t blockCells : { 1, 20000, 1000000 })
  {
    MemorySource source(mesh, blockCells);
    DescribedProblem problem(description, source.info());
    problem.prepare(source);
    source.rewind(777);
    const ProblemAnswers answers = answersOf(problem, source);
    std::set<std::int64_t> held;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      if (answers.vertices.dirichlet[static_cast<std::size_t>(v)] == 0)
      {
        held.insert(v);
      }
    }
    EXPECT_EQ(held, expected) << "blocks of " << blockCells << " cells";
  }
}

} // namespace smg::testing
