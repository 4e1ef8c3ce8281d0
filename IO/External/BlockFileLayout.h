// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/**
 * The layout of a block file:
 *
 *     [0, HeaderBytes)   BlockFileFront, then the header in JSON, then zeros
 *     the blocks         the columns of a block one after the other, no gaps
 *     the tail           codec, tables and index (see BlockFileIndex), to the end of the file
 *
 * All numbers are in the byte order of the machine that wrote the file.
 */
constexpr std::int64_t BlockFileHeaderBytes = 16 << 10;
constexpr std::uint32_t BlockFileVersion = 1;
constexpr std::string_view BlockFileMagic = "SMGBLOCK";

/** The maximum number of bytes of a column of a block. */
constexpr std::int64_t MaxColumnBytes = std::int64_t(1) << 30;

/** The first bytes of the file. */
struct BlockFileFront
{
  static constexpr std::uint32_t OrderMark = 0x01020304;

  char magic[8];
  std::uint32_t version;
  std::uint32_t order;
  std::int64_t tailOffset, tailBytes;
  std::uint64_t tailChecksum;
  std::int64_t headerBytes;
  std::uint64_t headerChecksum;
  std::uint64_t frontChecksum; ///< of all bytes before this one
};
static_assert(sizeof(BlockFileFront) == 64);

/** The index entry of a column of a block. */
struct ColumnEntry
{
  std::uint32_t storedBytes = 0;
  std::uint32_t plainBytes = 0;
  std::uint64_t checksum = 0; ///< of the stored bytes
};

/** The blocks of one table. */
struct TableIndex
{
  std::vector<std::int64_t> firstRow{ 0 }; ///< one more than the number of blocks
  std::vector<std::int64_t> offset;        ///< offset of the block in the file
  std::vector<ColumnEntry> entries;        ///< all columns of a block, block after block

  std::int64_t blocks() const { return static_cast<std::int64_t>(this->offset.size()); }
};

/** Codec, tables and blocks of a file. */
struct BlockFileIndex
{
  Codec codec = Codec::None;
  std::vector<TableSpec> tables;
  std::vector<TableIndex> blocks; ///< one per table

  const ColumnEntry& entry(int table, std::int64_t block, int column) const
  {
    return this->blocks[table].entries[block * this->tables[table].columns.size() + column];
  }

  std::vector<std::byte> serialize() const;
  /** Reads the output of serialize(). Throws Error, which begins with `file`, if it is invalid or
   * does not describe exactly the bytes [BlockFileHeaderBytes, tailOffset) of the file. */
  static BlockFileIndex parse(
    std::span<const std::byte> bytes, std::int64_t tailOffset, const std::string& file);
};

} // namespace smg
