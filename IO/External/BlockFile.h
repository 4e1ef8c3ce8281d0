// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/IoStatistics.h"
#include "smg/Column.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

class ColumnCodec;
class Workers;

/** A table of a block file: rows with the same columns. */
struct TableSpec
{
  std::string name;
  /** A column of 0 components is opaque: any number of bytes per block, independent of the rows. */
  std::vector<ColumnSpec> columns;
  bool operator==(const TableSpec&) const = default;
};

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

/** The maximum number of bytes of the tail, which a reader holds in memory. */
constexpr std::int64_t MaxIndexBytes = std::int64_t(256) << 20;

/** Bytes of a block of so many columns in the index. */
constexpr std::int64_t indexBytesOfBlock(std::size_t columns)
{
  return 16 * (1 + static_cast<std::int64_t>(columns));
}

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

/**
 * Writes a block file: a container of tables, each split into blocks of rows. Each column of a
 * block is compressed and has a checksum (XXH3, 64 bits) of its own. A JSON header, the layout of
 * the tables and an index of all blocks allow reading any block for itself.
 *
 * The file is written under a temporary name beside `path` and renamed by finish(); without
 * finish() the destructor removes it. A thread of the writer writes behind the caller; at most
 * `WriteBehindBytes` wait in memory. A failed write (disk full) is thrown as Error, with the path,
 * by the next append() or by finish().
 */
class SMG_EXPORT BlockFileWriter
{
public:
  static constexpr std::size_t WriteBehindBytes = std::size_t(192) << 10;
  /** The most blocks that are compressed at once, and the most bytes that each of several may have
   * on average. */
  static constexpr int MaxBlocks = 8;
  static constexpr std::size_t BlockBytes = std::size_t(256) << 10;

  /** Blocks are compressed on the threads of `workers`, which must outlive the writer; null: on the
   * thread of the caller. The bytes of the file do not depend on it. */
  BlockFileWriter(std::filesystem::path path, std::vector<TableSpec> tables, Codec codec,
    IoStatistics* statistics = nullptr, Workers* workers = nullptr);
  /** The most bytes of blocks that several threads compress, with compressors and results. */
  static std::int64_t memoryFor(const Workers& workers);
  ~BlockFileWriter();
  BlockFileWriter(const BlockFileWriter&) = delete;
  BlockFileWriter& operator=(const BlockFileWriter&) = delete;

  /** Appends `rows` rows to table `table`; one span of bytes per column, which is copied. Throws
   * Error if there are more blocks than a reader accepts. */
  void append(int table, std::int64_t rows, std::span<const std::span<const std::byte>> columns);

  /** Writes index and header (the text of a JSON value, at most about 16,000 bytes), closes,
   * renames. */
  void finish(const std::string& header);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * Reads a block file. Opening checks the magic, the version, the checksums of the header and the
 * index, and that the length of the file agrees with the index; reading a block checks its
 * checksums. Every failure is an Error that names the file, the table and the block. One thread at
 * a time.
 */
class SMG_EXPORT BlockFileReader
{
public:
  explicit BlockFileReader(const std::filesystem::path& path, IoStatistics* statistics = nullptr);
  ~BlockFileReader();

  /** The text of a JSON value. */
  const std::string& header() const { return this->Header; }
  /** A checksum of the header and the index and, through the checksums in these, of the whole
   * file. */
  std::uint64_t contentChecksum() const { return this->ContentChecksum; }
  const std::vector<TableSpec>& tables() const { return this->Index.tables; }
  Codec codec() const { return this->Index.codec; }

  /** Bytes of the index, which is in memory. */
  std::int64_t indexBytes() const { return this->IndexBytes; }

  std::int64_t rows(int table) const { return this->Index.blocks[table].firstRow.back(); }
  std::int64_t blocks(int table) const { return this->Index.blocks[table].blocks(); }
  std::int64_t firstRow(int table, std::int64_t block) const
  {
    return this->Index.blocks[table].firstRow[block];
  }
  std::int64_t blockRows(int table, std::int64_t block) const
  {
    return this->firstRow(table, block + 1) - this->firstRow(table, block);
  }
  /** The block that holds row `row`. */
  std::int64_t blockOf(int table, std::int64_t row) const;
  /** Bytes of a column of a block, uncompressed. */
  std::size_t columnBytes(int table, std::int64_t block, int column) const
  {
    return this->Index.entry(table, block, column).plainBytes;
  }
  /** Bytes of a column in the file, of all its blocks. */
  std::int64_t storedBytes(int table, int column) const;

  /** Reads a column of a block into `bytes`, which must have exactly columnBytes(...) bytes. */
  void read(int table, std::int64_t block, int column, std::span<std::byte> bytes);

  /** Announces a read of the columns of a block, so that the system starts to load them from disk:
   * a hint. */
  void prefetch(int table, std::int64_t block);

private:
  [[noreturn]] void fail(const std::string& what) const;
  BlockFileFront readFront(std::span<std::byte> region) const;
  void checkIndexBytes(const BlockFileFront& front) const;
  void checkLength(const BlockFileFront& front) const;
  std::string place(int table, std::int64_t block) const
  {
    return "table '" + this->Index.tables[table].name + "', block " + std::to_string(block);
  }
  void check(int table, std::int64_t block) const;
  void count(std::int64_t bytes, std::int64_t waited);
  void readStored(int table, std::int64_t block, int column, std::span<std::byte> bytes);

  std::string Name;
  IoStatistics* Statistics;
  FileDescriptor File;
  std::string Header;
  BlockFileIndex Index;
  std::int64_t IndexBytes = 0;
  std::uint64_t ContentChecksum = 0;
  std::unique_ptr<ColumnCodec> Coder;
  std::vector<std::byte> Stored;
};

/** Whether the file begins with the magic of a block file. */
SMG_EXPORT bool isBlockFile(const std::filesystem::path& path);

} // namespace smg
