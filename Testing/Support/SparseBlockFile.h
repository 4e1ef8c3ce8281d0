// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "Solver/Files/Checksum.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** Writes a block file of any size with little on the disk: most blocks take no bytes, or holes,
 * and cannot be read. */
class SparseBlockFile
{
public:
  SparseBlockFile(const std::filesystem::path& path, std::vector<TableSpec> tables)
    : File(path, std::ios::binary)
  {
    this->Index.codec = Codec::Zstd; // which may store fewer bytes than the rows have
    this->Index.blocks.resize(tables.size());
    this->Index.tables = std::move(tables);
  }

  std::int64_t end() const { return this->End; }

  /** Adds a block whose only column is a hole of `bytes` bytes. */
  void addHole(int table, std::int64_t rows, std::uint32_t bytes)
  {
    this->begin(table, rows);
    this->Index.blocks[table].entries.push_back({ bytes, bytes, 0 });
    this->End += bytes;
  }

  /** Adds a block without stored bytes. */
  void addEmpty(int table, std::int64_t rows)
  {
    this->begin(table, rows);
    for (const ColumnSpec& column : this->Index.tables[table].columns)
    {
      const auto bytes = static_cast<std::uint32_t>(std::size_t(rows) * column.tupleBytes());
      this->Index.blocks[table].entries.push_back({ 0, bytes, 0 });
    }
  }

  /** Adds a block with these columns, not compressed. */
  void add(int table, std::int64_t rows, const std::vector<std::vector<std::byte>>& columns)
  {
    this->begin(table, rows);
    for (const std::vector<std::byte>& column : columns)
    {
      const auto bytes = static_cast<std::uint32_t>(column.size());
      this->Index.blocks[table].entries.push_back({ bytes, bytes, checksum(column) });
      this->put(column);
    }
  }

  void finish(const std::string& header)
  {
    BlockFileFront front{};
    const std::vector<std::byte> tail = this->Index.serialize();
    std::memcpy(front.magic, BlockFileMagic.data(), sizeof(front.magic));
    front.version = BlockFileVersion;
    front.order = BlockFileFront::OrderMark;
    front.tailOffset = this->End;
    front.tailBytes = std::ssize(tail);
    front.tailChecksum = checksum(tail);
    front.headerBytes = std::ssize(header);
    front.headerChecksum = checksum(std::as_bytes(std::span(header)));
    const auto bytes = std::as_bytes(std::span(&front, 1));
    front.frontChecksum = checksum(bytes.first(offsetof(BlockFileFront, frontChecksum)));
    this->put(tail);
    this->End = 0;
    this->put(bytes);
    this->put(std::as_bytes(std::span(header)));
    this->File.close();
  }

private:
  void begin(int table, std::int64_t rows)
  {
    TableIndex& index = this->Index.blocks[table];
    index.firstRow.push_back(index.firstRow.back() + rows);
    index.offset.push_back(this->End);
  }
  void put(std::span<const std::byte> bytes)
  {
    this->File.seekp(this->End);
    this->File.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    this->End += std::ssize(bytes);
  }

  std::ofstream File;
  BlockFileIndex Index;
  std::int64_t End = BlockFileHeaderBytes;
};

} // namespace smg::testing
