// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/LevelWindow.h"
#include "Solver/Hierarchy/RowBatch.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * Rows of the finest level with their right-hand sides and initial values, which Assembly has made
 * and the level takes over between two steps.
 */
struct AssembledRows
{
  RowBatch rows;
  std::vector<double> x, b; ///< `columns` a row

  void moveTo(LevelRows& level, LevelWindow<double>& window, int columns)
  {
    std::int64_t i = level.end();
    this->rows.moveTo(level);
    window.extendState(level.end());
    const double* value = this->x.data();
    const double* side = this->b.data();
    for (; i < level.end(); ++i, value += columns, side += columns)
    {
      std::copy_n(value, columns, window.x().at(i));
      std::copy_n(side, columns, window.b().at(i));
    }
    this->x.clear();
    this->b.clear();
  }
};

} // namespace smg
