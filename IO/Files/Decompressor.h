// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
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

/** By the first bytes of a file, at least 6. */
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
  std::string_view problem() const { return this->Problem; }
  /** To be called after the end of a member. */
  virtual void startMember() = 0;

protected:
  std::string_view Input;
  bool MemberEnded = false;
  std::string_view Problem;
  static constexpr std::string_view IsDamaged = "the compressed data are damaged",
                                    NeedsMemory =
                                      "decompressing needs too much memory: compress the file "
                                      "anew without options for extreme compression";
};

/** A decompressor, not for Compression::None. */
std::unique_ptr<Decompressor> makeDecompressor(Compression compression);

} // namespace smg
