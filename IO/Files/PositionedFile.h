// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace smg
{

/** A new file that is written at any places and gets its name when it is complete. */
class PositionedFile
{
public:
  /** Makes the file under a temporary name beside `path`. Throws Error. */
  explicit PositionedFile(std::filesystem::path path);
  /** Without finish(), nothing is left of the file. */
  ~PositionedFile();
  PositionedFile(const PositionedFile&) = delete;
  PositionedFile& operator=(const PositionedFile&) = delete;

  /** Writes the bytes at this offset. Throws Error. */
  void write(std::int64_t offset, std::span<const std::byte> bytes);

  /** Closes the file and gives it its name. Throws Error. */
  void finish();

private:
  std::filesystem::path Path;
  FileDescriptor File;
};

} // namespace smg
