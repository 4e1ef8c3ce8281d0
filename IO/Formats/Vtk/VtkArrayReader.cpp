// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkArrayReader.h"

#include "IO/Files/ByteOrder.h"
#include "IO/Files/InQuotes.h"
#include "smg/Error.h"

#include <algorithm>
#include <string>

namespace smg
{

VtkArrayReader::VtkArrayReader(InputFile& file, const VtkArray& array, Pool& pool)
  : File(file)
  , Array(array)
  , Left(array.values)
{
  if (array.opener)
  {
    this->Bytes = array.opener->open(file, this->Array, pool);
    return;
  }
  if (array.encoding == VtkEncoding::Text)
  {
    this->Text.emplace(file, array.begin);
    return;
  }
  const auto size = static_cast<std::uint64_t>(sizeOf(array.type));
  std::uint64_t bytes = 0;
  if (array.headerBytes == 0)
  {
    bytes = static_cast<std::uint64_t>(array.values) * size;
    this->Bytes = bytesAt(file, array.encoding, array.begin);
  }
  else if (array.compression != VtkCompression::None)
  {
    auto compressed = std::make_unique<CompressedBytes>(file, this->Array, pool);
    bytes = compressed->bytes();
    this->Bytes = std::move(compressed);
  }
  else
  {
    this->Bytes = bytesAt(file, array.encoding, array.begin);
    bytes = this->Bytes->integer(array.headerBytes, array.byteOrder);
  }
  if (array.compression == VtkCompression::None && bytes > file.size())
  {
    this->fail("has " + std::to_string(bytes) +
               " bytes, more than the file: it is truncated or "
               "damaged");
  }
  if (array.values >= 0 && bytes != static_cast<std::uint64_t>(array.values) * size)
  {
    this->fail("has " + std::to_string(bytes) + " bytes, not " +
               std::to_string(static_cast<std::uint64_t>(array.values) * size));
  }
  this->Left = static_cast<std::int64_t>(bytes / size);
}

std::int64_t VtkArrayReader::bytes() const
{
  return this->Left < 0 ? -1 : this->Left * static_cast<std::int64_t>(sizeOf(this->Array.type));
}

void VtkArrayReader::fail(const std::string& sentence) const
{
  const std::string what =
    "the array " + (this->Array.name.empty() ? "" : inQuotes(this->Array.name) + ' ') + sentence;
  if (this->Array.opener)
  {
    throw Error(this->File.name() + ": " + what + '.');
  }
  this->File.fail(this->Text ? this->Text->offset() : this->Array.begin, what);
}

std::size_t VtkArrayReader::readSome(std::byte* values, std::size_t count)
{
  if (this->Left >= 0)
  {
    count = static_cast<std::size_t>(
      std::min<std::int64_t>(static_cast<std::int64_t>(count), this->Left));
  }
  if (this->Text)
  {
    count = this->Text->read(this->Array.type, values, count);
  }
  else
  {
    const std::size_t size = sizeOf(this->Array.type);
    this->Bytes->read({ values, count * size });
    toByteOrder(this->Array.byteOrder, { values, count * size }, size);
  }
  this->Left -= this->Left >= 0 ? static_cast<std::int64_t>(count) : 0;
  return count;
}

void VtkArrayReader::read(std::byte* values, std::size_t count)
{
  if (this->readSome(values, count) < count)
  {
    this->fail("has fewer numbers than it should: the file is truncated or a count is wrong");
  }
}

void VtkArrayReader::skip(std::int64_t count)
{
  constexpr std::int64_t Chunk = 8192;
  std::vector<std::byte> ignored(Chunk * sizeOf(this->Array.type));
  for (std::int64_t left = count; left > 0; left -= std::min(left, Chunk))
  {
    this->read(ignored.data(), static_cast<std::size_t>(std::min(left, Chunk)));
  }
}

VtkIndexReader::VtkIndexReader(InputFile& file, const VtkArray& array, Pool& pool)
  : Values(file, array, pool)
  , Bytes(ChunkIntegers * sizeOf(array.type))
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
  const std::size_t count = this->Values.readSome(this->Bytes.data(), ChunkIntegers);
  std::int64_t* const to = this->Integers.data() + this->End;
  dispatch(this->Values.array().type,
    [&]<class T>(T)
    {
      const T* const from = reinterpret_cast<const T*>(this->Bytes.data());
      std::transform(
        from, from + count, to, [](T value) { return static_cast<std::int64_t>(value); });
    });
  this->End += count;
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
      this->fail("has fewer numbers than it should: the file is truncated or a count is wrong");
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
