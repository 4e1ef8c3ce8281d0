// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComposeDescriptions.h"

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

/** Calls onWhere(where) and onValue(value) with all parts and values of a description. */
template <class OnWhere, class OnValue>
void visit(const ProblemDescription& problem, OnWhere onWhere, OnValue onValue)
{
  const auto visitAll = [&](const std::vector<PlacedValue>& entries)
  {
    for (const PlacedValue& entry : entries)
    {
      onWhere(entry.where);
      onValue(entry.value);
    }
  };
  for (const Datum* datum :
    { &problem.conductivity, &problem.screening, &problem.source, &problem.initial })
  {
    visitAll(datum->entries);
  }
  visitAll(problem.dirichlet);
  visitAll(problem.flux);
  for (const ProblemDescription::Robin& robin : problem.robin)
  {
    onWhere(robin.where);
    visitAll(robin.coefficient.entries);
    onValue(robin.ambient);
  }
  for (const ProblemDescription::Soft& soft : problem.soft)
  {
    onWhere(soft.where);
    visitAll(soft.weight.entries);
    onValue(soft.value);
  }
}

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
  std::set<std::string> names;
  if (!problem.field.empty())
  {
    names.insert(problem.field);
  }
  visit(
    problem,
    [&names](const Where& where)
    {
      if (const auto* tag = std::get_if<ColumnTag>(&where))
      {
        names.insert(tag->column);
      }
      if (const auto* mask = std::get_if<ColumnMask>(&where))
      {
        names.insert(mask->column);
      }
    },
    [&names](const DataValue& value)
    {
      if (value.column())
      {
        names.insert(*value.column());
      }
    });
  return names;
}

bool isPosed(const ProblemDescription& problem)
{
  return problem.source.isGiven() || !problem.field.empty() || !problem.dirichlet.empty() ||
         !problem.flux.empty() || !problem.robin.empty() || !problem.soft.empty() ||
         problem.initial.isGiven();
}

} // namespace smg
