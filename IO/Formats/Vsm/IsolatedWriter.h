// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/Formats/Vsm/PositionBuffer.h"
#include "IO/Formats/Vsm/RowBuffer.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Writes the table of the isolated vertices of a .vsm file. */
class IsolatedWriter
{
public:
  /** The vertices have the vertex columns of `info`. `name` is the name of the file in errors. */
  IsolatedWriter(std::string name, const StreamInfo& info);

  /** The specification of the table; see VsmFormat.h. */
  static TableSpec table(const StreamInfo& info);

  /** Appends vertices; see VsmWriter::isolated(). */
  void append(BlockFileWriter& file, std::span<const std::int64_t> ids,
    std::span<const double> positions, const std::vector<Column>& columns);

  /** Writes the remaining vertices. */
  void finish(BlockFileWriter& file);

private:
  [[noreturn]] void fail(const std::string& what) const;
  void check(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns) const;

  std::string Name;
  std::vector<ColumnSpec> Specs;
  std::vector<std::int64_t> Ids;
  PositionBuffer Positions;
  RowBuffer Rows; ///< without the positions
};

} // namespace smg
