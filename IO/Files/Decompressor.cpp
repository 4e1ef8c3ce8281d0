// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Decompressor.h"

#include <lzma.h>
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <system_error>

namespace smg
{

namespace
{

using namespace std::string_view_literals;

constexpr std::string_view GzipSign = "\x1f\x8b",
                           XzSign = "\xfd"
                                    "7zXZ\0"sv,
                           ZstdSign = "\x28\xb5\x2f\xfd";

class GzipDecompressor : public Decompressor
{
public:
  GzipDecompressor()
  {
    constexpr int onlyGzip = 16;
    if (inflateInit2(&this->Stream, MAX_WBITS + onlyGzip) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~GzipDecompressor() override { inflateEnd(&this->Stream); }
  GzipDecompressor(const GzipDecompressor&) = delete;
  GzipDecompressor& operator=(const GzipDecompressor&) = delete;

  std::size_t step(std::span<std::byte> room) override
  {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    // zlib does not write to its input, in spite of its type.
    this->Stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(this->Input.data()));
    this->Stream.avail_in = static_cast<uInt>(std::min(this->Input.size(), most));
    this->Stream.next_out = reinterpret_cast<Bytef*>(room.data());
    this->Stream.avail_out = static_cast<uInt>(room.size());
    const int result = inflate(&this->Stream, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR)
    {
      throw std::bad_alloc();
    }
    this->Input.remove_prefix(static_cast<std::size_t>(
      reinterpret_cast<const char*>(this->Stream.next_in) - this->Input.data()));
    this->MemberEnded = result == Z_STREAM_END;
    // A buffer error of zlib only means that no further progress is possible.
    if (!this->MemberEnded && result != Z_OK && result != Z_BUF_ERROR)
    {
      this->Problem = IsDamaged;
    }
    return room.size() - this->Stream.avail_out;
  }

  void startMember() override
  {
    inflateReset(&this->Stream);
    this->MemberEnded = false;
  }

private:
  z_stream Stream{};
};

class XzDecompressor : public Decompressor
{
public:
  XzDecompressor() { this->startMember(); }
  ~XzDecompressor() override { lzma_end(&this->Stream); }
  XzDecompressor(const XzDecompressor&) = delete;
  XzDecompressor& operator=(const XzDecompressor&) = delete;

  std::size_t step(std::span<std::byte> room) override
  {
    this->Stream.next_in = reinterpret_cast<const std::uint8_t*>(this->Input.data());
    this->Stream.avail_in = this->Input.size();
    this->Stream.next_out = reinterpret_cast<std::uint8_t*>(room.data());
    this->Stream.avail_out = room.size();
    const lzma_ret result = lzma_code(&this->Stream, LZMA_RUN);
    if (result == LZMA_MEM_ERROR)
    {
      throw std::bad_alloc();
    }
    this->Input.remove_prefix(this->Input.size() - this->Stream.avail_in);
    this->MemberEnded = result == LZMA_STREAM_END;
    if (!this->MemberEnded && result != LZMA_OK && result != LZMA_BUF_ERROR)
    {
      this->Problem = result == LZMA_MEMLIMIT_ERROR ? NeedsMemory : IsDamaged;
    }
    return room.size() - this->Stream.avail_out;
  }

  void startMember() override
  {
    // What the strongest setting of xz (-9) needs, and no more, whatever the file asks for.
    constexpr std::uint64_t MaxMemory = std::uint64_t(80) << 20;
    if (lzma_stream_decoder(&this->Stream, MaxMemory, 0) != LZMA_OK)
    {
      throw std::bad_alloc();
    }
    this->MemberEnded = false;
  }

private:
  lzma_stream Stream = LZMA_STREAM_INIT;
};

class ZstdDecompressor : public Decompressor
{
public:
  ZstdDecompressor()
    : Stream(ZSTD_createDStream())
  {
    if (!this->Stream)
    {
      throw std::bad_alloc();
    }
  }
  ~ZstdDecompressor() override { ZSTD_freeDStream(this->Stream); }
  ZstdDecompressor(const ZstdDecompressor&) = delete;
  ZstdDecompressor& operator=(const ZstdDecompressor&) = delete;

  std::size_t step(std::span<std::byte> room) override
  {
    ZSTD_inBuffer in{ this->Input.data(), this->Input.size(), 0 };
    ZSTD_outBuffer out{ room.data(), room.size(), 0 };
    const std::size_t result = ZSTD_decompressStream(this->Stream, &out, &in);
    this->Input.remove_prefix(in.pos);
    if (ZSTD_isError(result) != 0)
    {
      const bool isLarge = ZSTD_getErrorCode(result) == ZSTD_error_frameParameter_windowTooLarge;
      this->Problem = isLarge ? NeedsMemory : IsDamaged;
    }
    this->MemberEnded = result == 0;
    return out.pos;
  }

  void startMember() override
  {
    ZSTD_initDStream(this->Stream);
    this->MemberEnded = false;
  }

private:
  ZSTD_DStream* Stream;
};

} // namespace

Compression compressionOf(std::string_view bytes)
{
  return bytes.starts_with(GzipSign)   ? Compression::Gzip
         : bytes.starts_with(XzSign)   ? Compression::Xz
         : bytes.starts_with(ZstdSign) ? Compression::Zstd
                                       : Compression::None;
}

std::filesystem::path plainOrCompressed(const std::filesystem::path& path)
{
  std::error_code absent;
  if (std::filesystem::exists(path, absent))
  {
    return path;
  }
  for (const std::string_view suffix : CompressedSuffixes)
  {
    std::filesystem::path compressed = path;
    if (std::filesystem::exists(compressed += suffix, absent))
    {
      return compressed;
    }
  }
  return {};
}

std::unique_ptr<Decompressor> makeDecompressor(Compression compression)
{
  switch (compression)
  {
    case Compression::Xz:
      return std::make_unique<XzDecompressor>();
    case Compression::Zstd:
      return std::make_unique<ZstdDecompressor>();
    default:
      return std::make_unique<GzipDecompressor>();
  }
}

} // namespace smg
