// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/WriteBehind.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace smg
{

/** Writes a file from begin to end. finish() renames it; without finish() it is removed. */
class SMG_EXPORT SequentialOutput
{
public:
  explicit SequentialOutput(std::filesystem::path path);
  ~SequentialOutput();
  SequentialOutput(const SequentialOutput&) = delete;
  SequentialOutput& operator=(const SequentialOutput&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  /** Writes bytes. A failure is thrown immediately or by a later call. */
  void put(std::span<const std::byte> bytes);
  void put(std::string_view text) { this->put(std::as_bytes(std::span(text))); }
  /** Writes all buffered bytes, so that only renaming is left. */
  void flush();
  void finish();

private:
  void check();

  std::filesystem::path Path;
  FileDescriptor File;
  std::unique_ptr<WriteBehind> Behind;
};

/** A file that is written at arbitrary offsets and renamed when it is complete, or else removed. */
class PositionedFile
{
public:
  /** Creates the file under a temporary name beside `path`. Throws Error. */
  explicit PositionedFile(std::filesystem::path path);
  /** Reserves room for a file of this size, as FileDescriptor::reserve(). */
  void reserve(std::int64_t size) { this->File.reserve(size); }
  /** Writes the bytes at this offset. Throws Error. */
  void write(std::int64_t offset, std::span<const std::byte> bytes);

  /** Closes and renames the file. Throws Error. */
  void finish() { this->File.renameTo(this->Path); }

private:
  std::filesystem::path Path;
  FileDescriptor File;
};

} // namespace smg
