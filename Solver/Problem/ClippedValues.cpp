// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ClippedValues.h"

#include "Solver/Core/Rounded.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{

void countClipped(Solution& solution, const std::vector<ColumnSpec>& columns, Report& report)
{
  std::vector<RoundedRange> ranges;
  for (const ColumnSpec& column : columns)
  {
    ranges.resize(ranges.size() + static_cast<std::size_t>(column.components),
      dispatch(column.type, []<class T>(T) { return RoundedRange::of<T>(); }));
  }
  report.clipped = 0;
  if (std::ranges::all_of(ranges, [](const RoundedRange& range) { return std::isinf(range.end); }))
  {
    return;
  }
  constexpr std::int64_t ChunkVertices = 1 << 14;
  std::vector<double> values;
  for (std::int64_t first = 0; first < solution.vertices(); first += ChunkVertices)
  {
    const std::int64_t count = std::min(ChunkVertices, solution.vertices() - first);
    values.resize(static_cast<std::size_t>(count) * ranges.size());
    solution.read(first, count, values);
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      report.clipped += ranges[k % ranges.size()].contains(std::nearbyint(values[k])) ? 0 : 1;
    }
  }
  if (report.clipped > 0)
  {
    report.notes.push_back(std::to_string(report.clipped) +
                           (report.clipped == 1 ? " value was" : " values were") +
                           " outside the range of the type of a column, and became the smallest "
                           "or largest number of it.");
  }
}

} // namespace smg
