// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComposeDescriptions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

// Operations on descriptions as a whole: composing them from several sources (the conditions of a
// pipeline, a file), listing the columns that they name, and a text that identifies them. Each must
// know every member of ProblemDescription; visit() goes through all parts and values.

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

/** Entries are appended, so that by the rule of precedence those of `more` win where both apply. */
void append(ProblemDescription& problem, const ProblemDescription& more)
{
  problem.weights = more.weights;
  // Usually equal; if they are not, the values of one description have the wrong number of
  // components, which the check against the mesh reports.
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

/** Both values and places may name columns; the field always does. */
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
      // Regions, points and the boundary name no columns.
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

/** An initial value alone poses a problem: without conditions, it determines the mean of the
 * solution. */
bool isPosed(const ProblemDescription& problem)
{
  return problem.source.isGiven() || !problem.field.empty() || !problem.dirichlet.empty() ||
         !problem.flux.empty() || !problem.robin.empty() || !problem.soft.empty() ||
         problem.initial.isGiven();
}

namespace
{

/** Makes a text of values from which they could be read again, so that different descriptions have
 * different texts: variants begin with the index of their type, lists and names with their size,
 * and 17 digits determine a double. */
class TextBuilder
{
public:
  template <class... Values>
  void operator()(const Values&... values)
  {
    (this->add(values), ...);
  }
  std::string take() { return std::move(this->Text); }

private:
  void add(std::int64_t number) { this->Text += std::to_string(number) + ' '; }
  void add(double number)
  {
    char digits[32];
    // Enough digits to tell any two doubles apart.
    std::snprintf(digits, sizeof(digits), "%.17g ", number);
    this->Text += digits;
  }
  void add(const std::string& name)
  {
    this->add(static_cast<std::int64_t>(name.size()));
    this->Text += name + ' ';
  }
  template <class T, std::size_t N>
  void add(const std::array<T, N>& items)
  {
    // The size of an array is that of its type.
    std::apply(*this, items);
  }
  template <class T>
  void add(const std::vector<T>& items)
  {
    this->add(static_cast<std::int64_t>(items.size()));
    for (const T& item : items)
    {
      this->add(item);
    }
  }
  template <class... Types>
  void add(const std::variant<Types...>& value)
  {
    this->add(static_cast<std::int64_t>(value.index()));
    std::visit([this](const auto& item) { this->add(item); }, value);
  }

  // These have no content; the index of the variant says it all.
  void add(const Everywhere&) {}
  void add(const OnBoundary&) {}
  void add(const Position&) {}
  void add(const ColumnTag& tag) { (*this)(tag.column, tag.value); }
  void add(const ColumnMask& mask) { this->add(mask.column); }
  void add(const NearestVertices& nearest) { this->add(nearest.points); }
  void add(const Region& region) { this->add(region.shape()); }
  void add(const Region::HalfSpace& half) { (*this)(half.normal, half.distance); }
  void add(const Region::Box& box) { (*this)(box.low, box.high); }
  void add(const Region::Sphere& sphere) { (*this)(sphere.center, sphere.radius); }
  void add(const Region::Vertices& vertices) { this->add(vertices.ids); }
  void add(const DataValue& value) { this->add(value.content()); }
  void add(const PlacedValue& entry) { (*this)(entry.where, entry.value); }
  void add(const Datum& datum) { this->add(datum.entries); }
  void add(const ProblemDescription::Robin& robin)
  {
    (*this)(robin.where, robin.coefficient, robin.ambient);
  }
  void add(const ProblemDescription::Soft& soft) { (*this)(soft.where, soft.weight, soft.value); }

  std::string Text;
};

} // namespace

/** All members, in a fixed order. */
std::string textOf(const ProblemDescription& problem)
{
  TextBuilder text;
  text(static_cast<std::int64_t>(problem.weights), std::int64_t(problem.columns),
    problem.conductivity, problem.screening, problem.source, problem.field, problem.initial,
    problem.dirichlet, problem.flux, problem.robin, problem.soft,
    std::int64_t(problem.gradientOutput), std::int64_t(problem.fluxOutput));
  return text.take();
}

} // namespace smg
