// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyColumns.h"

#include <algorithm>

namespace smg
{

PlyColumns::PlyColumns(
  PlyRecords& records, const std::vector<ColumnSpec>& specs, WrittenPly& written)
{
  for (const ColumnSpec& spec : specs)
  {
    this->Places.push_back(records.add(spec));
    if (this->Places.back() < 0)
    {
      written.droppedColumns.push_back(spec.name);
    }
  }
}

void PlyColumns::fill(
  PlyRecords& records, const std::vector<Column>& columns, WrittenPly& written) const
{
  std::vector<std::string>& rounded = written.roundedColumns;
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    const std::string& name = columns[i].spec.name;
    if (this->Places[i] >= 0 && records.fill(this->Places[i], columns[i]) &&
        std::find(rounded.begin(), rounded.end(), name) == rounded.end())
    {
      rounded.push_back(name);
    }
  }
}

} // namespace smg
