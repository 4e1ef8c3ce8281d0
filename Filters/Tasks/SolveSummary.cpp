// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolveSummary.h"

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <vector>

namespace smg
{

SolveSummary SolveSummary::of(const Report& report, int columns)
{
  SolveSummary summary;
  summary.report = report.json();
  for (const std::string& note : report.notes)
  {
    summary.notes += (summary.notes.empty() ? "" : "\n") + note;
  }
  summary.facts = report;
  summary.columns = columns;
  return summary;
}

SolveSummary SolveSummary::failed(const std::string& sentence)
{
  SolveSummary summary;
  summary.error = sentence;
  return summary;
}

std::string SolveSummary::outcome() const
{
  if (this->isCancelled)
  {
    return "Cancelled.";
  }
  if (!this->error.empty())
  {
    return "Failed: " + this->error;
  }
  if (this->report.empty())
  {
    return "";
  }
  const Report& r = this->facts;
  std::ostringstream text;
  const std::string place = this->where();
  text << place << (place.empty() ? "" : " ") << (r.converged ? "Converged" : "Not converged");
  if (r.cycles > 0)
  {
    text << " after "
         << (r.distributed ? counted(r.cycles, "iteration", "iterations")
                           : counted(r.cycles, "V-cycle", "V-cycles"));
  }
  text << (r.distributed ? " on " + counted(r.distributed->processes, "process, ", "processes, ")
                         : " in " + counted(r.passes, "pass, ", "passes, "));
  if (r.cycles > 0)
  {
    text << r.residualText() << ", ";
  }
  text << std::fixed << std::setprecision(1) << static_cast<double>(r.pool_bytes_peak) / MiB
       << " MiB of memory";
  return text.str();
}

std::string SolveSummary::where(char gap) const
{
  if (this->fullPoints == 0 || !this->error.empty())
  {
    return "";
  }
  if (this->previewPoints == 0)
  {
    return "On the full mesh of " + groupedDigits(this->fullPoints) + " points.";
  }
  return "On the preview only: " + groupedDigits(this->previewPoints) + " of " +
         groupedDigits(this->fullPoints) + " points" +
         (this->previewError.empty() ? "." : std::string(",") + gap + this->previewError);
}

std::string noteOnLoose(std::int64_t points, bool isSurface)
{
  return counted(points, "point is a corner", "points are corners") + " of no " +
         (isSurface ? "triangle or polygon" : "tetrahedron or other solid cell");
}

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
