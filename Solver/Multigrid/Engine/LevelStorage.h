// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"
#include "smg/Report.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

/** Coarsening ends at a level of at most this many nodes, which is factorised. */
inline constexpr std::int64_t CoarsestNodes = 1000;

/** The levels of a multigrid hierarchy: the finest one in double, the others in single
 * precision, since they only precondition. */
struct LevelStorage
{
  std::unique_ptr<Level<double>> finest;
  std::vector<std::unique_ptr<Level<float>>> coarse; ///< level 1, 2, ...
  std::vector<Report::Level> sizes;
  std::int64_t frozen = 0; ///< LevelRows::frozen() of the coarse levels
};

} // namespace smg
