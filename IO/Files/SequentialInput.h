// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** Reads a file from begin to end through a buffer, as bytes or as lines. */
class SequentialInput
{
public:
  /** More characters than this a line must not have. */
  static constexpr std::size_t MaxLine = std::size_t(64) << 10;

  explicit SequentialInput(const std::filesystem::path& path);

  std::string name() const { return this->File.path().string(); }
  const FileDescriptor& file() const { return this->File; }
  std::int64_t size() const { return this->Size; }
  /** Place in the file of the next byte. */
  std::int64_t position() const { return this->BufferOffset + std::int64_t(this->Begin); }
  void moveTo(std::int64_t position);

  /** The next bytes without passing them: `count`, or fewer if the file ends before. */
  std::span<const std::byte> peek(std::size_t count);
  void skip(std::size_t count) { this->Begin += count; }

  /**
   * Passes a line and gives it without its end (either kind), valid until the next call; false at
   * the end of the file. Throws Error for a line that is too long.
   */
  bool nextLine(std::string_view& line);
  /** Number of the line given last, from 1. */
  std::int64_t lineNumber() const { return this->Line; }

private:
  /** Reads on until `count` bytes are there or the file ends. */
  void fill(std::size_t count);

  FileDescriptor File;
  std::int64_t Size = 0;
  std::vector<std::byte> Buffer;
  std::int64_t BufferOffset = 0;  ///< place in the file of the buffer's first byte
  std::size_t Begin = 0, End = 0; ///< of the bytes in the buffer that are still to come
  std::int64_t Line = 0;
};

} // namespace smg
