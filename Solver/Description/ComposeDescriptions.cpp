// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Description/ComposeDescriptions.h"

#include <algorithm>

namespace smg
{
namespace
{

template <class T>
void append(std::vector<T>& entries, const std::vector<T>& more)
{
  entries.insert(entries.end(), more.begin(), more.end());
}

/** Collects the names of columns. */
struct NameCollector
{
  std::set<std::string> names;

  void add(const Where& where)
  {
    if (const auto* tag = std::get_if<ColumnTag>(&where))
    {
      this->names.insert(tag->column);
    }
    if (const auto* mask = std::get_if<ColumnMask>(&where))
    {
      this->names.insert(mask->column);
    }
  }
  void add(const DataValue& value)
  {
    if (value.column())
    {
      this->names.insert(*value.column());
    }
  }
  void add(const std::vector<PlacedValue>& entries)
  {
    for (const PlacedValue& entry : entries)
    {
      this->add(entry.where);
      this->add(entry.value);
    }
  }
};

} // namespace

void append(ProblemDescription& problem, const ProblemDescription& more)
{
  problem.weights = more.weights;
  problem.columns = std::max(problem.columns, more.columns);
  append(problem.conductivity.entries, more.conductivity.entries);
  append(problem.screening.entries, more.screening.entries);
  append(problem.source.entries, more.source.entries);
  problem.field = more.field.empty() ? problem.field : more.field;
  append(problem.initial.entries, more.initial.entries);
  append(problem.dirichlet, more.dirichlet);
  append(problem.flux, more.flux);
  append(problem.robin, more.robin);
  append(problem.soft, more.soft);
  problem.gradientOutput = problem.gradientOutput || more.gradientOutput;
  problem.fluxOutput = problem.fluxOutput || more.fluxOutput;
}

std::set<std::string> namedColumns(const ProblemDescription& problem)
{
  NameCollector collector;
  for (const Datum* datum :
    { &problem.conductivity, &problem.screening, &problem.source, &problem.initial })
  {
    collector.add(datum->entries);
  }
  if (!problem.field.empty())
  {
    collector.names.insert(problem.field);
  }
  collector.add(problem.dirichlet);
  collector.add(problem.flux);
  for (const ProblemDescription::Robin& robin : problem.robin)
  {
    collector.add(robin.where);
    collector.add(robin.coefficient.entries);
    collector.add(robin.ambient);
  }
  for (const ProblemDescription::Soft& soft : problem.soft)
  {
    collector.add(soft.where);
    collector.add(soft.weight.entries);
    collector.add(soft.value);
  }
  return collector.names;
}

bool isPosed(const ProblemDescription& problem)
{
  return problem.source.isGiven() || !problem.field.empty() || !problem.dirichlet.empty() ||
         !problem.flux.empty() || !problem.robin.empty() || !problem.soft.empty() ||
         problem.initial.isGiven();
}

} // namespace smg
