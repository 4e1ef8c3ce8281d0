// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Ply/PlyRecords.h"
#include "IO/Formats/Ply/WritePly.h"

#include <cstddef>
#include <vector>

namespace smg
{

/** Columns of vertices or faces as properties of a PLY file; see writePly(). */
class PlyColumns
{
public:
  /** Adds the columns to the properties of the records. Columns that cannot be added are noted in
   * `written`. */
  PlyColumns(PlyRecords& records, const std::vector<ColumnSpec>& specs, WrittenPly& written);

  /** Fills the columns into the records. Rounded values are noted in `written`. */
  void fill(PlyRecords& records, const std::vector<Column>& columns, WrittenPly& written) const;

private:
  std::vector<std::ptrdiff_t> Places; ///< of each column in the record; -1: omitted
};

} // namespace smg
