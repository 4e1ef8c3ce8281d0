// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/TagValues.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace smg
{
namespace
{

/** The shortest text of the number in its precision, an integer without an exponent. */
std::string textOf(double value, bool isSingle)
{
  constexpr double MostExact = 9007199254740992.0;
  if (value == std::trunc(value) && std::fabs(value) < MostExact)
  {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  char text[32];
  const auto end = isSingle ? std::to_chars(text, text + sizeof text, static_cast<float>(value))
                            : std::to_chars(text, text + sizeof text, value);
  return { text, end.ptr };
}

} // namespace

void TagValues::add(const Column& column, std::span<const std::uint8_t> selected)
{
  this->Found = this->Found || std::ranges::count(selected, 1) > 0;
  this->IsSingle = column.spec.type == ScalarType::Float32;
  for (std::size_t i = 0; i < selected.size() && !this->Found; ++i)
  {
    this->add(column.value(i, 0));
  }
}

void TagValues::add(double value)
{
  const auto place = std::ranges::lower_bound(this->Values, value);
  const bool isNew = place == this->Values.end() || *place != value;
  if (!isNew || std::isnan(value))
  {
    return;
  }
  if (this->IsRange)
  {
    this->Values.front() = std::min(this->Values.front(), value);
    this->Values.back() = std::max(this->Values.back(), value);
    return;
  }
  this->Values.insert(place, value);
  if (this->Values.size() > Most)
  {
    this->Values = { this->Values.front(), this->Values.back() };
    this->IsRange = true;
  }
}

std::string TagValues::text() const
{
  constexpr std::size_t Named = 10;
  const auto name = [this](double value) { return textOf(value, this->IsSingle); };
  if (this->Found || this->Values.empty())
  {
    return {};
  }
  const std::size_t count = this->Values.size();
  if (this->IsRange)
  {
    return ": its values, more than " + std::to_string(Most) + ", are from " +
           name(this->Values.front()) + " to " + name(this->Values.back());
  }
  if (count == 1)
  {
    return ": its only value is " + name(this->Values.front());
  }
  std::string list;
  for (std::size_t i = 0; i < std::min(count, Named); ++i)
  {
    list += (i == 0 ? "" : i + 1 < count ? ", " : " and ") + name(this->Values[i]);
  }
  return count <= Named ? ": its values are " + list
                        : ": the smallest of its " + std::to_string(count) + " values are " + list;
}

} // namespace smg
