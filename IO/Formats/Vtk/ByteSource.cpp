// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/ByteSource.h"

#include "IO/Files/ByteOrder.h"

#include <algorithm>
#include <cstring>
#include <lz4.h>
#include <lzma.h>
#include <string>
#include <string_view>
#include <zlib.h>

namespace smg
{

namespace
{

/** The number of compressed sizes read at once, so that the window of the file seldom jumps. */
constexpr std::uint64_t SizesAtOnce = 4096;

bool isXmlBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/** The six bits of each character; -1 for others, -2 for padding. */
constexpr std::array<std::int8_t, 256> SixBits = []
{
  constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> bits{};
  bits.fill(-1);
  for (std::size_t i = 0; i < alphabet.size(); ++i)
  {
    bits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  }
  bits[static_cast<unsigned char>('=')] = -2;
  return bits;
}();

int bitsOf(char c)
{
  return SixBits[static_cast<unsigned char>(c)];
}

std::array<std::byte, 3> bytesOf(int bits)
{
  return { static_cast<std::byte>(bits >> 16), static_cast<std::byte>(bits >> 8),
    static_cast<std::byte>(bits) };
}

bool uncompress(
  VtkCompression compression, std::span<const std::byte> from, std::span<std::byte> to)
{
  if (compression == VtkCompression::Lz4)
  {
    const int bytes = LZ4_decompress_safe(reinterpret_cast<const char*>(from.data()),
      reinterpret_cast<char*>(to.data()), static_cast<int>(from.size()),
      static_cast<int>(to.size()));
    return bytes == static_cast<int>(to.size());
  }
  if (compression == VtkCompression::Lzma)
  {
    // The limit of the highest level of compression, regardless of the request of a damaged file.
    std::uint64_t memory = std::uint64_t(100) << 20;
    std::size_t read = 0, written = 0;
    return lzma_stream_buffer_decode(&memory, 0, nullptr,
             reinterpret_cast<const std::uint8_t*>(from.data()), &read, from.size(),
             reinterpret_cast<std::uint8_t*>(to.data()), &written, to.size()) == LZMA_OK &&
           read == from.size() && written == to.size();
  }
  uLongf bytes = to.size();
  const int result = ::uncompress(reinterpret_cast<Bytef*>(to.data()), &bytes,
    reinterpret_cast<const Bytef*>(from.data()), from.size());
  return result == Z_OK && bytes == to.size();
}

} // namespace

std::uint64_t ByteSource::integer(int bytes, std::endian order)
{
  std::array<std::byte, 8> read{};
  this->read(std::span(read).first(static_cast<std::size_t>(bytes)));
  return bytes == 8 ? numberAt<std::uint64_t>(read.data(), order)
                    : numberAt<std::uint32_t>(read.data(), order);
}

void RawBytes::read(std::span<std::byte> bytes)
{
  while (!bytes.empty())
  {
    const std::string_view text = this->File.at(this->At);
    if (text.empty())
    {
      this->File.fail(this->At, "the file ends within an array: it is truncated");
    }
    const std::size_t part = std::min(bytes.size(), text.size());
    std::memcpy(bytes.data(), text.data(), part);
    bytes = bytes.subspan(part);
    this->At += part;
  }
}

void Base64Bytes::read(std::span<std::byte> bytes)
{
  while (!bytes.empty())
  {
    if (this->Used == this->Size)
    {
      bytes = bytes.subspan(this->decodeRun(bytes));
      if (bytes.empty())
      {
        return;
      }
      this->decodeGroup();
    }
    bytes.front() = this->Group[this->Used++];
    bytes = bytes.subspan(1);
  }
}

std::size_t Base64Bytes::decodeRun(std::span<std::byte> bytes)
{
  const std::string_view text = this->File.at(this->At);
  const std::size_t groups = std::min(bytes.size() / 3, text.size() / 4);
  std::size_t group = 0;
  for (; group < groups; ++group)
  {
    const char* const c = text.data() + 4 * group;
    const int sixes[] = { bitsOf(c[0]), bitsOf(c[1]), bitsOf(c[2]), bitsOf(c[3]) };
    if ((sixes[0] | sixes[1] | sixes[2] | sixes[3]) < 0)
    {
      break;
    }
    const int bits = sixes[0] << 18 | sixes[1] << 12 | sixes[2] << 6 | sixes[3];
    std::ranges::copy(bytesOf(bits), bytes.data() + 3 * group);
  }
  this->At += 4 * group;
  return 3 * group;
}

void Base64Bytes::decodeGroup()
{
  int bits = 0, padding = 0;
  for (int i = 0; i < 4;)
  {
    const std::string_view text = this->File.at(this->At);
    const char c = text.empty() ? '\0' : text.front();
    if (isXmlBlank(c))
    {
      ++this->At;
      continue;
    }
    const int six = bitsOf(c);
    // One or two characters at the end of a unit may be padding.
    if (six == -1 || (six == -2 ? i < 2 : padding > 0))
    {
      this->File.fail(this->At, "the data in base64 end before the array does, or are damaged");
    }
    padding += six == -2 ? 1 : 0;
    bits = bits << 6 | std::max(six, 0);
    ++this->At;
    ++i;
  }
  this->Group = bytesOf(bits);
  this->Size = static_cast<std::size_t>(3 - padding);
  this->Used = 0;
}

CompressedBytes::CompressedBytes(InputFile& file, const VtkArray& array, Pool& pool)
  : File(file)
  , Array(array)
{
  std::size_t begin = array.begin;
  while (array.encoding == VtkEncoding::Base64 && !file.at(begin).empty() &&
         isXmlBlank(file.at(begin).front()))
  {
    ++begin;
  }
  this->Sizes = bytesAt(file, array.encoding, begin);
  this->Blocks = this->Sizes->integer(array.headerBytes, array.byteOrder);
  if (this->Blocks == 0)
  {
    return;
  }
  this->BlockBytes = this->Sizes->integer(array.headerBytes, array.byteOrder);
  this->LastBytes = this->Sizes->integer(array.headerBytes, array.byteOrder);
  constexpr std::uint64_t MaxBlockBytes = std::uint64_t(1) << 30;
  if (this->Blocks > file.size() || this->BlockBytes == 0 || this->BlockBytes > MaxBlockBytes ||
      this->LastBytes > this->BlockBytes)
  {
    file.fail(begin, "the header of the compressed array here cannot be right: it is damaged");
  }
  this->LastBytes = this->LastBytes == 0 ? this->BlockBytes : this->LastBytes;
  this->Bytes = (this->Blocks - 1) * this->BlockBytes + this->LastBytes;
  const std::size_t header = (3 + this->Blocks) * static_cast<std::size_t>(array.headerBytes);
  this->Data = bytesAt(file, array.encoding,
    begin + (array.encoding == VtkEncoding::Base64 ? (header + 2) / 3 * 4 : header));
  // Incompressible data become slightly larger.
  const std::uint64_t compressedBytes = this->BlockBytes + this->BlockBytes / 64 + 1024;
  const std::uint64_t needed = this->BlockBytes + compressedBytes;
  if (static_cast<std::int64_t>(needed) > pool.limit() - pool.used())
  {
    file.fail(begin, "the blocks of the compressed array here need " + std::to_string(needed) +
                       " bytes of memory, more than there is: raise the memory limit, or save the "
                       "file with smaller blocks");
  }
  this->Plain = Buffer(pool, this->BlockBytes);
  this->Compressed = Buffer(pool, compressedBytes);
}

std::uint64_t CompressedBytes::nextSize()
{
  const std::size_t place = this->Block % SizesAtOnce;
  if (place == 0)
  {
    this->Known.resize(std::min(SizesAtOnce, this->Blocks - this->Block));
    for (std::uint64_t& size : this->Known)
    {
      size = this->Sizes->integer(this->Array.headerBytes, this->Array.byteOrder);
    }
  }
  return this->Known[place];
}

void CompressedBytes::nextBlock()
{
  if (this->Block == this->Blocks)
  {
    this->File.fail(this->Array.begin, "the compressed array here ends before it should");
  }
  const std::uint64_t size = this->nextSize();
  this->Size = ++this->Block == this->Blocks ? this->LastBytes : this->BlockBytes;
  this->Used = 0;
  const bool possible = size <= this->Compressed.size();
  if (possible)
  {
    this->Data->read(this->Compressed.bytes().first(size));
  }
  if (!possible || !uncompress(this->Array.compression, this->Compressed.bytes().first(size),
                     this->Plain.bytes().first(this->Size)))
  {
    this->File.fail(this->Array.begin,
      "block " + std::to_string(this->Block - 1) + " of the compressed array here is damaged");
  }
}

void CompressedBytes::read(std::span<std::byte> bytes)
{
  while (!bytes.empty())
  {
    if (this->Used == this->Size)
    {
      this->nextBlock();
    }
    const std::size_t part = std::min(bytes.size(), this->Size - this->Used);
    std::memcpy(bytes.data(), this->Plain.data() + this->Used, part);
    bytes = bytes.subspan(part);
    this->Used += part;
  }
}

std::unique_ptr<ByteSource> bytesAt(InputFile& file, VtkEncoding encoding, std::size_t begin)
{
  if (encoding == VtkEncoding::Base64)
  {
    return std::make_unique<Base64Bytes>(file, begin);
  }
  return std::make_unique<RawBytes>(file, begin);
}

} // namespace smg
