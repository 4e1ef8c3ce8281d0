// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/VertexSetFile.h"

namespace smg
{

namespace
{

std::filesystem::path inFolder(const std::filesystem::path& folder)
{
  return (folder.empty() ? std::filesystem::temp_directory_path() : folder) / "selected";
}

} // namespace

VertexSetFile::VertexSetFile(const std::filesystem::path& folder)
  : Stream(inFolder(folder), this->Statistics)
  , Bits(BlockBytes)
{
  this->Stream.startPass(true);
}

void VertexSetFile::append(std::span<const std::uint8_t> selected)
{
  for (const std::uint8_t bit : selected)
  {
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
  this->Stream.append(this->Bits);
  this->Stream.endPass();
}

void VertexSetFile::rewind()
{
  this->Stream.startPass(false);
  this->Next = 8 * BlockBytes;
  this->Loaded = -1;
}

void VertexSetFile::read(std::span<std::uint8_t> selected)
{
  for (std::uint8_t& bit : selected)
  {
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

bool VertexSetFile::contains(std::int64_t vertex)
{
  constexpr auto blockVertices = static_cast<std::int64_t>(8 * BlockBytes);
  if (const std::int64_t block = vertex / blockVertices; block != this->Loaded)
  {
    this->Stream.read(block, this->Bits);
    this->Loaded = block;
  }
  const auto bit = static_cast<std::size_t>(vertex % blockVertices);
  return std::to_integer<bool>(this->Bits[bit / 8] >> (bit % 8) & std::byte(1));
}

} // namespace smg
