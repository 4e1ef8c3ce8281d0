// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** An error in the content of a mesh file: a sentence without full stop and without the place,
 * which whoever reads the file adds. */
class SMG_EXPORT MeshError : public std::runtime_error
{
public:
  explicit MeshError(const std::string& sentence, std::int64_t line = 0)
    : std::runtime_error(sentence)
    , Line(line)
  {
  }
  /** The line of a text with the error, if it is not that which is read; 0: it is. */
  std::int64_t line() const { return this->Line; }

private:
  std::int64_t Line;
};

/** A file for parsing: a window of it is in memory, which moves to any requested offset. Optimised
 * for sequential reading. */
class SMG_EXPORT InputFile
{
public:
  /** The number of bytes read at once. */
  static constexpr std::size_t WindowBytes = std::size_t(1) << 20;

  /**
   * Opens the file. Throws Error if it cannot be read, is not a regular file or is empty.
   * @param name the name of the file in error messages; empty: its path
   */
  explicit InputFile(
    std::filesystem::path path, ProgressFunction progress = {}, std::string name = {});

  /** The name of the file in error messages. */
  const std::string& name() const { return this->Name; }
  const std::filesystem::path& path() const { return this->Path; }
  std::size_t size() const { return this->Size; }

  /** The bytes from `offset` on: at least `least`, or all up to the end of the file, and more if
   * they are in memory. Valid until the next call. Reports progress, except in a job on another
   * thread. Throws Error and Cancelled. */
  std::string_view at(std::size_t offset, std::size_t least = 1)
  {
    if (offset >= this->Begin && offset + least <= this->Begin + this->Used)
    {
      return { this->Window.data() + (offset - this->Begin), this->Used - (offset - this->Begin) };
    }
    return this->move(offset, least);
  }

  /** Reports progress for bytes of the file that were read elsewhere. Throws Cancelled. */
  void passed(std::size_t bytes);
  /** Reports progress for what a job on another thread reads, which cannot. Throws Cancelled. */
  void poll();

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
  std::size_t Begin = 0;                ///< offset of the window in the file
  std::size_t Used = 0;                 ///< bytes of the window
  std::atomic<std::size_t> Reached = 0; ///< the same as Begin, for poll()
  std::size_t Passed = 0;
};

/** Whether `left` bytes of a file can hold `count` items of at least `minBytes` bytes. The last
 * item of a text needs no line end. */
inline bool fitsInFile(std::int64_t count, std::size_t minBytes, std::size_t left)
{
  std::uint64_t bytes = 0;
  return count >= 0 &&
         !__builtin_mul_overflow(static_cast<std::uint64_t>(count), minBytes, &bytes) &&
         bytes <= left + 1;
}

/** The sentence of an error for a count that is `what`, for which there is no room. */
std::string countError(std::int64_t count, const std::string& what, std::size_t left);

/**
 * The file to which a mesh file in `folder` refers as `name`, if it is in this folder or below,
 * also after following links; else empty. A mesh file from elsewhere must not make a program read
 * other files of its user.
 */
SMG_EXPORT std::filesystem::path nearbyFile(
  const std::filesystem::path& folder, const std::filesystem::path& name);

} // namespace smg
