// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <cstring>

// The index of a block file as bytes. parse() is given what may be a damaged file with a right
// checksum, or one made on purpose: counts are bounded by the bytes that are left, sizes and places
// by the file, and the blocks must account for every byte between header and index.

namespace smg
{

namespace
{

/** Appends numbers in the byte order of the machine, without alignment. */
class Packer
{
public:
  template <class T>
  void put(T value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    this->Bytes.insert(this->Bytes.end(), p, p + sizeof(T));
  }
  void put(const std::string& text)
  {
    this->put(static_cast<std::uint32_t>(text.size()));
    const auto* p = reinterpret_cast<const std::byte*>(text.data());
    this->Bytes.insert(this->Bytes.end(), p, p + text.size());
  }

  std::vector<std::byte> Bytes;
};

/** Reads what a Packer has written, never beyond the end. */
class Unpacker
{
public:
  Unpacker(std::span<const std::byte> bytes, const std::string& file)
    : Bytes(bytes)
    , File(file)
  {
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw Error(oneLine(this->File + ": the index of the file is invalid (" + what +
                        "): the file is damaged; create it again."));
  }

  template <class T>
  T get()
  {
    T value;
    std::memcpy(&value, this->take(sizeof(T)), sizeof(T));
    return value;
  }

  std::string getText()
  {
    const auto size = this->get<std::uint32_t>();
    return { reinterpret_cast<const char*>(this->take(size)), size };
  }

  /** Reads a count of items of at least `bytes` bytes each, which bounds it. */
  std::size_t getCount(std::size_t bytes)
  {
    const auto count = this->get<std::uint64_t>();
    // Before memory is allocated for the items.
    if (count > this->Bytes.size() / bytes)
    {
      this->fail("a count is too large");
    }
    return count;
  }

  bool atEnd() const { return this->Bytes.empty(); }

private:
  const std::byte* take(std::size_t size)
  {
    if (size > this->Bytes.size())
    {
      this->fail("it ends too early");
    }
    const std::byte* p = this->Bytes.data();
    this->Bytes = this->Bytes.subspan(size);
    return p;
  }

  std::span<const std::byte> Bytes;
  const std::string& File;
};

TableSpec parseTable(Unpacker& from)
{
  TableSpec table;
  table.name = from.getText();
  // Nine bytes at least: the length of the name, the type and the number of components.
  const std::size_t columns = from.getCount(9);
  for (std::size_t c = 0; c < columns; c++)
  {
    ColumnSpec column;
    column.name = from.getText();
    const auto type = from.get<std::uint8_t>();
    column.components = from.get<std::int32_t>();
    if (type > static_cast<int>(ScalarType::Float64) || column.components < 0 ||
        column.components > MaxColumnBytes / 8)
    {
      from.fail("column '" + column.name + "' has an unknown type");
    }
    column.type = static_cast<ScalarType>(type);
    table.columns.push_back(std::move(column));
  }
  return table;
}

/** Reads the blocks of a table; returns their number of bytes in the file. */
std::int64_t parseBlocks(
  Unpacker& from, const TableSpec& table, Codec codec, std::int64_t tailOffset, TableIndex& index)
{
  const std::size_t columns = table.columns.size();
  // Rows, offset, and an entry for each column.
  const std::size_t blocks = from.getCount(static_cast<std::size_t>(indexBytesOfBlock(columns)));
  index.firstRow.reserve(blocks + 1);
  index.offset.reserve(blocks);
  index.entries.reserve(blocks * columns);
  std::int64_t total = 0;
  for (std::size_t b = 0; b < blocks; b++)
  {
    const auto rows = from.get<std::int64_t>();
    const auto offset = from.get<std::int64_t>();
    std::int64_t bytes = 0;
    bool good = rows >= 0 && rows <= INT64_MAX - index.firstRow.back();
    for (const ColumnSpec& column : table.columns)
    {
      const auto entry = from.get<ColumnEntry>();
      const auto tuple = static_cast<std::int64_t>(column.tupleBytes());
      // Stored bytes are never more than plain ones, and without compression the same; columns that
      // are not opaque have one tuple for each row.
      good = good && entry.plainBytes <= MaxColumnBytes && entry.storedBytes <= entry.plainBytes &&
             (codec != Codec::None || entry.storedBytes == entry.plainBytes) &&
             (tuple == 0 ||
               (rows <= MaxColumnBytes / tuple && std::int64_t(entry.plainBytes) == rows * tuple));
      bytes += entry.storedBytes;
      index.entries.push_back(entry);
    }
    if (!good || offset < BlockFileHeaderBytes || offset > tailOffset ||
        bytes > tailOffset - offset)
    {
      from.fail("table '" + table.name + "', block " + std::to_string(b));
    }
    index.firstRow.push_back(index.firstRow.back() + rows);
    index.offset.push_back(offset);
    total += bytes;
  }
  return total;
}

} // namespace

std::vector<std::byte> BlockFileIndex::serialize() const
{
  Packer to;
  to.put(static_cast<std::uint8_t>(this->codec));
  to.put(static_cast<std::uint64_t>(this->tables.size()));
  for (std::size_t t = 0; t < this->tables.size(); t++)
  {
    const TableSpec& table = this->tables[t];
    to.put(table.name);
    to.put(static_cast<std::uint64_t>(table.columns.size()));
    for (const ColumnSpec& column : table.columns)
    {
      to.put(column.name);
      to.put(static_cast<std::uint8_t>(column.type));
      to.put(static_cast<std::int32_t>(column.components));
    }
    const TableIndex& index = this->blocks[t];
    to.put(static_cast<std::uint64_t>(index.blocks()));
    for (std::int64_t b = 0; b < index.blocks(); b++)
    {
      to.put(index.firstRow[b + 1] - index.firstRow[b]);
      to.put(index.offset[b]);
      for (std::size_t c = 0; c < table.columns.size(); c++)
      {
        to.put(this->entry(static_cast<int>(t), b, static_cast<int>(c)));
      }
    }
  }
  return std::move(to.Bytes);
}

BlockFileIndex BlockFileIndex::parse(
  std::span<const std::byte> bytes, std::int64_t tailOffset, const std::string& file)
{
  Unpacker from(bytes, file);
  BlockFileIndex index;
  const auto codec = from.get<std::uint8_t>();
  if (codec > static_cast<int>(Codec::Zstd))
  {
    from.fail("the compression is unknown");
  }
  index.codec = static_cast<Codec>(codec);
  // Twenty bytes at least: the length of the name and the numbers of columns and blocks.
  const std::size_t tables = from.getCount(20);
  std::int64_t total = 0;
  for (std::size_t t = 0; t < tables; t++)
  {
    index.tables.push_back(parseTable(from));
    total +=
      parseBlocks(from, index.tables.back(), index.codec, tailOffset, index.blocks.emplace_back());
  }
  // Blocks that overlap, or bytes that belong to no block, show in the sum.
  if (!from.atEnd() || total != tailOffset - BlockFileHeaderBytes)
  {
    from.fail("it does not cover all bytes");
  }
  return index;
}

} // namespace smg
