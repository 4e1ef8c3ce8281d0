// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace smg
{

/**
 * An open file that is read and written at given places. Reads and writes go on after interruptions
 * and partial transfers; every failure is an Error that names the file and the system's reason.
 */
class SMG_EXPORT FileDescriptor
{
public:
  FileDescriptor() = default;
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;

  /** Opens an existing regular file for reading. */
  static FileDescriptor openForReading(const std::filesystem::path& path);
  /**
   * The file that a name stands for: what a symbolic link leads to, also if nothing is there yet.
   * Throws Error if links lead in a circle.
   */
  static std::filesystem::path targetOf(const std::filesystem::path& path);
  /**
   * Makes a new file with a temporary name beside the target of `path`; path() tells it. Whoever
   * makes it renames or removes it.
   */
  static FileDescriptor createBeside(const std::filesystem::path& path);
  /** Makes a file without a name in `folder`: it is gone when it is closed, or the program ends. */
  static FileDescriptor createNameless(const std::filesystem::path& folder);

  bool isOpen() const { return this->Number >= 0; }
  const std::filesystem::path& path() const { return this->Path; }
  std::int64_t size() const;

  /** Reads at `offset` what there is, up to the size of `bytes`; answers how many bytes. */
  std::size_t readSome(std::int64_t offset, std::span<std::byte> bytes) const;
  /** Reads exactly `bytes`; Error if the file ends before. */
  void read(std::int64_t offset, std::span<std::byte> bytes) const;
  void write(std::int64_t offset, std::span<const std::byte> bytes) const;
  /**
   * The same without exceptions, and without allocating memory: 0, the error number, or -1 if the
   * file ends before.
   */
  int tryRead(std::int64_t offset, std::span<std::byte> bytes) const noexcept;
  /** The same; adds the nanoseconds for which the disk was waited for to `waited`. */
  int tryRead(std::int64_t offset, std::span<std::byte> bytes, std::int64_t& waited) const noexcept;
  int tryWrite(std::int64_t offset, std::span<const std::byte> bytes) const noexcept;

  /** Says that these bytes will be read soon: the system begins to bring them from the disk. */
  void willRead(std::int64_t offset, std::size_t bytes) const noexcept;

  /** Closes the file; some systems tell only now that a write failed. */
  void close();
  /**
   * Closes the file and gives it the name `path`, in one step, in place of what has that name; a
   * symbolic link stays, and what it leads to is replaced. If that fails, the file is removed:
   * Error.
   */
  void renameTo(const std::filesystem::path& path);
  /** Closes and removes the file. */
  void remove() noexcept;

  /** The Error for a failed write, for whoever uses tryWrite. */
  [[noreturn]] static void throwWriteError(const std::filesystem::path& path, int errorNumber);
  [[noreturn]] static void throwReadError(const std::filesystem::path& path, int errorNumber);

private:
  /** Reads what is in memory already, from the front; answers how many bytes. */
  std::size_t readCached(std::int64_t offset, std::span<std::byte> bytes) const noexcept;

  int Number = -1;
  std::filesystem::path Path;
};

} // namespace smg
