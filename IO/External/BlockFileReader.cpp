// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"

#include "IO/External/Codec.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/Checksum.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

// Reading a block file. Opening verifies front, header and index with their checksums, and that the
// index accounts for every byte of the file; reading verifies the checksum of the column of the
// block. What has been verified is trusted, so the checks come in an order in which nothing is used
// before its own checksum.

namespace smg
{

void BlockFileReader::fail(const std::string& what) const
{
  throw Error(oneLine(this->Name + ": " + what));
}

/** Reads and checks the front. */
BlockFileFront BlockFileReader::readFront(std::span<std::byte> region) const
{
  const std::size_t there = this->File.readSome(0, region);
  BlockFileFront front{};
  std::memcpy(&front, region.data(), std::min(there, sizeof(front)));
  // First whether it is such a file at all, then whether this program can read it, then whether
  // it is damaged: so that the message says what to do.
  if (std::string_view(front.magic, sizeof(front.magic)) != BlockFileMagic)
  {
    this->fail(
      "is not a file of this kind: it does not begin with " + std::string(BlockFileMagic) + ".");
  }
  if (there < region.size())
  {
    this->fail("is truncated: it has only " + std::to_string(there) + " bytes.");
  }
  if (front.order != BlockFileFront::OrderMark)
  {
    this->fail("was written on a machine with another byte order; create it again on this one.");
  }
  if (front.version != BlockFileVersion)
  {
    this->fail("is of version " + std::to_string(front.version) + ", but this program reads " +
               std::to_string(BlockFileVersion) + "; create it again with this program.");
  }
  if (front.frontChecksum != checksum(region.first(offsetof(BlockFileFront, frontChecksum))))
  {
    this->fail("the checksum of its first bytes is wrong: the file is damaged; create it again.");
  }
  return front;
}

/** Refuses an index that no writer makes before it is read. */
void BlockFileReader::checkIndexBytes(const BlockFileFront& front) const
{
  if (front.tailBytes > MaxIndexBytes)
  {
    this->fail("has an index of " + mebibytes(front.tailBytes) + ", but at most " +
               mebibytes(MaxIndexBytes) +
               " are read: it has too many blocks or columns; create it again, without columns "
               "that are not needed.");
  }
}

void BlockFileReader::checkLength(const BlockFileFront& front) const
{
  const std::int64_t size = this->File.size();
  // The sum of both must not overflow.
  const std::int64_t most = INT64_MAX / 2;
  if (front.tailOffset < BlockFileHeaderBytes || front.tailOffset > most || front.tailBytes < 0 ||
      front.tailBytes > most)
  {
    this->fail("its first bytes are invalid: the file is damaged; create it again.");
  }
  const std::int64_t expected = front.tailOffset + front.tailBytes;
  // A file that was cut off, or had something appended, is found without reading it.
  if (size != expected)
  {
    this->fail((size < expected ? "is truncated: it has " : "has bytes appended: it has ") +
               std::to_string(size) + " bytes instead of " + std::to_string(expected) + ".");
  }
}

BlockFileReader::BlockFileReader(const std::filesystem::path& path, IoStatistics* statistics)
  : Name(path.string())
  , Statistics(statistics)
  , File(FileDescriptor::openForReading(path))
{
  std::vector<std::byte> region(BlockFileHeaderBytes);
  const BlockFileFront front = this->readFront(region);
  this->checkLength(front);
  this->checkIndexBytes(front);
  const std::span<std::byte> rest = std::span(region).subspan(sizeof(front));
  // The front is sound, but may have been made on purpose: its numbers are compared with the
  // room.
  const bool fits =
    front.headerBytes >= 0 && front.headerBytes <= static_cast<std::int64_t>(rest.size());
  const auto header = rest.first(fits ? front.headerBytes : 0);
  const auto zeros = rest.subspan(header.size());
  if (!fits || checksum(header) != front.headerChecksum ||
      std::any_of(zeros.begin(), zeros.end(), [](std::byte b) { return b != std::byte{}; }))
  {
    this->fail("the checksum of the header is wrong: the file is damaged; create it again.");
  }
  this->Header.assign(reinterpret_cast<const char*>(header.data()), header.size());
  if (!nlohmann::json::accept(this->Header))
  {
    this->fail("the header is not JSON: the file is damaged; create it again.");
  }
  std::vector<std::byte> tail(front.tailBytes);
  this->File.read(front.tailOffset, tail);
  if (checksum(tail) != front.tailChecksum)
  {
    this->fail("the checksum of the index is wrong: the file is damaged; create it again.");
  }
  this->IndexBytes = front.tailBytes;
  this->Index = BlockFileIndex::parse(tail, front.tailOffset, this->Name);
  this->Coder = std::make_unique<ColumnCodec>(this->Index.codec);
  // The front has the checksums of header and index, and the index those of all columns: one
  // number stands for the whole file.
  this->ContentChecksum = front.frontChecksum;
  this->count(BlockFileHeaderBytes + front.tailBytes, 0);
}

void BlockFileReader::check(int table, std::int64_t block) const
{
  if (table < 0 || table >= static_cast<int>(this->Index.tables.size()) || block < 0 ||
      block >= this->Index.blocks[table].blocks())
  {
    this->fail(
      "there is no block " + std::to_string(block) + " of table " + std::to_string(table) + ".");
  }
}

void BlockFileReader::count(std::int64_t bytes, std::int64_t waited)
{
  if (this->Statistics)
  {
    this->Statistics->bytesRead += bytes;
    this->Statistics->waitNanoseconds += waited;
  }
}

/** Reads the stored bytes of a column. */
void BlockFileReader::readStored(
  int table, std::int64_t block, int column, std::span<std::byte> bytes)
{
  // The columns of a block follow each other in the file.
  std::int64_t offset = this->Index.blocks[table].offset[block];
  // The index has the place of the block; columns have no places of their own.
  for (int c = 0; c < column; c++)
  {
    offset += this->Index.entry(table, block, c).storedBytes;
  }
  std::int64_t waited = 0;
  if (const int error = this->File.tryRead(offset, bytes, waited); error != 0)
  {
    FileDescriptor::throwReadError(this->Name, error);
  }
  this->count(std::ssize(bytes), waited);
}

BlockFileReader::~BlockFileReader() = default;

std::int64_t BlockFileReader::blockOf(int table, std::int64_t row) const
{
  const auto& firstRow = this->Index.blocks[table].firstRow;
  if (row < 0 || row >= firstRow.back())
  {
    this->fail(
      "table '" + this->tables()[table].name + "' has no row " + std::to_string(row) + ".");
  }
  return std::upper_bound(firstRow.begin(), firstRow.end(), row) - firstRow.begin() - 1;
}

std::int64_t BlockFileReader::storedBytes(int table, int column) const
{
  std::int64_t bytes = 0;
  for (std::int64_t block = 0; block < this->blocks(table); block++)
  {
    bytes += this->Index.entry(table, block, column).storedBytes;
  }
  return bytes;
}

void BlockFileReader::read(int table, std::int64_t block, int column, std::span<std::byte> bytes)
{
  this->check(table, block);
  const ColumnEntry& entry = this->Index.entry(table, block, column);
  const ColumnSpec& spec = this->Index.tables[table].columns[column];
  // Callers size their memory by the index; a mismatch would be a fault of the program, not of the
  // file.
  if (bytes.size() != entry.plainBytes)
  {
    this->fail(this->place(table, block) + ": column '" + spec.name + "' has " +
               std::to_string(entry.plainBytes) + " bytes, not " + std::to_string(bytes.size()) +
               ".");
  }
  // Columns that compression does not make smaller are stored as they are, and read straight to the
  // caller.
  const bool compressed = entry.storedBytes < entry.plainBytes;
  // One buffer for all reads, which grows to the largest column.
  if (compressed && this->Stored.size() < entry.storedBytes)
  {
    this->Stored.resize(entry.storedBytes);
  }
  const std::span<std::byte> stored =
    compressed ? std::span(this->Stored).first(entry.storedBytes) : bytes;
  this->readStored(table, block, column, stored);
  // Compared before decompression, so that decoders see only what an encoder has made.
  if (checksum(stored) != entry.checksum)
  {
    this->fail(this->place(table, block) + ": the checksum of column '" + spec.name +
               "' is wrong: the file is damaged; create it again.");
  }
  if (compressed && !this->Coder->decompress(stored, bytes, spec.tupleBytes()))
  {
    this->fail(this->place(table, block) + ": column '" + spec.name +
               "' cannot be decompressed: the file is damaged; create it again.");
  }
}

void BlockFileReader::prefetch(int table, std::int64_t block)
{
  this->check(table, block);
  // All columns of a block in one request: they are contiguous.
  std::size_t bytes = 0;
  for (std::size_t c = 0; c < this->Index.tables[table].columns.size(); c++)
  {
    bytes += this->Index.entry(table, block, static_cast<int>(c)).storedBytes;
  }
  if (bytes > 0)
  {
    this->File.willRead(this->Index.blocks[table].offset[block], bytes);
  }
}

bool isBlockFile(const std::filesystem::path& path)
{
  try
  {
    std::array<char, BlockFileMagic.size()> magic{};
    const FileDescriptor file = FileDescriptor::openForReading(path);
    return file.readSome(0, std::as_writable_bytes(std::span(magic))) == magic.size() &&
           std::string_view(magic.data(), magic.size()) == BlockFileMagic;
  }
  // A file that cannot be opened is not a block file; whoever wants to read it gets the error.
  catch (const Error&)
  {
    return false;
  }
}

} // namespace smg
