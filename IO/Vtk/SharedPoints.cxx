// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/SharedPoints.h"

#include "IO/Vtk/PieceColumns.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace smg
{
namespace
{

/** The positions and columns of some points as a row of numbers each. */
std::vector<double> rowsOf(const std::vector<double>& positions, const std::vector<Column>& columns)
{
  const std::size_t points = positions.size() / 3;
  std::size_t width = 3;
  for (const Column& column : columns)
  {
    width += static_cast<std::size_t>(column.spec.components);
  }
  std::vector<double> rows(points * width);
  for (std::size_t i = 0; i < points; ++i)
  {
    std::copy_n(&positions[3 * i], 3, &rows[i * width]);
  }
  std::size_t at = 3;
  for (const Column& column : columns)
  {
    const auto components = static_cast<std::size_t>(column.spec.components);
    dispatch(column.spec.type,
      [&]<class T>(T)
      {
        const auto values = column.as<T>();
        for (std::size_t i = 0; i < points * components; ++i)
        {
          rows[i / components * width + at + i % components] = static_cast<double>(values[i]);
        }
      });
    at += components;
  }
  return rows;
}

} // namespace

bool SharedPoints::add(vtkPointSet& piece, const std::vector<std::int64_t>& ids,
  const MeshBlock& block, const std::function<bool(std::int64_t)>& isFinal,
  const std::string& where)
{
  const bool found = !this->Ids.empty() && this->differ(piece, ids, block, where);
  this->keep(block, isFinal);
  return found;
}

bool SharedPoints::differ(vtkPointSet& piece, const std::vector<std::int64_t>& ids,
  const MeshBlock& block, const std::string& where)
{
  // Points of ghost cells alone may lack neighbours themselves.
  std::vector<std::int64_t> used;
  std::ranges::copy_if(block.corners, std::back_inserter(used),
    [&block](std::int64_t id) { return id < block.firstVertex; });
  std::ranges::sort(used);
  std::vector<std::int64_t> points, kept;
  std::vector<double> positions;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto place = std::ranges::lower_bound(this->Ids, ids[i]);
    if (place != this->Ids.end() && *place == ids[i] && std::ranges::binary_search(used, ids[i]))
    {
      points.push_back(static_cast<std::int64_t>(i));
      kept.push_back(place - this->Ids.begin());
      positions.resize(positions.size() + 3);
      piece.GetPoint(points.back(), &positions[positions.size() - 3]);
    }
  }
  std::vector<Column> columns;
  for (const Column& own : block.vertexColumns)
  {
    Column& column = columns.emplace_back(own.spec, std::vector<std::byte>());
    copyColumn(*piece.GetPointData(), points, where, column);
  }
  const std::vector<double> rows = rowsOf(positions, columns);
  // Sums in another order differ by roundings, of single precision perhaps.
  constexpr double Rounding = 1e-5;
  const std::size_t width = this->Scale.size();
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const double other =
      this->Values[static_cast<std::size_t>(kept[k / width]) * width + k % width];
    const bool areNumbers = std::isfinite(rows[k]) && std::isfinite(other);
    const bool areSame = areNumbers ? std::abs(rows[k] - other) <= Rounding * this->Scale[k % width]
                                    : std::isfinite(rows[k]) == std::isfinite(other);
    if (!areSame)
    {
      return true;
    }
  }
  return false;
}

void SharedPoints::keep(const MeshBlock& block, const std::function<bool(std::int64_t)>& isFinal)
{
  const std::vector<double> rows = rowsOf(block.positions, block.vertexColumns);
  const std::int64_t count = block.vertices();
  if (count > 0)
  {
    this->Scale.resize(rows.size() / static_cast<std::size_t>(count));
  }
  const std::size_t width = this->Scale.size();
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const double size = std::isfinite(rows[k]) ? std::abs(rows[k]) : 0.0;
    this->Scale[k % width] = std::max(this->Scale[k % width], size);
  }
  std::vector<std::int64_t> ids;
  std::vector<double> values;
  const auto add = [&](std::int64_t id, const double* row)
  {
    if (!isFinal(id) && values.size() + width <= Most)
    {
      ids.push_back(id);
      values.insert(values.end(), row, row + width);
    }
  };
  for (std::size_t k = 0; k < this->Ids.size(); ++k)
  {
    add(this->Ids[k], &this->Values[k * width]);
  }
  for (std::int64_t i = 0; i < count; ++i)
  {
    add(block.firstVertex + i, &rows[static_cast<std::size_t>(i) * width]);
  }
  this->Ids = std::move(ids);
  this->Values = std::move(values);
}

} // namespace smg
