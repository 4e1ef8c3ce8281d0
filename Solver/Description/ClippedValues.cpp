// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Description/ClippedValues.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace smg
{

namespace
{

/** The range of what is rounded to numbers of a type: from `low` to before `end`. */
struct Range
{
  double low = -HUGE_VAL, end = HUGE_VAL;

  bool contains(double value) const { return value >= this->low && value < this->end; }
};

Range rangeOf(ScalarType type)
{
  return dispatch(type,
    []<class T>(T) -> Range
    {
      if constexpr (std::is_floating_point_v<T>)
      {
        return {};
      }
      else
      {
        // The largest number of a 64-bit type is not a double; the next one above it is.
        return { static_cast<double>(std::numeric_limits<T>::min()),
          std::ldexp(1.0, std::numeric_limits<T>::digits) };
      }
    });
}

} // namespace

void countClipped(Solution& solution, const std::vector<ColumnSpec>& columns, Report& report)
{
  std::vector<Range> ranges;
  for (const ColumnSpec& column : columns)
  {
    ranges.resize(
      ranges.size() + static_cast<std::size_t>(column.components), rangeOf(column.type));
  }
  report.clipped = 0;
  if (std::ranges::all_of(ranges, [](const Range& range) { return std::isinf(range.end); }))
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
