// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/CellLabels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Labels differ from other integers in that they have few values, which are kept as sorted lists,
// and in that cells that follow one another in the stream have mostly the same: hardly any is
// looked up.

namespace smg
{

CellLabels::CellLabels(const std::vector<ColumnSpec>& columns, Pool& pool)
{
  std::size_t begin = 0;
  for (const ColumnSpec& spec : columns)
  {
    const std::size_t bytes = spec.tupleBytes();
    const bool isInteger = spec.type != ScalarType::Float32 && spec.type != ScalarType::Float64;
    if (isInteger && spec.components == 1)
    {
      pool.acquire(
        static_cast<std::int64_t>(MostLabels * (sizeof(std::uint64_t) + 2 * sizeof(double))));
      this->Columns.push_back({ spec.name, { begin, bytes }, {} });
      this->Columns.back().values.reserve(MostLabels);
      this->Columns.back().areas.reserve(MostLabels);
    }
    begin += bytes;
  }
}

void CellLabels::add(const MeshBlock& block)
{
  this->Cells += static_cast<std::int64_t>(block.corners.size() / 3);
  for (Integers& integers : this->Columns)
  {
    const auto column = std::ranges::find(
      block.cellColumns, integers.name, [](const Column& each) { return each.spec.name; });
    if (column == block.cellColumns.end())
    {
      continue;
    }
    for (std::size_t at = 0; at < column->bytes.size() && !integers.hasMore;
         at += integers.place.bytes)
    {
      std::uint64_t value = 0;
      std::memcpy(&value, column->bytes.data() + at, integers.place.bytes);
      if (integers.last == value)
      {
        continue;
      }
      integers.changes += integers.last ? 1 : 0;
      integers.last = value;
      std::vector<std::uint64_t>& values = integers.values;
      const auto place = std::ranges::lower_bound(values, value);
      if (place == values.end() || *place != value)
      {
        integers.hasMore = values.size() == MostLabels;
        if (!integers.hasMore)
        {
          integers.areas.insert(integers.areas.begin() + (place - values.begin()), { 0.0, 0.0 });
          values.insert(place, value);
        }
      }
    }
  }
}

std::vector<LabelPlace> CellLabels::places() const
{
  std::vector<LabelPlace> places;
  for (const Integers& column : this->Columns)
  {
    // A single value has no borders.
    if (this->areLabels(column) && column.values.size() > 1)
    {
      places.push_back(column.place);
    }
  }
  return places;
}

void CellLabels::addArea(Surface surface, const std::byte* row, double area)
{
  for (Integers& integers : this->Columns)
  {
    std::uint64_t value = 0;
    std::memcpy(&value, row + integers.place.begin, integers.place.bytes);
    const auto place = std::ranges::lower_bound(integers.values, value);
    if (place != integers.values.end() && *place == value)
    {
      integers.areas[static_cast<std::size_t>(place - integers.values.begin())][surface] += area;
    }
  }
}

std::vector<CellLabels::Changes> CellLabels::changes() const
{
  std::vector<Changes> all;
  for (const Integers& column : this->Columns)
  {
    std::array<double, 2> whole{};
    for (const auto& [given, simplified] : column.areas)
    {
      whole[Given] += given;
      whole[Simplified] += simplified;
    }
    if (!this->areLabels(column) || !(whole[Given] > 0.0) || !(whole[Simplified] > 0.0))
    {
      continue;
    }
    Changes changes{ column.name, static_cast<std::int64_t>(column.values.size()) };
    for (const auto& [given, simplified] : column.areas)
    {
      const double before = given / whole[Given], after = simplified / whole[Simplified];
      const bool isLost = before > 0.0 && after == 0.0;
      changes.lost += isLost ? 1 : 0;
      changes.changed += !isLost && std::fabs(after - before) > Tolerance * before ? 1 : 0;
    }
    if (changes.lost + changes.changed > 0)
    {
      all.push_back(changes);
    }
  }
  return all;
}

std::vector<std::string> CellLabels::others() const
{
  std::vector<std::string> names;
  for (const Integers& column : this->Columns)
  {
    if (!this->areLabels(column))
    {
      names.push_back(column.name);
    }
  }
  return names;
}

} // namespace smg
