// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Info/ColumnSummary.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

// The ranges of the components of a column in its own type, in which 64-bit integers are exact, and
// the values of a column of few different ones. Tags come in runs and are few: the last one is
// tried first, then a sorted list.

namespace smg
{
namespace
{

/** The widest type of the kind of T, in which results are. */
template <class T>
using Wide = std::conditional_t<std::is_floating_point_v<T>, double,
  std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>>;

template <class T>
bool isFinite(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isfinite(value);
  }
  return true;
}

} // namespace

ColumnSummary::ColumnSummary(const ColumnSpec& spec)
  : HasTags(
      spec.components == 1 && spec.type != ScalarType::Float32 && spec.type != ScalarType::Float64)
{
  this->Result.spec = spec;
  const auto components = static_cast<std::size_t>(spec.components);
  this->Result.minimum.resize(components);
  this->Result.maximum.resize(components);
}

void ColumnSummary::add(const Column& column)
{
  dispatch(this->Result.spec.type, [&]<class T>(T) { this->addValues(column.as<T>()); });
}

template <class T>
void ColumnSummary::addValues(std::span<const T> values)
{
  const std::size_t components = this->Result.minimum.size();
  for (std::size_t k = 0; k < components; ++k)
  {
    bool isAny = false;
    T least{}, most{};
    for (std::size_t i = k; i < values.size(); i += components)
    {
      const T value = values[i];
      if (!isFinite(value))
      {
        ++this->Result.not_finite;
        continue;
      }
      least = isAny ? std::min(least, value) : value;
      most = isAny ? std::max(most, value) : value;
      isAny = true;
    }
    if (!isAny)
    {
      continue;
    }
    const auto low = static_cast<Wide<T>>(least), high = static_cast<Wide<T>>(most);
    MeshDescription::Number& minimum = this->Result.minimum[k];
    MeshDescription::Number& maximum = this->Result.maximum[k];
    const bool isFirst = std::holds_alternative<std::monostate>(minimum);
    minimum = isFirst ? low : std::min(low, std::get<Wide<T>>(minimum));
    maximum = isFirst ? high : std::max(high, std::get<Wide<T>>(maximum));
  }
  if constexpr (std::is_integral_v<T>)
  {
    if (this->HasTags)
    {
      this->count(values);
    }
  }
}

template <class T>
void ColumnSummary::count(std::span<const T> values)
{
  std::vector<MeshDescription::Tag>& tags = this->Result.tags;
  const auto valueOf = [](const MeshDescription::Tag& tag) { return std::get<Wide<T>>(tag.value); };
  std::size_t last = 0;
  for (const T given : values)
  {
    const auto value = static_cast<Wide<T>>(given);
    if (last >= tags.size() || valueOf(tags[last]) != value)
    {
      const auto found = std::ranges::lower_bound(tags, value, {}, valueOf);
      last = static_cast<std::size_t>(found - tags.begin());
      if (found == tags.end() || valueOf(*found) != value)
      {
        if (tags.size() == MeshDescription::MostTags)
        {
          tags = {};
          this->HasTags = false;
          return;
        }
        tags.insert(found, { value, 0 });
      }
    }
    ++tags[last].count;
  }
}

} // namespace smg
