// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace smg
{

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
  void finish();

private:
  std::filesystem::path Path;
  FileDescriptor File;
};

} // namespace smg
