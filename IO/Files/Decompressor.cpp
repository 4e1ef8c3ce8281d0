// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Decompressor.h"

#include "Solver/Core/Text.h"

#include <lzma.h>
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <array>
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

/** Whether zstd skips this frame, which holds no data: pzstd and the seekable format have such. */
bool isSkippable(std::string_view frame)
{
  return frame.size() >= 4 && (static_cast<unsigned char>(frame[0]) & 0xf0) == 0x50 &&
         frame.substr(1, 3) == "\x2a\x4d\x18";
}

class GzipDecompressor : public Decompressor
{
public:
  explicit GzipDecompressor(std::int64_t memory)
    : Decompressor(memory)
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
      this->setDamaged();
    }
    return room.size() - this->Stream.avail_out;
  }

  void startMember(std::string_view) override
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
  explicit XzDecompressor(std::int64_t memory)
    : Decompressor(memory)
  {
    XzDecompressor::startMember({});
  }
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
    if (result == LZMA_MEMLIMIT_ERROR)
    {
      this->setTooLarge(lzma_memusage(&this->Stream));
    }
    else if (!this->MemberEnded && result != LZMA_OK && result != LZMA_BUF_ERROR)
    {
      this->setDamaged();
    }
    return room.size() - this->Stream.avail_out;
  }

  void startMember(std::string_view) override
  {
    if (lzma_stream_decoder(&this->Stream, static_cast<std::uint64_t>(this->Limit), 0) != LZMA_OK)
    {
      throw std::bad_alloc();
    }
    this->MemberEnded = false;
  }

  std::int64_t memory() const override
  {
    return static_cast<std::int64_t>(lzma_memusage(&this->Stream));
  }

private:
  lzma_stream Stream = LZMA_STREAM_INIT;
};

/** The bytes of a frame of zstd that its decompressor keeps, by its header (RFC 8878, 3.1.1.1). */
std::uint64_t windowOfZstd(std::string_view frame)
{
  const auto byte = [frame](std::size_t i) -> std::uint64_t
  { return i < frame.size() ? static_cast<unsigned char>(frame[i]) : 0; };
  const std::uint64_t descriptor = byte(4);
  if ((descriptor & 0x20) == 0)
  {
    const std::uint64_t power = std::uint64_t(1) << (10 + (byte(5) >> 3));
    return power + power / 8 * (byte(5) & 7);
  }
  // The whole content at once, whose size follows the number of the dictionary.
  constexpr std::array<std::size_t, 4> NumberBytes{ 0, 1, 2, 4 }, SizeBytes{ 1, 2, 4, 8 };
  const std::size_t begin = 5 + NumberBytes[descriptor & 3];
  const std::size_t count = SizeBytes[descriptor >> 6];
  std::uint64_t size = count == 2 ? 256 : 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    size += byte(begin + i) << (8 * i);
  }
  return size;
}

class ZstdDecompressor : public Decompressor
{
public:
  ZstdDecompressor(std::string_view start, std::int64_t memory)
    : Decompressor(memory)
    , Stream(ZSTD_createDStream())
  {
    if (!this->Stream)
    {
      throw std::bad_alloc();
    }
    // startMember() compares the window with the limit.
    ZSTD_DCtx_setParameter(
      this->Stream, ZSTD_d_windowLogMax, ZSTD_dParam_getBounds(ZSTD_d_windowLogMax).upperBound);
    ZstdDecompressor::startMember(start);
  }
  ~ZstdDecompressor() override { ZSTD_freeDStream(this->Stream); }
  ZstdDecompressor(const ZstdDecompressor&) = delete;
  ZstdDecompressor& operator=(const ZstdDecompressor&) = delete;

  std::size_t step(std::span<std::byte> room) override
  {
    if (!this->Problem.empty())
    {
      return 0;
    }
    ZSTD_inBuffer in{ this->Input.data(), this->Input.size(), 0 };
    ZSTD_outBuffer out{ room.data(), room.size(), 0 };
    const std::size_t result = ZSTD_decompressStream(this->Stream, &out, &in);
    this->Input.remove_prefix(in.pos);
    if (ZSTD_isError(result) != 0)
    {
      if (ZSTD_getErrorCode(result) == ZSTD_error_frameParameter_windowTooLarge)
      {
        this->setTooLarge(static_cast<std::uint64_t>(this->Needed));
      }
      else
      {
        this->setDamaged();
      }
    }
    this->MemberEnded = result == 0;
    return out.pos;
  }

  void startMember(std::string_view start) override
  {
    ZSTD_DCtx_reset(this->Stream, ZSTD_reset_session_only);
    this->MemberEnded = false;
    // Besides the window: tables, and a block of input and of output.
    constexpr std::uint64_t More = std::uint64_t(512) << 10;
    const std::uint64_t window = isSkippable(start) ? 0 : windowOfZstd(start);
    constexpr auto Most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    // Buffers of an earlier, larger frame stay.
    this->Needed =
      std::max(this->Needed, static_cast<std::int64_t>(std::min(window, Most - More) + More));
    if (this->Needed > this->Limit)
    {
      this->setTooLarge(static_cast<std::uint64_t>(this->Needed));
    }
  }

  std::int64_t memory() const override { return this->Problem.empty() ? this->Needed : 0; }

private:
  ZSTD_DStream* Stream;
  std::int64_t Needed = 0; ///< bytes for the current frame
};

} // namespace

void Decompressor::setTooLarge(std::uint64_t bytes)
{
  this->Problem = "decompressing needs " + mebibytes(static_cast<std::int64_t>(bytes)) +
                  " of memory, but the limit leaves " + mebibytes(this->Limit) +
                  ": raise the memory limit (option --memory), or compress the file anew without "
                  "options for extreme compression";
}

Compression compressionOf(std::string_view bytes)
{
  return bytes.starts_with(GzipSign)                         ? Compression::Gzip
         : bytes.starts_with(XzSign)                         ? Compression::Xz
         : bytes.starts_with(ZstdSign) || isSkippable(bytes) ? Compression::Zstd
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

std::unique_ptr<Decompressor> makeDecompressor(std::string_view start, std::int64_t memory)
{
  switch (compressionOf(start))
  {
    case Compression::Xz:
      return std::make_unique<XzDecompressor>(memory);
    case Compression::Zstd:
      return std::make_unique<ZstdDecompressor>(start, memory);
    default:
      return std::make_unique<GzipDecompressor>(memory);
  }
}

} // namespace smg
