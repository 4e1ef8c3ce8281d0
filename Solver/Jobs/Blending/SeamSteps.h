// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Blending/PatchedValues.h"
#include "smg/Column.h"

#include <span>
#include <vector>

namespace smg
{

/** The largest difference of each column, over its components, between the ends of edges that are
 * not in one patch. */
class SeamSteps
{
public:
  /** The components of `columns`, one after the other, are the values of a vertex. */
  explicit SeamSteps(const std::vector<ColumnSpec>& columns);

  /** Takes the edges of a cell. */
  void add(std::span<const std::int64_t> corners, const PatchedValues& values);

  /** The number of edges between patches; an edge counts once for each of its cells. */
  std::int64_t edges() const { return this->Edges; }
  /** The number of cells that are not in one patch. */
  std::int64_t cells() const { return this->Cells; }
  /** One for each column; 0 without such edges. */
  std::vector<double> largest() const;

private:
  std::vector<int> Components; ///< of each column
  std::vector<double> Steps;   ///< of each component
  std::int64_t Edges = 0, Cells = 0;
};

} // namespace smg
