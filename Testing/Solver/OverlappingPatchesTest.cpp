// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/OverlappingPatches.h"
#include "Testing/Solver/CycleTesting.h"

#include <gtest/gtest.h>

#include <numeric>

namespace smg::testing
{
namespace
{

/** Solids of random flat cells; weights of some of their rows cancel beyond the diagonal. */
std::vector<TestLevel> flatSolids()
{
  std::vector<TestLevel> levels;
  for (const double shift : { 0.33, 0.4, 0.45 })
  {
    levels.push_back(
      finestLevel(toStream(shuffled(tetBox(10, 9, 9, shift))), Weights::Cotangent, 29));
  }
  return levels;
}

std::vector<std::int64_t> membersOf(const OverlappingPatches::Patch& patch)
{
  std::vector<std::int64_t> members;
  for (int k = 0; k < patch.size; ++k)
  {
    members.push_back(patch.member(k));
  }
  return members;
}

/** The patches of a level in memory. */
struct OverlappedLevel
{
  OverlappedLevel(const TestLevel& level, int rings)
  {
    this->patches.setRings(rings);
    level.append(this->rows, 0, level.nodes());
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      this->patches.add(this->rows);
      this->overlapping.add();
    }
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      if (const Patch* core = this->patches.beginningAt(i))
      {
        this->overlapping.append(this->rows, *core, rings);
      }
    }
  }

  Pool pool{ 1 << 28 };
  LevelRows rows{ pool };
  Patches patches{ pool };
  OverlappingPatches overlapping{ pool };
};

} // namespace

/** Also while what no node needs any more is released. */
TEST(OverlappingPatches, AreTheWorstPatchesWithTheNodesThatAreCoupledMost)
{
  std::int64_t larger = 0, full = 0, together = 0;
  for (const TestLevel& level : flatSolids())
  {
    for (const int rings : { 1, 2 })
    {
      const auto expected = overlappingPatchesOf(level, rings);
      const Eigen::MatrixXd a = level.dense();
      std::vector<std::int64_t> last(static_cast<std::size_t>(level.nodes()));
      std::iota(last.begin(), last.end(), 0);
      OverlappedLevel made(level, rings);
      for (std::int64_t i = 0; i < level.nodes(); ++i)
      {
        PatchList found;
        made.overlapping.forEndingAt(i,
          [&](const OverlappingPatches::Patch& patch, const double* matrix)
          {
            found.push_back(membersOf(patch));
            const Eigen::MatrixXd part = partOf(a, found.back());
            for (int k = 0; k < patch.size; ++k)
            {
              for (int m = 0; m <= k; ++m)
              {
                EXPECT_NEAR(matrix[OverlappingPatches::Matrix::place(k, m)], part(k, m),
                  1e-12 * a.diagonal().maxCoeff());
              }
            }
          });
        ASSERT_EQ(found, expected[i]) << i;
        together += found.size() > 1 ? 1 : 0;
        for (const auto& members : found)
        {
          larger += members.size() > Patch::Most ? 1 : 0;
          full += members.size() == OverlappingPatches::Patch::Most ? 1 : 0;
          for (const std::int64_t member : members)
          {
            last[member] = std::max(last[member], i);
          }
        }
        made.overlapping.release(i);
      }
      const OverlappedLevel again(level, rings);
      for (std::int64_t i = 0; i < level.nodes(); ++i)
      {
        EXPECT_EQ(again.overlapping.last(i), last[i]);
      }
    }
  }
  EXPECT_GT(larger, 50);
  EXPECT_GT(full, 5);
  EXPECT_GT(together, 0);
}

TEST(OverlappingPatches, AreSolvedWhenTheSweepHasReachedTheirLastNode)
{
  for (const TestLevel& level : flatSolids())
  {
    for (const int columns : { 1, 3 })
    {
      for (const bool wide : { false, true })
      {
        DenseHierarchy<double> h(level, 2, columns, 2, wide, 2);
        const Eigen::MatrixXd b = randomMatrix(level.nodes(), columns, 1);
        setState(h.finest().window().b(), b);
        // The first sweep must take x as zero, independent of the memory.
        setState(h.finest().window().x(), randomMatrix(level.nodes(), columns, 7));
        h.finest().relaxDown();
        Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(level.nodes(), columns);
        denseSweep(h.matrix(0), h.patches(0), b, expected, h.overlapping());
        denseSweep(h.matrix(0), {}, b, expected);
        const double size = expected.cwiseAbs().maxCoeff();
        EXPECT_LT((stateOf(h.finest().window().x(), columns) - expected).cwiseAbs().maxCoeff(),
          1e-11 * size);

        setState(h.finest().window().x(), expected = randomMatrix(level.nodes(), columns, 2));
        h.finest().relaxUp();
        denseSweep(h.matrix(0), h.patches(0), b, expected, h.overlapping());
        denseSweep(h.matrix(0), {}, b, expected);
        EXPECT_LT((stateOf(h.finest().window().x(), columns) - expected).cwiseAbs().maxCoeff(),
          1e-11 * expected.cwiseAbs().maxCoeff());
      }
    }
  }
}

/** Sweeps up and back are adjoint in the energy: the V-cycle of a level in memory is symmetric. */
TEST(OverlappingPatches, SweepBackwardAsTheTranspose)
{
  const TestLevel level = flatSolids()[1];
  DenseHierarchy<double> h(level, 2, 1, 2, false, 2);
  Ring<double>& x = h.finest().window().x();
  const Eigen::MatrixXd f = randomMatrix(level.nodes(), 1, 3),
                        g = randomMatrix(level.nodes(), 1, 4);
  // From x = 0: down(f) = B f, and back(f) = B^T f.
  setState(h.finest().window().b(), f);
  h.finest().relaxDown();
  const Eigen::MatrixXd down = stateOf(x, 1);
  setState(h.finest().window().b(), g);
  setState(x, Eigen::MatrixXd::Zero(level.nodes(), 1));
  h.finest().relaxUpBackward();
  const double left = g.col(0).dot(down.col(0)), right = f.col(0).dot(stateOf(x, 1).col(0));
  EXPECT_NEAR(left, right, 1e-10 * down.norm() * g.norm());
}

} // namespace smg::testing
