// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/CellLabels.h"

#include <algorithm>
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
      pool.acquire(static_cast<std::int64_t>(MostLabels * sizeof(std::uint64_t)));
      this->Columns.push_back({ spec.name, { begin, bytes }, {} });
      this->Columns.back().values.reserve(MostLabels);
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
    std::uint64_t last = 0;
    bool isFirst = true;
    for (std::size_t at = 0; at < column->bytes.size() && !integers.hasMore;
         at += integers.place.bytes)
    {
      std::uint64_t value = 0;
      std::memcpy(&value, column->bytes.data() + at, integers.place.bytes);
      if (value == last && !isFirst)
      {
        continue;
      }
      integers.changes += isFirst ? 0 : 1;
      last = value;
      isFirst = false;
      std::vector<std::uint64_t>& values = integers.values;
      const auto place = std::ranges::lower_bound(values, value);
      if (place == values.end() || *place != value)
      {
        integers.hasMore = values.size() == MostLabels;
        if (!integers.hasMore)
        {
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
