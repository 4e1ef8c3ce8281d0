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

void VertexSetFile::read(std::span<std::uint8_t> selected)
{
  for (std::uint8_t& bit : selected)
  {
    bit = this->contains(this->Next++) ? 1 : 0;
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
