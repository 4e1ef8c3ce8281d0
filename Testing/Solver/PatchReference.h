// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/HierarchyTesting.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace smg::testing
{

/** The nodes of the patch of each node, ascending, including itself. */
using PatchList = std::vector<std::vector<std::int64_t>>;

/** The patches of a level, directly from their definition. */
inline PatchList patchesOf(const TestLevel& level)
{
  const std::int64_t nodes = level.nodes();
  PatchList patches;
  std::vector<std::int64_t> patchOf, reach;
  for (std::int64_t j = 0; j < nodes; ++j)
  {
    double strongest = 0.5;
    std::int64_t partner = -1;
    reach.push_back(j > 0 ? std::max(j, reach[j - 1]) : j);
    for (std::size_t e = 0; e < level.rows[j].size(); ++e)
    {
      const std::int64_t i = j + level.rows[j][e].delta();
      reach[j] = std::max(reach[j], i);
      if (i > j)
      {
        continue;
      }
      const double coupling =
        std::fabs(level.rows[j][e].weight()) / std::sqrt(level.diagonal(i) * level.diagonal(j));
      const auto& patch = patches[patchOf[i]];
      const bool room = patch.size() == 1 || (patch.size() < 4 && reach[patch[0]] >= j);
      if (coupling > strongest && room)
      {
        strongest = coupling;
        partner = i;
      }
    }
    patchOf.push_back(partner < 0 ? static_cast<std::int64_t>(patches.size()) : patchOf[partner]);
    if (partner < 0)
    {
      patches.emplace_back();
    }
    patches[patchOf[j]].push_back(j);
  }
  PatchList ofNodes;
  for (const std::int64_t patch : patchOf)
  {
    ofNodes.push_back(patches[patch]);
  }
  return ofNodes;
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
