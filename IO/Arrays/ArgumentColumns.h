// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/AddedColumns.h"
#include "smg/MeshSource.h"

namespace smg
{

// Results of a job do not have the columns that were its arguments. `added`: those that the mesh
// had for the job; null: none.

/** Whether a column of the vertices or of the cells was an argument. */
inline bool isArgument(const AddedColumns* added, bool ofCells, const ColumnSpec& column)
{
  const AddedColumns::Added* const found = added ? added->find(ofCells, column.name) : nullptr;
  return found && found->isArgument;
}

/** What a stream has without arguments. */
inline StreamInfo withoutArguments(StreamInfo info, const AddedColumns* added)
{
  std::erase_if(info.vertexColumns,
    [added](const ColumnSpec& column) { return isArgument(added, false, column); });
  std::erase_if(info.cellColumns,
    [added](const ColumnSpec& column) { return isArgument(added, true, column); });
  return info;
}

/** A stream without arguments. The source and the columns must outlive it. */
class WithoutArguments : public MeshSource
{
public:
  WithoutArguments(MeshSource& source, const AddedColumns* added)
    : Source(source)
    , Added(added)
    , Info(withoutArguments(source.info(), added))
  {
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override
  {
    if (!this->Source.next(block))
    {
      return false;
    }
    std::erase_if(block.vertexColumns,
      [this](const Column& column) { return isArgument(this->Added, false, column.spec); });
    std::erase_if(block.cellColumns,
      [this](const Column& column) { return isArgument(this->Added, true, column.spec); });
    return true;
  }

private:
  MeshSource& Source;
  const AddedColumns* Added;
  StreamInfo Info;
};

} // namespace smg
