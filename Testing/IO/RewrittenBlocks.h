// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/Formats/Vsm/VsmFormat.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{

/** The column of a block, to be changed. */
using Edit = std::function<void(int table, int column, std::vector<std::byte>& bytes)>;

/** Writes a block file anew, with another header, tables and blocks, and another column of the
 * cells, of zeros. */
inline void rewrite(const std::filesystem::path& from, const std::filesystem::path& to,
  const std::string& header, const std::vector<TableSpec>& tables, const Edit& edit = {},
  const std::optional<ColumnSpec>& added = {})
{
  BlockFileReader reader(from);
  BlockFileWriter writer(to, tables, reader.codec());
  for (int table = 0; table < static_cast<int>(tables.size()); ++table)
  {
    for (std::int64_t block = 0; block < reader.blocks(table); ++block)
    {
      const auto columns = static_cast<int>(reader.tables()[table].columns.size());
      std::vector<std::vector<std::byte>> bytes;
      std::vector<std::span<const std::byte>> spans;
      for (int column = 0; column < columns; ++column)
      {
        bytes.emplace_back(reader.columnBytes(table, block, column));
        reader.read(table, block, column, bytes.back());
        if (edit)
        {
          edit(table, column, bytes.back());
        }
      }
      if (added && table == VsmFormat::Cells)
      {
        const auto rows = static_cast<std::size_t>(reader.blockRows(table, block));
        bytes.emplace_back(rows * added->tupleBytes());
      }
      spans.assign(bytes.begin(), bytes.end());
      writer.append(table, reader.blockRows(table, block), spans);
    }
  }
  writer.finish(header);
}

} // namespace smg::testing
