// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Codec.h"

#include "smg/Error.h"

#include <cstring>
#include <lz4.h>
#include <zstd.h>

// Compression of the columns of blocks, by zstd at level 1 or LZ4. Bytes are regrouped first:
// corresponding bytes of neighbouring tuples are similar, above all exponents and signs of
// coordinates and high bytes of numbers.

namespace smg
{

namespace
{

constexpr int ZstdLevel = 1;

/** All first bytes of the tuples, then all second ones, and so on. */
void split(std::span<const std::byte> tuples, std::size_t tupleBytes, std::byte* planes)
{
  const std::size_t count = tuples.size() / tupleBytes;
  for (std::size_t b = 0; b < tupleBytes; b++)
  {
    const std::byte* from = tuples.data() + b;
    for (std::size_t i = 0; i < count; i++)
    {
      planes[i] = from[i * tupleBytes];
    }
    planes += count;
  }
}

/** The inverse of split(). */
void join(const std::byte* planes, std::size_t tupleBytes, std::span<std::byte> tuples)
{
  const std::size_t count = tuples.size() / tupleBytes;
  for (std::size_t b = 0; b < tupleBytes; b++)
  {
    std::byte* to = tuples.data() + b;
    for (std::size_t i = 0; i < count; i++)
    {
      to[i * tupleBytes] = planes[i];
    }
    planes += count;
  }
}

/** Provides at least `size` bytes; buffers never shrink, so that their memory is not cleared for
 * each block. */
std::byte* room(std::vector<std::byte>& buffer, std::size_t size)
{
  if (buffer.size() < size)
  {
    buffer.resize(size);
  }
  return buffer.data();
}

} // namespace

struct ColumnCodec::Contexts
{
  ZSTD_CCtx* Compression = nullptr;
  ZSTD_DCtx* Decompression = nullptr;

  Contexts() = default;
  ~Contexts()
  {
    ZSTD_freeCCtx(this->Compression);
    ZSTD_freeDCtx(this->Decompression);
  }
  Contexts(const Contexts&) = delete;
  Contexts& operator=(const Contexts&) = delete;

  // Made with the first use: a writer needs no decompressor, and a reader no compressor.
  ZSTD_CCtx* compression()
  {
    if (!this->Compression && !(this->Compression = ZSTD_createCCtx()))
    {
      throw Error("There is no memory for a zstd compressor.");
    }
    return this->Compression;
  }
  ZSTD_DCtx* decompression()
  {
    if (!this->Decompression && !(this->Decompression = ZSTD_createDCtx()))
    {
      throw Error("There is no memory for a zstd decompressor.");
    }
    return this->Decompression;
  }
};

ColumnCodec::ColumnCodec(Codec codec)
  : Kind(codec)
  , Zstd(std::make_unique<Contexts>())
{
}

ColumnCodec::~ColumnCodec() = default;

std::span<const std::byte> ColumnCodec::compress(
  std::span<const std::byte> plain, std::size_t tupleBytes)
{
  if (this->Kind == Codec::None || plain.empty())
  {
    return plain;
  }
  const std::byte* source = plain.data();
  if (tupleBytes > 1)
  {
    std::byte* planes = room(this->Regrouped, plain.size());
    split(plain, tupleBytes, planes);
    source = planes;
  }
  // A result that is not smaller is discarded, so there is room for one byte less than the input.
  const std::size_t most = plain.size() - 1;
  std::byte* target = room(this->Packed, plain.size());
  std::size_t size = 0;
  if (this->Kind == Codec::Lz4)
  {
    size = LZ4_compress_default(reinterpret_cast<const char*>(source),
      reinterpret_cast<char*>(target), static_cast<int>(plain.size()), static_cast<int>(most));
  }
  else
  {
    size =
      ZSTD_compressCCtx(this->Zstd->compression(), target, most, source, plain.size(), ZstdLevel);
    size = ZSTD_isError(size) ? 0 : size;
  }
  return size == 0 ? plain : std::span<const std::byte>(target, size);
}

bool ColumnCodec::decompress(
  std::span<const std::byte> stored, std::span<std::byte> plain, std::size_t tupleBytes)
{
  // Stored as it was: compressed columns are always smaller.
  if (stored.size() == plain.size())
  {
    std::memcpy(plain.data(), stored.data(), plain.size());
    return true;
  }
  if (this->Kind == Codec::None || stored.size() > plain.size())
  {
    return false;
  }
  std::byte* target = tupleBytes > 1 ? room(this->Regrouped, plain.size()) : plain.data();
  std::size_t size = 0;
  if (this->Kind == Codec::Lz4)
  {
    const int n = LZ4_decompress_safe(reinterpret_cast<const char*>(stored.data()),
      reinterpret_cast<char*>(target), static_cast<int>(stored.size()),
      static_cast<int>(plain.size()));
    size = n < 0 ? 0 : static_cast<std::size_t>(n);
  }
  else
  {
    size = ZSTD_decompressDCtx(
      this->Zstd->decompression(), target, plain.size(), stored.data(), stored.size());
    size = ZSTD_isError(size) ? 0 : size;
  }
  // Decoders are given the expected size, and must reach it.
  if (size != plain.size())
  {
    return false;
  }
  if (tupleBytes > 1)
  {
    join(target, tupleBytes, plain);
  }
  return true;
}

} // namespace smg
