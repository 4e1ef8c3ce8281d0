// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Padding.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Setup/RowBatch.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Rows of the finest level with their right-hand sides and initial values, which pass from
 * Assembly to the level between two steps. */
struct AssembledRows
{
  AssembledRows(Pool& pool, int columns)
    : rows(pool, 2 * columns * static_cast<std::int64_t>(sizeof(double)))
  {
  }

  RowBatch rows;
  std::vector<double> x, b; ///< `columns` per row
  /** The scale of the weights of the problem relative to finite elements with K = 1, at the first
   * weighted cell. */
  double weightScale = 1.0;

  void moveTo(LevelRows& level, LevelWindow<double>& window, int columns)
  {
    const std::int64_t begin = level.end();
    const bool isLarge = this->rows.isLarge();
    this->rows.moveTo(level);
    const std::int64_t end = level.end();
    window.extendState(end);
    pad(this->x.data(), columns, end - begin, window.x().at(begin));
    pad(this->b.data(), columns, end - begin, window.b().at(begin));
    this->x.clear();
    this->b.clear();
    if (isLarge)
    {
      this->x.shrink_to_fit();
      this->b.shrink_to_fit();
    }
  }
};

} // namespace smg
