// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolutionValues.h"

#include "smg/Error.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace smg
{

void readValues(Solution& solution, std::span<const std::int64_t> ids, std::span<double> values)
{
  // A gap this small is cheaper to read than to skip; the stretch length bounds the memory.
  constexpr std::int64_t gap = 256;
  constexpr std::int64_t stretch = 16384;
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (!std::is_sorted(ids.begin(), ids.end()))
  {
    std::sort(
      order.begin(), order.end(), [ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  }
  const std::int64_t columns = solution.columns();
  std::vector<double> rows;
  for (std::size_t begin = 0; begin < order.size();)
  {
    const std::int64_t first = ids[order[begin]];
    std::int64_t last = first;
    std::size_t end = begin;
    for (; end < order.size(); ++end)
    {
      const std::int64_t id = ids[order[end]];
      if (id > last + gap || id >= first + stretch)
      {
        break;
      }
      last = id;
    }
    if (first < 0 || last >= solution.vertices())
    {
      throw Error("The GlobalId " + std::to_string(first < 0 ? first : last) +
                  " is not one of the " + std::to_string(solution.vertices()) +
                  " vertices that were solved for: the input does not keep its GlobalIds.");
    }
    rows.resize((last + 1 - first) * columns);
    solution.read(first, last + 1 - first, rows);
    for (; begin < end; ++begin)
    {
      std::copy_n(rows.begin() + (ids[order[begin]] - first) * columns, columns,
        values.begin() + order[begin] * columns);
    }
  }
}

} // namespace smg
