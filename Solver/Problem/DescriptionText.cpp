// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/DescriptionText.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace smg
{
namespace
{

/** Appends values; variants begin with the index of their type, lists and names with their size. */
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
