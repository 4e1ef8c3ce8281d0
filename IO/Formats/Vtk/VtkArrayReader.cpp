// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkArrayReader.h"

#include "IO/Files/ByteOrder.h"
#include "IO/Files/FileNames.h"
#include "smg/Error.h"

#include <algorithm>
#include <string>

namespace smg
{

VtkArrayReader::VtkArrayReader(InputFile& file, const VtkArray& array, Workspace& workspace)
  : File(file)
  , Array(array)
  , Left(array.values)
{
  if (array.opener)
  {
    // Its library may be used by one thread at a time.
    constexpr std::size_t ChunkBytes = std::size_t(64) << 10;
    this->Bytes = array.opener->open(file, this->Array, workspace.pool());
    this->Decoded.resize(ChunkBytes);
    return;
  }
  if (array.encoding == VtkEncoding::Text)
  {
    this->Text.emplace(file, array.begin);
  }
  else
  {
    this->openBytes(workspace.pool());
  }
  // Here, since each thread that allocates memory costs an arena of address space.
  file.at(array.begin);
  this->Ahead = std::make_unique<RowPrefetch<std::byte>>(
    workspace, [this](std::span<std::byte> bytes) { return this->decode(bytes); },
    this->aheadMemory());
}

std::size_t VtkArrayReader::aheadMemory() const
{
  constexpr std::size_t Most = std::size_t(512) << 10, Least = 128;
  const auto size = static_cast<std::int64_t>(sizeOf(this->Array.type));
  return this->Left >= 0 && this->Left < std::int64_t(Most) / (2 * size)
           ? std::max(Least, static_cast<std::size_t>(2 * size * this->Left))
           : Most;
}

void VtkArrayReader::openBytes(Pool& pool)
{
  const auto size = static_cast<std::uint64_t>(sizeOf(this->Array.type));
  const std::int64_t values = this->Array.values;
  std::uint64_t bytes = 0;
  if (this->Array.headerBytes == 0)
  {
    bytes = static_cast<std::uint64_t>(values) * size;
    this->Bytes = bytesAt(this->File, this->Array.encoding, this->Array.begin);
  }
  else if (this->Array.compression != VtkCompression::None)
  {
    auto compressed = std::make_unique<CompressedBytes>(this->File, this->Array, pool);
    bytes = compressed->bytes();
    this->Bytes = std::move(compressed);
  }
  else
  {
    this->Bytes = bytesAt(this->File, this->Array.encoding, this->Array.begin);
    bytes = this->Bytes->integer(this->Array.headerBytes, this->Array.byteOrder);
  }
  if (this->Array.compression == VtkCompression::None && bytes > this->File.size())
  {
    this->fail("has " + std::to_string(bytes) +
               " bytes, more than the file: it is truncated or "
               "damaged");
  }
  if (values >= 0 && bytes != static_cast<std::uint64_t>(values) * size)
  {
    this->fail("has " + std::to_string(bytes) + " bytes, not " +
               std::to_string(static_cast<std::uint64_t>(values) * size));
  }
  this->Left = static_cast<std::int64_t>(bytes / size);
}

void VtkArrayReader::fail(const std::string& sentence) const
{
  this->failAt(this->Array.begin, sentence);
}

void VtkArrayReader::failAt(std::size_t offset, const std::string& sentence) const
{
  const std::string what =
    "the array " + (this->Array.name.empty() ? "" : inQuotes(this->Array.name) + ' ') + sentence;
  if (this->Array.opener)
  {
    throw Error(this->File.name() + ": " + what + '.');
  }
  this->File.fail(offset, what);
}

void VtkArrayReader::failShort() const
{
  this->failAt(this->Text ? this->Text->offset() : this->Array.begin,
    "has fewer numbers than it should: the file is truncated or a count is wrong");
}

std::size_t VtkArrayReader::decode(std::span<std::byte> bytes)
{
  const std::size_t size = sizeOf(this->Array.type);
  std::size_t count = bytes.size() / size;
  if (this->Left >= 0)
  {
    count = std::min(count, static_cast<std::size_t>(this->Left));
  }
  if (this->Text)
  {
    count = this->Text->read(this->Array.type, bytes.data(), count);
  }
  else
  {
    this->Bytes->read(bytes.first(count * size));
    toByteOrder(this->Array.byteOrder, bytes.first(count * size), size);
  }
  this->Left -= this->Left >= 0 ? static_cast<std::int64_t>(count) : 0;
  return count * size;
}

std::span<const std::byte> VtkArrayReader::some(std::size_t most)
{
  const std::size_t bytes = most * sizeOf(this->Array.type);
  if (!this->Ahead)
  {
    const std::span<std::byte> decoded(this->Decoded.data(), std::min(bytes, this->Decoded.size()));
    return decoded.first(this->decode(decoded));
  }
  this->File.poll();
  return this->Ahead->some(bytes);
}

void VtkArrayReader::read(std::byte* values, std::size_t count)
{
  const std::size_t size = sizeOf(this->Array.type);
  while (count > 0)
  {
    const std::span<const std::byte> some = this->some(count);
    if (some.empty())
    {
      this->failShort();
    }
    values = std::ranges::copy(some, values).out;
    count -= some.size() / size;
  }
}

void VtkArrayReader::skip(std::int64_t count)
{
  const std::size_t size = sizeOf(this->Array.type);
  while (count > 0)
  {
    const std::span<const std::byte> some = this->some(static_cast<std::size_t>(count));
    if (some.empty())
    {
      this->failShort();
    }
    count -= static_cast<std::int64_t>(some.size() / size);
  }
}

VtkIndexReader::VtkIndexReader(InputFile& file, const VtkArray& array, Workspace& workspace)
  : Values(file, array, workspace)
  , Integers(ChunkIntegers)
{
  if (array.type == ScalarType::Float32 || array.type == ScalarType::Float64)
  {
    this->fail("should have integers, not numbers of type " + std::string(nameOf(array.type)));
  }
}

void VtkIndexReader::readChunk()
{
  if (this->Integers.size() < this->End + ChunkIntegers)
  {
    this->Integers.resize(this->End + ChunkIntegers);
  }
  const std::span<const std::byte> bytes = this->Values.some(ChunkIntegers);
  std::int64_t* const to = this->Integers.data() + this->End;
  dispatch(this->Values.array().type,
    [&]<class T>(T)
    {
      const T* const from = reinterpret_cast<const T*>(bytes.data());
      std::transform(from, from + bytes.size() / sizeof(T), to,
        [](T value) { return static_cast<std::int64_t>(value); });
      this->End += bytes.size() / sizeof(T);
    });
}

void VtkIndexReader::refill(std::size_t count)
{
  std::copy(this->Integers.begin() + static_cast<std::ptrdiff_t>(this->At),
    this->Integers.begin() + static_cast<std::ptrdiff_t>(this->End), this->Integers.begin());
  this->End -= this->At;
  this->At = 0;
  while (this->End < count)
  {
    const std::size_t before = this->End;
    this->readChunk();
    if (this->End == before)
    {
      this->Values.failShort();
    }
  }
}

void VtkIndexReader::skip(std::int64_t count)
{
  while (count > 0)
  {
    const auto part = std::min<std::int64_t>(count, ChunkIntegers);
    this->next(static_cast<std::size_t>(part));
    count -= part;
  }
}

bool VtkIndexReader::atEnd()
{
  if (this->At == this->End)
  {
    this->At = this->End = 0;
    this->readChunk();
  }
  return this->At == this->End;
}

} // namespace smg
