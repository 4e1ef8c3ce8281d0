// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/VertexFile.h"

#include <algorithm>

// What is known of each vertex in one reading of a mesh and used in later ones: numbers, read
// anywhere, and sets, as one bit per vertex in blocks of 64 KiB, one of which is in memory.

namespace smg
{

/** Values go to a scratch file where there is a folder for these, and otherwise stay in memory,
 * which the pool accounts for. */
VertexFile::VertexFile(const VertexStorage& storage, int lanes)
  : Memory(&storage.pool)
  , Traffic(&storage.traffic)
  , Lanes(static_cast<std::size_t>(lanes))
{
  if (storage.folder)
  {
    this->File.create(storage.folder->path());
  }
  else
  {
    this->Values = Buffer(storage.pool, 0);
  }
}

void VertexFile::restart()
{
  this->Vertices = 0;
  this->File.restart();
}

void VertexFile::append(std::span<const double> values)
{
  const std::size_t begin = static_cast<std::size_t>(this->Vertices) * this->Lanes * sizeof(double);
  const std::size_t end = begin + values.size_bytes();
  this->Vertices += static_cast<std::int64_t>(values.size() / this->Lanes);
  if (this->File.isOpen())
  {
    this->File.append(std::as_bytes(values));
    this->Traffic->bytesWritten += static_cast<std::int64_t>(values.size_bytes());
    return;
  }
  // By an eighth at least, so that appending block by block moves the values only a few times.
  if (end > this->Values.capacity())
  {
    this->Values.grow(*this->Memory, std::max(end, begin + begin / 8));
  }
  this->Values.resize(end); // what a growth keeps
  std::ranges::copy(std::as_bytes(values), this->Values.data() + begin);
}

void VertexFile::read(std::int64_t first, std::int64_t count, double* values) const
{
  const std::size_t tuple = this->Lanes * sizeof(double);
  const std::size_t begin = static_cast<std::size_t>(first) * tuple;
  const std::size_t bytes = static_cast<std::size_t>(count) * tuple;
  if (!this->File.isOpen())
  {
    std::copy_n(this->Values.data() + begin, bytes, reinterpret_cast<std::byte*>(values));
    return;
  }
  this->File.read(
    static_cast<std::int64_t>(begin), { reinterpret_cast<std::byte*>(values), bytes });
  this->Traffic->bytesRead += static_cast<std::int64_t>(bytes);
}

namespace
{

/** The base of the name; the file itself has none in the folder. */
std::filesystem::path inFolder(const std::filesystem::path& folder)
{
  return (folder.empty() ? std::filesystem::temp_directory_path() : folder) / "selected";
}

} // namespace

VertexSetFile::VertexSetFile(const std::filesystem::path& folder)
  : File(inFolder(folder), this->Statistics)
  , Bits(BlockBytes)
{
}

/** Bits are collected in the block in memory, which is written when the next vertex is one of
 * another block. */
void VertexSetFile::append(std::span<const std::uint8_t> selected)
{
  for (const std::uint8_t bit : selected)
  {
    if (this->Next / BlockVertices != this->Block)
    {
      this->finish();
      this->Bits.assign(BlockBytes, std::byte(0));
      ++this->Block;
    }
    const auto place = static_cast<std::size_t>(this->Next++ % BlockVertices);
    this->Bits[place / 8] |= std::byte(bit) << (place % 8);
  }
}

void VertexSetFile::finish()
{
  // The last block is written as a whole, too: bits beyond the last vertex are 0, and not read.
  this->File.write(this->Block, this->Bits);
}

void VertexSetFile::read(std::int64_t first, std::span<std::uint8_t> selected)
{
  for (std::uint8_t& bit : selected)
  {
    bit = this->contains(first++) ? 1 : 0;
  }
}

/** Calls in stream order read each block once. */
bool VertexSetFile::contains(std::int64_t vertex)
{
  if (const std::int64_t block = vertex / BlockVertices; block != this->Block)
  {
    this->File.read(block, this->Bits);
    this->Block = block;
  }
  const auto place = static_cast<std::size_t>(vertex % BlockVertices);
  return std::to_integer<bool>(this->Bits[place / 8] >> (place % 8) & std::byte(1));
}

} // namespace smg
