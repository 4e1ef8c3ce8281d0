// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/FreeComponents.h"

#include <cstdio>
#include <limits>

// The values of floating components are shifted when they are read, not on disk: a shift per
// component and column is all that is kept, and a vertex finds its own through its label.

namespace smg
{

void noteIncompatibility(Report& report, double share)
{
  constexpr double OfDiscretisation = 1e-3;
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", 100.0 * share);
  const std::string note =
    "the sources of a component without prescribed value do not sum to zero: their mean, " +
    std::string(text) + " % of their size, was taken from them";
  if (share > OfDiscretisation)
  {
    report.warn(note);
  }
  else
  {
    report.notes.push_back(note);
  }
}

void noteFreeComponents(Report& report)
{
  const std::string note =
    std::to_string(report.free_components) + " of " + std::to_string(report.components) +
    " components have no prescribed value: they keep the mean of their initial values";
  // If all components are free, as in a pure Neumann problem, this was meant.
  if (report.free_components < report.components)
  {
    report.warn(note);
    return;
  }
  report.notes.push_back(note);
}

/** Takes what is to be subtracted from the values. */
void FreeComponents::setShifts(std::vector<double> shifts)
{
  this->MeanShifts = std::move(shifts);
  for (std::size_t k = 0; k < std::min(this->MeanShifts.size(), this->Excess.size()); ++k)
  {
    this->MeanShifts[k] += this->Excess[k];
  }
}

void FreeComponents::prepare()
{
  this->setShifts(this->Parts.constantShifts());
}

void FreeComponents::complete(std::int64_t first, std::int64_t count, std::span<double> values)
{
  const auto columns = static_cast<std::size_t>(this->Columns);
  // Mostly there is nothing to do, and no label is read.
  const bool shifts = !this->MeanShifts.empty();
  const bool marks = this->Undetermined == UndeterminedValues::NotNumbers;
  for (std::int64_t i = 0; (shifts || marks) && i < count; ++i)
  {
    const std::int64_t vertex = first + i;
    // Labels are stored in blocks; consecutive vertices share one.
    const std::int32_t label =
      this->Labels.block(vertex / Block).labels[static_cast<std::size_t>(vertex % Block)];
    const auto of = values.subspan(static_cast<std::size_t>(i) * columns, columns);
    if (marks && label == ComponentLabels::Undetermined)
    {
      std::ranges::fill(of, std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t k = 0; label >= 0 && shifts && k < columns; ++k)
    {
      // Labels that were joined later lead to the root, which has the shift.
      of[k] -= this->MeanShifts[static_cast<std::size_t>(this->Parts.root(label)) * columns + k];
    }
  }
}

} // namespace smg
