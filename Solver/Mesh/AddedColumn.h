// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Mesh/VisitCells.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** A mesh stream with an additional column of the vertices or cells, filled by a function. */
class AddedColumn : public MeshSource
{
public:
  enum Of
  {
    Vertices,
    Cells
  };
  /** Fills the column, which has the correct number of tuples, for the block. */
  using Fill = std::function<void(const MeshBlock& block, Column& column)>;

  AddedColumn(std::unique_ptr<MeshSource> source, Of of, ColumnSpec spec, Fill fill)
    : Source(std::move(source))
    , Info(this->Source->info())
    , Place(of)
    , Spec(std::move(spec))
    , FillColumn(std::move(fill))
  {
    (of == Vertices ? this->Info.vertexColumns : this->Info.cellColumns).push_back(this->Spec);
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    std::vector<Column>& columns =
      this->Place == Vertices ? block.vertexColumns : block.cellColumns;
    if (!columns.empty())
    {
      columns.pop_back();
    }
    if (!this->Source->next(block))
    {
      return false;
    }
    Column column{ this->Spec, {} };
    column.resize(this->Place == Vertices ? static_cast<std::size_t>(block.vertices())
                                          : cellsOf(this->Info.cellType, block));
    this->FillColumn(block, column);
    columns.push_back(std::move(column));
    return true;
  }

private:
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
  Of Place;
  ColumnSpec Spec;
  Fill FillColumn;
};

/** The name of a vertex or cell in messages: its index in the original file or in the stream. */
inline std::string nameOfRow(std::int64_t number, bool original)
{
  return std::to_string(number) + (original ? " of the original mesh" : " of the stream");
}

/** The same for row `i` of a block that begins with row `first`: its original index if the block
 * has that column. */
inline std::string nameOfRow(
  const std::vector<Column>& columns, const ColumnSpec& numbers, std::int64_t first, std::size_t i)
{
  const std::ptrdiff_t place = findColumn(columns, numbers);
  return place < 0
           ? nameOfRow(first + static_cast<std::int64_t>(i), false)
           : nameOfRow(columns[static_cast<std::size_t>(place)].as<std::int64_t>()[i], true);
}

} // namespace smg
