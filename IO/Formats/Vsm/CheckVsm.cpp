// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/CheckVsm.h"

#include "IO/External/BlockFile.h"
#include "Solver/Core/Progress.h"

#include <cstddef>
#include <vector>

namespace smg
{

namespace
{

/** Reads a block as a whole, which checks it. */
void readBlock(BlockFileReader& file, int table, std::int64_t block, std::vector<std::byte>& bytes)
{
  const auto columns =
    static_cast<int>(file.tables()[static_cast<std::size_t>(table)].columns.size());
  for (int column = 0; column < columns; ++column)
  {
    bytes.resize(file.columnBytes(table, block, column));
    file.read(table, block, column, bytes);
  }
}

} // namespace

std::int64_t checkVsm(const std::filesystem::path& path, const ProgressFunction& progress)
{
  BlockFileReader file(path);
  const auto tables = static_cast<int>(file.tables().size());
  std::int64_t blocks = 0;
  for (int table = 0; table < tables; ++table)
  {
    blocks += file.blocks(table);
  }
  Progress reported(progress);
  std::vector<std::byte> bytes;
  std::int64_t done = 0;
  for (int table = 0; table < tables; ++table)
  {
    for (std::int64_t block = 0; block < file.blocks(table); ++block)
    {
      readBlock(file, table, block, bytes);
      reported.update(static_cast<double>(++done) / static_cast<double>(blocks));
    }
  }
  return blocks;
}

} // namespace smg
