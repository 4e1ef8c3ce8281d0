// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/HierarchyTesting.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
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

/** Whether the magnitudes of the weights of row i sum to more than this multiple of its diagonal.
 */
inline bool cancels(const TestLevel& level, std::int64_t i, double least = 1.05)
{
  double terms = 0.0;
  for (const RowEntry& entry : level.rows[i])
  {
    terms += std::fabs(static_cast<double>(entry.weight()));
  }
  return terms > least * level.diagonal(i);
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

/** The overlapping patches of a level by their last members, directly from their definition: a list
 * for each node, in the order of descending first nodes. */
inline std::vector<PatchList> overlappingPatchesOf(const TestLevel& level, int rings)
{
  const std::vector<std::int64_t> reach = reachesOf(level);
  const PatchList patchOf = patchesOf(level, rings);
  std::vector<PatchList> endingAt(static_cast<std::size_t>(level.nodes()));
  for (std::int64_t first = level.nodes() - 1; first >= 0; --first)
  {
    const std::vector<std::int64_t>& core = patchOf[first];
    const bool isWorst = std::ranges::any_of(
      core, [&](std::int64_t i) { return cancels(level, i, OverlappingPatches::Cancelling); });
    if (core.size() == 1 || core.front() != first || !isWorst)
    {
      continue;
    }
    const std::int64_t last = rings > 1 ? reach[reach[first]] : reach[first];
    std::map<std::int64_t, double> couplings; // by node, negative
    for (const std::int64_t i : core)
    {
      for (const RowEntry& entry : level.rows[i])
      {
        const std::int64_t j = i + entry.delta();
        const double weight = entry.weight();
        if (j > first && j <= last && !std::ranges::binary_search(core, j))
        {
          couplings[j] =
            std::min(couplings[j], -weight * weight / (level.diagonal(i) * level.diagonal(j)));
        }
      }
    }
    std::vector<std::pair<double, std::int64_t>> strongest;
    for (const auto& [j, coupling] : couplings)
    {
      strongest.emplace_back(coupling, j);
    }
    std::ranges::sort(strongest);
    std::vector<std::int64_t> members = core;
    for (const auto& [coupling, j] : strongest)
    {
      if (members.size() < OverlappingPatches::Patch::Most)
      {
        members.push_back(j);
      }
    }
    std::ranges::sort(members);
    endingAt[members.back()].push_back(members);
  }
  return endingAt;
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
