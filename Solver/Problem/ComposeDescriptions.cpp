// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComposeDescriptions.h"

#include "Solver/Problem/ProblemData.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

// Operations on descriptions as a whole: composing them from several sources (the conditions of a
// pipeline, a file), listing the columns that they name, and a text that identifies them. They
// follow the table of all data, ProblemData.

namespace smg
{
namespace
{

template <class T>
void appendTo(std::vector<T>& entries, const std::vector<T>& more)
{
  entries.insert(entries.end(), more.begin(), more.end());
}

void appendTo(Datum& datum, const Datum& more)
{
  appendTo(datum.entries, more.entries);
}

void appendTo(std::string& column, const std::string& more)
{
  column = more.empty() ? column : more;
}

bool isGiven(const Datum& datum)
{
  return datum.isGiven();
}

/** A column, or a list of conditions. */
bool isGiven(const auto& member)
{
  return !member.empty();
}

/** Collects the columns that parts and values name; of a group all that may have it. */
class ColumnNames
{
public:
  void add(const Where& where)
  {
    if (std::holds_alternative<InGroup>(where))
    {
      this->names.insert({ VertexGroupsName, FacetGroupsName, CellGroupsName });
    }
    else if (const auto* combined = std::get_if<Combination>(&where))
    {
      std::ranges::for_each(combined->parts, [this](const Where& part) { this->add(part); });
    }
    this->add(columnOf(where));
  }
  void add(const DataValue& value) { this->add(value.column()); }
  void add(const Datum& datum)
  {
    for (const PlacedValue& entry : datum.entries)
    {
      this->add(entry.where);
      this->add(entry.value);
    }
  }
  void add(const DatumRow& row, const ProblemDescription& problem)
  {
    this->add(problem.*row.member);
  }
  void add(const ColumnRow& row, const ProblemDescription& problem)
  {
    const std::string& column = problem.*row.member;
    this->add(column.empty() ? nullptr : &column);
  }
  template <class Condition>
  void add(const ConditionRow<Condition>& row, const ProblemDescription& problem)
  {
    for (const Condition& condition : problem.*row.member)
    {
      this->add(condition.where);
      this->add(condition.*row.value);
      if (row.coefficient)
      {
        this->add(condition.*row.coefficient);
      }
    }
  }

  std::set<std::string> names;

private:
  void add(const std::string* column)
  {
    if (column)
    {
      this->names.insert(*column);
    }
  }
};

} // namespace

/** Entries are appended, so that by the rule of precedence those of `more` win where both apply. */
void append(ProblemDescription& problem, const ProblemDescription& more)
{
  problem.weights = more.weights;
  // Usually equal; if they are not, the values of one description have the wrong number of
  // components, which the check against the mesh reports.
  problem.columns = std::max(problem.columns, more.columns);
  forProblemData([&](const auto& row) { appendTo(problem.*row.member, more.*row.member); });
  appendTo(problem.periodic, more.periodic);
  appendTo(problem.interfaces, more.interfaces);
  problem.gradientOutput = problem.gradientOutput || more.gradientOutput;
  problem.vertexGradientOutput = problem.vertexGradientOutput || more.vertexGradientOutput;
  problem.fluxOutput = problem.fluxOutput || more.fluxOutput;
  appendTo(problem.integrals, more.integrals);
}

std::set<std::string> namedColumns(const ProblemDescription& problem)
{
  ColumnNames columns;
  forProblemData([&](const auto& row) { columns.add(row, problem); });
  for (const ProblemDescription::Periodic& sides : problem.periodic)
  {
    columns.add(sides.from);
    columns.add(sides.to);
  }
  for (const ProblemDescription::Interface& interface : problem.interfaces)
  {
    columns.add(interface.where);
  }
  if (!problem.integrals.empty())
  {
    columns.names.insert(CellGroupsName);
  }
  return std::move(columns.names);
}

std::set<std::string> namedColumns(const std::vector<Where>& parts)
{
  ColumnNames columns;
  std::ranges::for_each(parts, [&](const Where& part) { columns.add(part); });
  return std::move(columns.names);
}

bool isPosed(const ProblemDescription& problem)
{
  // What flows because of a jump is a solution other than 0.
  bool posed = std::ranges::any_of(problem.periodic, [](const ProblemDescription::Periodic& sides)
    { return std::ranges::any_of(sides.jump, [](double jump) { return jump != 0.0; }); });
  forProblemData(
    [&](const auto& row) { posed = posed || (row.poses && isGiven(problem.*row.member)); });
  return posed;
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
  /** The member of a description in this row of the table. */
  void add(const auto& /*row*/, const auto& member) { this->add(member); }
  template <class Condition>
  void add(const ConditionRow<Condition>& row, const std::vector<Condition>& conditions)
  {
    this->add(static_cast<std::int64_t>(conditions.size()));
    for (const Condition& condition : conditions)
    {
      this->add(condition.where);
      if (row.coefficient)
      {
        this->add(condition.*row.coefficient);
      }
      this->add(condition.*row.value);
    }
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
  void add(const InGroup& group) { this->add(group.names); }
  void add(const Combination& combined)
  {
    this->add(static_cast<std::int64_t>(combined.kind));
    this->add(combined.parts);
  }
  void add(const Region& region) { this->add(region.shape()); }
  void add(const Region::HalfSpace& half) { (*this)(half.normal, half.distance); }
  void add(const Region::Box& box) { (*this)(box.low, box.high); }
  void add(const Region::Sphere& sphere) { (*this)(sphere.center, sphere.radius); }
  void add(const Region::Vertices& vertices) { this->add(vertices.ids); }
  void add(const DataValue& value)
  {
    this->add(value.content());
    // The texts of checkpoints are as they were.
    if (value.owner() != DataValue::Owner::Usual)
    {
      this->add(static_cast<std::int64_t>(value.owner()));
    }
  }
  void add(const PlacedValue& entry) { (*this)(entry.where, entry.value); }
  void add(const Datum& datum) { this->add(datum.entries); }
  void add(const ProblemDescription::Periodic& sides)
  {
    (*this)(sides.from, sides.to, sides.jump, sides.tolerance);
  }
  void add(const ProblemDescription::Interface& interface)
  {
    (*this)(interface.where, interface.coefficient, interface.tolerance);
  }

  std::string Text;
};

} // namespace

/** Of a tensor the diagonal. Without an entry that holds everywhere, it may be 1 elsewhere. */
double contrastOf(const ProblemDescription& problem)
{
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  const auto include = [&](double number)
  {
    least = std::min(least, number);
    most = std::max(most, number);
  };
  bool holdsEverywhere = false;
  for (const PlacedValue& entry : problem.conductivity.entries)
  {
    holdsEverywhere = holdsEverywhere || std::holds_alternative<Everywhere>(entry.where);
    const auto* numbers = std::get_if<std::vector<double>>(&entry.value.content());
    for (std::size_t n = 0; numbers && n < std::min<std::size_t>(3, numbers->size()); ++n)
    {
      include((*numbers)[n]);
    }
  }
  if (!holdsEverywhere)
  {
    include(1.0);
  }
  return least > 0.0 && most > least ? most / least : 1.0;
}

/** All members, in the order of the table. */
std::string textOf(const ProblemDescription& problem)
{
  TextBuilder text;
  text(static_cast<std::int64_t>(problem.weights), std::int64_t(problem.columns));
  forProblemData([&](const auto& row) { text.add(row, problem.*row.member); });
  text(std::int64_t(problem.gradientOutput), std::int64_t(problem.fluxOutput));
  // The texts of checkpoints without couplings are as they were.
  if (!problem.periodic.empty() || !problem.interfaces.empty())
  {
    text(problem.periodic, problem.interfaces);
  }
  // The texts of checkpoints without these are as they were.
  if (problem.vertexGradientOutput || !problem.integrals.empty())
  {
    text(std::int64_t(problem.vertexGradientOutput), problem.integrals);
  }
  return text.take();
}

} // namespace smg
