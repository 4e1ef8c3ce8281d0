// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/ShownColumns.h"

#include "IO/Mesh/Columns.h"
#include "smg/Preview.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace html
{

namespace
{

bool isOfPicture(const smg::ColumnSpec& column)
{
  return !smg::isNormals(column) && column.name != smg::OriginalIdName &&
         column.name != smg::StreamIndexName && column.name != smg::TextureCoordinatesName;
}

} // namespace

bool ShownColumns::isColour(const smg::ColumnSpec& column)
{
  const bool isUsual = column.type == smg::ScalarType::UInt8 ||
                       column.type == smg::ScalarType::Float32 ||
                       column.type == smg::ScalarType::Float64;
  return column.name == smg::ColorsName && isUsual &&
         (column.components == 3 || column.components == 4);
}

ShownColumns::ShownColumns(smg::MeshSource& mesh, const std::vector<std::string>& first)
  : Mesh(mesh)
  , Info(mesh.info())
{
  constexpr int Most = 8;
  const std::vector<smg::ColumnSpec> all = std::exchange(this->Info.vertexColumns, {});
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(
    order, {}, [&](std::size_t place) { return std::ranges::find(first, all[place].name); });
  int shown = 0;
  for (const std::size_t place : order)
  {
    const int components = isColour(all[place]) ? 1 : all[place].components;
    if (isOfPicture(all[place]) && shown + components <= Most)
    {
      shown += components;
      this->Places.push_back(place);
      this->Info.vertexColumns.push_back(all[place]);
      this->Ranges.emplace_back(static_cast<std::size_t>(all[place].components));
    }
  }
  std::erase_if(this->Info.cellColumns,
    [](const smg::ColumnSpec& column) { return column.name != smg::CellFlagsName; });
}

bool ShownColumns::next(smg::MeshBlock& block)
{
  if (!this->Mesh.next(this->Whole))
  {
    return false;
  }
  block.firstVertex = this->Whole.firstVertex;
  block.firstCell = this->Whole.firstCell;
  block.finalized = this->Whole.finalized;
  block.positions.swap(this->Whole.positions);
  block.corners.swap(this->Whole.corners);
  block.vertexColumns.resize(this->Places.size());
  for (std::size_t c = 0; c < this->Places.size(); ++c)
  {
    smg::Column& column = block.vertexColumns[c];
    column = this->Whole.vertexColumns[this->Places[c]];
    for (std::size_t v = 0; v < column.tuples(); ++v)
    {
      for (int k = 0; k < column.spec.components; ++k)
      {
        if (const double value = column.value(v, k); std::isfinite(value))
        {
          ValueRange& range = this->Ranges[c][static_cast<std::size_t>(k)];
          range.least = std::min(range.least, value);
          range.most = std::max(range.most, value);
        }
      }
    }
  }
  block.cellColumns.clear();
  if (const smg::Column* const flags = this->Whole.flags())
  {
    block.cellColumns.push_back(*flags);
  }
  return true;
}

} // namespace html
