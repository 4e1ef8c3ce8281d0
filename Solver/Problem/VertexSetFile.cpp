// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/VertexSetFile.h"

// A set of vertices as a scratch file of one bit per vertex, in blocks of 64 KiB, one of which is
// in memory: for sets that are found in one reading of a mesh and used in later ones. Sequential
// reading goes from block to block; contains() loads the block of any vertex.

namespace smg
{

namespace
{

/** The base of the name; the file itself has none in the folder. */
std::filesystem::path inFolder(const std::filesystem::path& folder)
{
  return (folder.empty() ? std::filesystem::temp_directory_path() : folder) / "selected";
}

} // namespace

VertexSetFile::VertexSetFile(const std::filesystem::path& folder)
  : Stream(inFolder(folder), this->Statistics)
  , Bits(BlockBytes)
{
  // Writing; rewind() begins reading passes.
  this->Stream.startPass(true);
}

/** Bits are collected in the block in memory, which is written when the next vertex finds it
 * full. */
void VertexSetFile::append(std::span<const std::uint8_t> selected)
{
  for (const std::uint8_t bit : selected)
  {
    // The block is full.
    if (this->Next == 8 * BlockBytes)
    {
      this->Stream.append(this->Bits);
      this->Bits.assign(BlockBytes, std::byte(0));
      this->Next = 0;
    }
    this->Bits[this->Next / 8] |= std::byte(bit) << (this->Next % 8);
    ++this->Next;
  }
}

void VertexSetFile::finish()
{
  // The last block is written as a whole: bits beyond the last vertex are 0, and not read.
  this->Stream.append(this->Bits);
  this->Stream.endPass();
}

/** For the next reading of the mesh. */
void VertexSetFile::rewind()
{
  this->Stream.startPass(false);
  // As if a block had been read to its end: read() begins by loading the first one.
  this->Next = 8 * BlockBytes;
  this->Loaded = -1;
}

/** In the same steps as append(). */
void VertexSetFile::read(std::span<std::uint8_t> selected)
{
  for (std::uint8_t& bit : selected)
  {
    // All bits of the block in memory have been read.
    if (this->Next == 8 * BlockBytes)
    {
      this->Stream.read(this->Bits);
      this->Next = 0;
    }
    bit =
      std::to_integer<std::uint8_t>(this->Bits[this->Next / 8] >> (this->Next % 8) & std::byte(1));
    ++this->Next;
  }
}

/** One read of a block per call at most; calls in stream order read each block once. */
bool VertexSetFile::contains(std::int64_t vertex)
{
  constexpr auto blockVertices = static_cast<std::int64_t>(8 * BlockBytes);
  // Overwrites the block of sequential reading, hence rewind() before the next read().
  if (const std::int64_t block = vertex / blockVertices; block != this->Loaded)
  {
    this->Stream.read(block, this->Bits);
    this->Loaded = block;
  }
  const auto bit = static_cast<std::size_t>(vertex % blockVertices);
  return std::to_integer<bool>(this->Bits[bit / 8] >> (bit % 8) & std::byte(1));
}

} // namespace smg
