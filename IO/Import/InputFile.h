// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

/**
 * A file that is read once from front to back, mapped into memory. Pages behind the reader are
 * given back, so that resident memory does not grow with the file.
 */
class InputFile
{
public:
  /** Maps the file. Throws Error if it cannot be read, is not a regular file or is empty. */
  explicit InputFile(std::filesystem::path path, ProgressFunction progress = {});
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  std::size_t size() const { return this->Size; }
  const char* begin() const { return this->Data; }
  const char* end() const { return this->Data + this->Size; }
  std::string_view text() const { return { this->Data, this->Size }; }

  /**
   * Says that everything before byte `offset` has been read: reports progress (throws Cancelled)
   * and gives memory back, every few megabytes.
   */
  void passed(std::size_t offset)
  {
    if (offset >= this->NextStep)
    {
      this->step(offset);
    }
  }

  /** Starts again at byte 0; progress does not go back. */
  void rewind();

  /** Throws Error: "PATH, byte OFFSET: SENTENCE". */
  [[noreturn]] void fail(std::size_t offset, const std::string& sentence) const;

private:
  void step(std::size_t offset);

  std::filesystem::path Path;
  Progress Reported;
  const char* Data = nullptr;
  std::size_t Size = 0;
  std::size_t Released = 0;
  std::size_t NextStep = 0;
};

} // namespace smg
