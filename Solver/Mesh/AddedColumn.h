// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <functional>
#include <memory>

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
    const auto corners = static_cast<std::size_t>(cornersOf(this->Info.cellType));
    column.resize(this->Place == Vertices ? static_cast<std::size_t>(block.vertices())
                                          : block.corners.size() / corners);
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

} // namespace smg
