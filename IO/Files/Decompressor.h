// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

/** How a file is compressed as a whole. */
enum class Compression
{
  None,
  Gzip,
  Xz,
  Zstd
};

/** The number of bytes at the beginning of a member from which a decompressor is made. */
inline constexpr std::size_t MemberStartBytes = 18;

/** By the first bytes of a file or of a member, at least 6. */
Compression compressionOf(std::string_view bytes);

/** The suffixes that are added to the names of compressed files. */
inline constexpr std::array<std::string_view, 3> CompressedSuffixes{ ".gz", ".xz", ".zst" };
/** Whether a suffix, in lower case, is one of these. */
constexpr bool isCompressedSuffix(std::string_view suffix)
{
  return std::ranges::find(CompressedSuffixes, suffix) != CompressedSuffixes.end();
}
/** The file of this name, or else that of this name and such a suffix; empty: there is none. */
std::filesystem::path plainOrCompressed(const std::filesystem::path& path);

/** Decompresses the members of a file, one after the other. */
class Decompressor
{
public:
  virtual ~Decompressor() = default;

  /** Sets the input of the next calls of step(), which must stay. */
  void setInput(std::string_view bytes) { this->Input = bytes; }
  /** What is left of it. */
  std::string_view input() const { return this->Input; }
  /** Decompresses the available input as far as there is room; returns the bytes written. */
  virtual std::size_t step(std::span<std::byte> room) = 0;
  bool memberEnded() const { return this->MemberEnded; }
  /** A sentence, if the input cannot be decompressed; else empty. */
  const std::string& problem() const { return this->Problem; }
  /** To be called after the end of a member, with the first MemberStartBytes of the next one. */
  virtual void startMember(std::string_view start) = 0;
  /** The bytes of memory that the current member takes, as far as it has been read. */
  virtual std::int64_t memory() const { return 0; }

protected:
  /** `memory`: the most bytes that a member may take. */
  explicit Decompressor(std::int64_t memory)
    : Limit(memory)
  {
  }

  void setDamaged() { this->Problem = "the compressed data are damaged"; }
  /** A member takes `bytes`, which is more than the limit. */
  void setTooLarge(std::uint64_t bytes);

  std::string_view Input;
  std::int64_t Limit;
  bool MemberEnded = false;
  std::string Problem;
};

/**
 * A decompressor, not for Compression::None.
 * @param start the first MemberStartBytes of the file, or all
 * @param memory the most bytes that it may take
 */
std::unique_ptr<Decompressor> makeDecompressor(std::string_view start, std::int64_t memory);

} // namespace smg
