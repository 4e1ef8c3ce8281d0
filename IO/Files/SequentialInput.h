// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"

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
  /** The maximum number of characters of a line. */
  static constexpr std::size_t MaxLine = std::size_t(64) << 10;

  explicit SequentialInput(const std::filesystem::path& path);

  std::string name() const { return this->File.path().string(); }
  const FileDescriptor& file() const { return this->File; }
  std::int64_t size() const { return this->Size; }
  /** The offset in the file of the next byte. */
  std::int64_t position() const { return this->BufferOffset + std::int64_t(this->Begin); }
  void moveTo(std::int64_t position);

  /** The next bytes without consuming them: `count`, or fewer if the file ends before. */
  std::span<const std::byte> peek(std::size_t count);
  void skip(std::size_t count) { this->Begin += count; }

  /** Reads a line without its line end (LF or CR LF), valid until the next call; returns false at
   * the end of the file. Throws Error for a line that is too long. */
  bool nextLine(std::string_view& line);
  /** The number of the last line, from 1. */
  std::int64_t lineNumber() const { return this->Line; }

private:
  /** Reads until `count` bytes are buffered or the file ends. */
  void fill(std::size_t count);

  FileDescriptor File;
  std::int64_t Size = 0;
  std::vector<std::byte> Buffer;
  std::int64_t BufferOffset = 0;  ///< offset in the file of the first byte of the buffer
  std::size_t Begin = 0, End = 0; ///< of the unread bytes in the buffer
  std::int64_t Line = 0;
};

} // namespace smg
