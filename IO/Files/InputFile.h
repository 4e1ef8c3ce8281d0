// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Storage/FileDescriptor.h"
#include "smg/Export.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/**
 * A file that is parsed: a window of it is in memory, which goes wherever it is asked for. Reading
 * from front to back is what it is quick at.
 */
class SMG_EXPORT InputFile
{
public:
  /** Bytes that are read at once. */
  static constexpr std::size_t WindowBytes = std::size_t(1) << 20;

  /**
   * Opens the file. Throws Error if it cannot be read, is not a regular file or is empty.
   * @param name what errors call the file; empty: its path
   */
  explicit InputFile(
    std::filesystem::path path, ProgressFunction progress = {}, std::string name = {});

  /** What errors call the file. */
  const std::string& name() const { return this->Name; }
  const std::filesystem::path& path() const { return this->Path; }
  std::size_t size() const { return this->Size; }

  /**
   * The bytes from `offset` on: at least `least`, or all there are up to the end of the file, and
   * more if they are in memory. Valid until the next call. Tells progress. Throws Error; Cancelled.
   */
  std::string_view at(std::size_t offset, std::size_t least = 1)
  {
    if (offset >= this->Begin && offset + least <= this->Begin + this->Used)
    {
      return { this->Window.data() + (offset - this->Begin), this->Used - (offset - this->Begin) };
    }
    return this->move(offset, least);
  }

  /** Tells progress by bytes of the file that others have read. Throws Cancelled. */
  void passed(std::size_t bytes);

  /** Throws Error: "NAME, byte OFFSET: SENTENCE" */
  [[noreturn]] void fail(std::size_t offset, const std::string& sentence) const;

private:
  std::string_view move(std::size_t offset, std::size_t least);

  std::filesystem::path Path;
  std::string Name;
  FileDescriptor File;
  std::size_t Size = 0;
  Progress Reported;
  std::vector<char> Window;
  std::size_t Begin = 0; ///< place of the window in the file
  std::size_t Used = 0;  ///< bytes of the window
  std::size_t Passed = 0;
};

} // namespace smg
