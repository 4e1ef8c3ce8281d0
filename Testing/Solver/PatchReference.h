// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/HierarchyTesting.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace smg::testing
{

/** The nodes of the patch of each node, ascending, including itself. */
using PatchList = std::vector<std::vector<std::int64_t>>;

/** The last node in rows 0 .. i of a level, by i. */
inline std::vector<std::int64_t> reachesOf(const TestLevel& level)
{
  std::vector<std::int64_t> reach;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    reach.push_back(std::max(i, i > 0 ? reach.back() : 0));
    for (const RowEntry& entry : level.rows[i])
    {
      reach[i] = std::max(reach[i], i + entry.delta());
    }
  }
  return reach;
}

/** Whether the weights of row i cancel by 5 %. */
inline bool cancels(const TestLevel& level, std::int64_t i)
{
  double terms = 0.0;
  for (const RowEntry& entry : level.rows[i])
  {
    terms += std::fabs(static_cast<double>(entry.weight()));
  }
  return terms > 1.05 * level.diagonal(i);
}

/** The patches of a level, directly from their definition: within one or two rings. */
inline PatchList patchesOf(const TestLevel& level, int rings = 1)
{
  const std::vector<std::int64_t> reach = reachesOf(level);
  PatchList patchOf;
  for (std::int64_t j = 0; j < level.nodes(); ++j)
  {
    patchOf.push_back({ j });
    std::vector<std::pair<double, std::int64_t>> couplings;
    for (const RowEntry& entry : level.rows[j])
    {
      const std::int64_t i = j + entry.delta();
      const double coupling =
        std::fabs(entry.weight()) / std::sqrt(level.diagonal(i) * level.diagonal(j));
      if (i < j && (coupling > Patches::StrongAlone ||
                     (coupling > Patches::Strong && (cancels(level, i) || cancels(level, j)))))
      {
        couplings.emplace_back(-coupling, i);
      }
    }
    std::ranges::sort(couplings);
    for (const auto& [coupling, i] : couplings)
    {
      std::vector<std::int64_t> both;
      std::ranges::set_union(patchOf[i], patchOf[j], std::back_inserter(both));
      if (both.size() <= Patch::Most &&
          (reach[both.front()] >= j || (rings > 1 && reach[reach[both.front()]] >= j)))
      {
        for (const std::int64_t member : both)
        {
          patchOf[member] = both;
        }
      }
    }
  }
  return patchOf;
}

/** Rows and columns `nodes` of a matrix. */
inline Eigen::MatrixXd partOf(const Eigen::MatrixXd& a, const std::vector<std::int64_t>& nodes)
{
  return a(nodes, nodes);
}

/** Whether a pivot of the Cholesky factorisation is below `least` times its diagonal entry. */
inline bool nearlySingular(const Eigen::MatrixXd& a, double least)
{
  const Eigen::LLT<Eigen::MatrixXd> factor(a);
  if (factor.info() != Eigen::Success)
  {
    return true;
  }
  const Eigen::ArrayXd root = factor.matrixLLT().diagonal().array();
  return (root * root < least * a.diagonal().array()).any();
}

/** Levels with many patches: flat tetrahedra, obtuse triangles, rows of close vertices. */
inline std::vector<TestLevel> levelsWithPatches()
{
  IndexedTestMesh close = grid(30, 41, 0.3);
  for (std::size_t k = 1; k < close.positions.size(); k += 3)
  {
    close.positions[k] *= 0.2;
  }
  return { finestLevel(toStream(shuffled(tetBox(11, 10, 10, 0.33))), Weights::Cotangent, 29),
    finestLevel(toStream(shuffled(tetBox(9, 9, 9, 0.33))), Weights::Cotangent),
    finestLevel(toStream(sliverChains(35, 30, 1e-2)), Weights::Cotangent, 17),
    finestLevel(toStream(shuffled(close)), Weights::Clamped, 31) };
}

} // namespace smg::testing
