// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"

#include "IO/External/Codec.h"
#include "IO/External/WriteBehind.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Workers.h"
#include "Solver/Files/Checksum.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

// Writing a block file. Blocks are compressed on several threads and written in the order of
// append(), behind the caller; so the bytes of the file do not depend on threads.
//
// The front, which has the checksums of header and index, is written last: until then the file does
// not begin with the magic. Then the file is synchronised and renamed, so that its name always
// stands for a whole file. At most WriteBehindBytes wait to be written, and memoryFor() bounds what
// is being compressed.

namespace smg
{

namespace
{

/** A block that is being compressed, with the memory for it, which later blocks use again. */
struct PendingBlock
{
  int table = 0;
  std::int64_t rows = 0;
  std::vector<std::byte> plain, stored; ///< column after column
  std::vector<ColumnEntry> entries;
  std::unique_ptr<ColumnCodec> coder;
};

std::size_t blocksAtOnce(const Workers* workers)
{
  return workers
           ? static_cast<std::size_t>(std::min(workers->threads(), BlockFileWriter::MaxBlocks))
           : 1;
}

} // namespace

struct BlockFileWriter::Implementation
{
  Implementation(std::filesystem::path path, std::vector<TableSpec> tables, Codec codec,
    IoStatistics* statistics, Workers* workers)
    : Path(std::move(path))
    , Statistics(statistics)
    , File(FileDescriptor::createBeside(this->Path))
    , Behind(std::make_unique<WriteBehind>(this->File, BlockFileHeaderBytes, WriteBehindBytes))
    , Appended(tables.size())
    , Blocks(
        workers ? *workers : this->Alone, blocksAtOnce(workers),
        [this](PendingBlock& block) { this->compress(block); },
        [this](PendingBlock& block) { this->write(block); })
  {
    this->Index.codec = codec;
    this->Index.blocks.resize(tables.size());
    this->Index.tables = std::move(tables);
    this->IndexBytes = static_cast<std::int64_t>(this->Index.serialize().size());
  }

  /** Submits a block: copies its columns, since the caller may reuse them, and waits for earlier
   * blocks if too much memory would be in use. */
  void submit(int table, std::int64_t rows, std::span<const std::span<const std::byte>> columns)
  {
    std::size_t bytes = 0;
    for (const std::span<const std::byte> column : columns)
    {
      bytes += column.size();
    }
    while (this->Blocks.size() > 0 && this->PendingBytes + bytes > this->Blocks.most() * BlockBytes)
    {
      this->Blocks.takeOldest();
    }
    PendingBlock& block = this->Blocks.next();
    block.table = table;
    block.rows = rows;
    block.plain.clear();
    block.plain.reserve(bytes);
    block.entries.clear();
    for (const std::span<const std::byte> column : columns)
    {
      block.plain.insert(block.plain.end(), column.begin(), column.end());
      block.entries.push_back({ 0, static_cast<std::uint32_t>(column.size()), 0 });
    }
    this->PendingBytes += bytes;
    this->IndexBytes += indexBytesOfBlock(columns.size());
    ++this->Appended[static_cast<std::size_t>(table)];
    this->Blocks.submit();
  }

  /** Compresses the columns of a block, each for itself, so that a reader may read one of them. On
   * any thread. */
  void compress(PendingBlock& block) const
  {
    if (!block.coder)
    {
      block.coder = std::make_unique<ColumnCodec>(this->Index.codec);
    }
    block.stored.clear();
    std::span<const std::byte> rest = block.plain;
    const TableSpec& spec = this->Index.tables[block.table];
    for (std::size_t c = 0; c < block.entries.size(); c++)
    {
      ColumnEntry& entry = block.entries[c];
      const std::span stored =
        block.coder->compress(rest.first(entry.plainBytes), spec.columns[c].tupleBytes());
      entry.storedBytes = static_cast<std::uint32_t>(stored.size());
      entry.checksum = checksum(stored);
      block.stored.insert(block.stored.end(), stored.begin(), stored.end());
      rest = rest.subspan(entry.plainBytes);
    }
  }

  void write(PendingBlock& block)
  {
    // The index is written in the same order as the blocks.
    this->PendingBytes -= block.plain.size();
    TableIndex& index = this->Index.blocks[block.table];
    index.offset.push_back(this->Behind->offset());
    index.firstRow.push_back(index.firstRow.back() + block.rows);
    index.entries.insert(index.entries.end(), block.entries.begin(), block.entries.end());
    this->put(block.stored);
    if (block.plain.size() > BlockBytes && this->Blocks.most() > 1)
    {
      block = PendingBlock(); // else each pending block would keep that much memory
    }
  }

  void put(std::span<const std::byte> bytes)
  {
    const std::int64_t waited = this->Behind->waitNanoseconds();
    this->Behind->put(bytes);
    this->count(static_cast<std::int64_t>(bytes.size()), this->Behind->waitNanoseconds() - waited);
  }

  void count(std::int64_t bytes, std::int64_t waited)
  {
    if (this->Statistics)
    {
      this->Statistics->bytesWritten += bytes;
      this->Statistics->waitNanoseconds += waited;
    }
  }

  void checkWritten()
  {
    // A write fails behind the caller, who learns of it with the next block or at the end.
    if (const int error = this->Behind->failed(); error != 0)
    {
      FileDescriptor::throwWriteError(this->Path, error);
    }
  }

  std::string place(int table) const
  {
    return this->Path.string() + ": table '" + this->Index.tables[table].name + "', block " +
           std::to_string(this->Appended[static_cast<std::size_t>(table)]);
  }

  void checkColumns(
    int table, std::int64_t rows, std::span<const std::span<const std::byte>> columns) const
  {
    if (table < 0 || table >= static_cast<int>(this->Index.tables.size()))
    {
      throw Error(this->Path.string() + ": there is no table " + std::to_string(table) + ".");
    }
    const TableSpec& spec = this->Index.tables[table];
    if (rows < 0 || columns.size() != spec.columns.size())
    {
      throw Error(this->place(table) + ": " + std::to_string(rows) + " rows of " +
                  std::to_string(columns.size()) + " columns cannot be written to a table of " +
                  std::to_string(spec.columns.size()) + " columns.");
    }
    for (std::size_t c = 0; c < columns.size(); c++)
    {
      const std::size_t tuple = spec.columns[c].tupleBytes();
      const std::size_t size = columns[c].size();
      // Sizes are stored with 32 bits, and a reader allocates what they say.
      if (size > MaxColumnBytes ||
          (tuple > 0 && (size % tuple != 0 || size / tuple != std::size_t(rows))))
      {
        throw Error(this->place(table) + ": column '" + spec.columns[c].name + "' has " +
                    std::to_string(size) + " bytes, which do not go with " + std::to_string(rows) +
                    " rows of " + std::to_string(tuple) +
                    " bytes, or are more than a block may have.");
      }
    }
  }

  /** Refuses another block where its index would be too large to be read. */
  void checkIndex(std::size_t columns) const
  {
    if (this->IndexBytes + indexBytesOfBlock(columns) > MaxIndexBytes)
    {
      throw Error(this->Path.string() + ": the index of its blocks would have more than " +
                  mebibytes(MaxIndexBytes) + ", which are not read: leave columns out.");
    }
  }

  void writeFront(const std::string& header, std::span<const std::byte> tail, std::int64_t offset)
  {
    BlockFileFront front{};
    std::memcpy(front.magic, BlockFileMagic.data(), sizeof(front.magic));
    front.version = BlockFileVersion;
    front.order = BlockFileFront::OrderMark;
    front.tailOffset = offset;
    front.tailBytes = static_cast<std::int64_t>(tail.size());
    // The front has the places and checksums of everything else, and a checksum of itself at its
    // end.
    front.tailChecksum = checksum(tail);
    front.headerBytes = static_cast<std::int64_t>(header.size());
    front.headerChecksum = checksum(std::as_bytes(std::span(header)));
    const auto bytes = std::as_bytes(std::span(&front, 1));
    front.frontChecksum = checksum(bytes.first(offsetof(BlockFileFront, frontChecksum)));
    // The whole region is written, with zeros behind the header, so that the same content has the
    // same bytes.
    std::vector<std::byte> region(BlockFileHeaderBytes);
    std::memcpy(region.data(), &front, sizeof(front));
    std::memcpy(region.data() + sizeof(front), header.data(), header.size());
    this->File.write(0, region);
    this->count(BlockFileHeaderBytes, 0);
  }

  std::filesystem::path Path;
  IoStatistics* Statistics;
  BlockFileIndex Index;
  FileDescriptor File;
  std::unique_ptr<WriteBehind> Behind;
  std::vector<std::int64_t> Appended; ///< blocks of each table
  std::int64_t IndexBytes = 0;        ///< so far
  std::size_t PendingBytes = 0;       ///< of the blocks that are being compressed
  Workers Alone{ 1 };
  OrderedJobs<PendingBlock> Blocks;
};

BlockFileWriter::BlockFileWriter(std::filesystem::path path, std::vector<TableSpec> tables,
  Codec codec, IoStatistics* statistics, Workers* workers)
  : Self(std::make_unique<Implementation>(
      std::move(path), std::move(tables), codec, statistics, workers))
{
}

BlockFileWriter::~BlockFileWriter() = default;

std::int64_t BlockFileWriter::memoryFor(const Workers& workers)
{
  // The context of zstd; a block, its largest column regrouped and compressed, and the result.
  constexpr std::size_t context = std::size_t(640) << 10;
  return workers.threads() > 1
           ? static_cast<std::int64_t>(blocksAtOnce(&workers) * (context + 4 * BlockBytes))
           : 0;
}

void BlockFileWriter::append(
  int table, std::int64_t rows, std::span<const std::span<const std::byte>> columns)
{
  Implementation& self = *this->Self;
  self.checkColumns(table, rows, columns);
  self.checkIndex(columns.size());
  // A failure is reported before more work is done for the file.
  self.checkWritten();
  self.submit(table, rows, columns);
}

void BlockFileWriter::finish(const std::string& header)
{
  Implementation& self = *this->Self;
  constexpr std::size_t most = BlockFileHeaderBytes - sizeof(BlockFileFront);
  if (header.size() > most)
  {
    throw Error(self.Path.string() + ": the header has " + std::to_string(header.size()) +
                " bytes, but a block file has room for " + std::to_string(most) + ".");
  }
  self.Blocks.takeAll();
  const std::int64_t tailOffset = self.Behind->offset();
  // The index follows the blocks, since it is complete only after them.
  const std::vector<std::byte> tail = self.Index.serialize();
  self.put(tail);
  const std::int64_t waited = self.Behind->waitNanoseconds();
  // The index must be written before it is known whether all writes have succeeded.
  self.Behind->flush();
  self.count(0, self.Behind->waitNanoseconds() - waited);
  self.checkWritten();
  self.writeFront(header, tail, tailOffset);
  // The thread uses the file, which renameTo() closes.
  self.Behind.reset();
  self.File.renameTo(self.Path);
}

} // namespace smg
