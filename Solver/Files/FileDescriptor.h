// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace smg
{

class ScratchShare;

/** An open file that is read and written at given offsets. Reads and writes continue after
 * interruptions and partial transfers. Every failure is an Error that names the file and the
 * reason that the system gives. A file that is created in a ScratchFolder counts in its account. */
class SMG_EXPORT FileDescriptor
{
public:
  static constexpr int EndOfFile = -1, ScratchLimit = -2;

  FileDescriptor() = default;
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;

  /** Opens an existing regular file for reading. */
  static FileDescriptor openForReading(const std::filesystem::path& path);
  /** The file that a path refers to when symbolic links are followed; it need not exist. Throws
   * Error for links that form a circle. */
  static std::filesystem::path targetOf(const std::filesystem::path& path);
  /** Creates a file with a temporary name, path(), beside the target of `path`. The destructor
   * removes it unless it was renamed; if the program is killed, the next one that creates a file
   * beside the same target does. */
  static FileDescriptor createBeside(const std::filesystem::path& path);
  /**
   * Creates an unnamed file in `folder`, which is removed when it is closed or the program ends.
   */
  static FileDescriptor createNameless(const std::filesystem::path& folder);
  /** Opens a file for reading and writing, and creates it if it does not exist. A symbolic link is
   * an error. */
  static FileDescriptor openOrCreate(const std::filesystem::path& path);
  /** Gives an unnamed file a name in the same file system, also in messages. An existing file of
   * this name is replaced. */
  void giveName(const std::filesystem::path& path);

  bool isOpen() const { return this->Number >= 0; }
  const std::filesystem::path& path() const { return this->Path; }
  std::int64_t size() const;

  /** Reads available bytes at `offset`, up to the size of `bytes`; returns their number. */
  std::size_t readSome(std::int64_t offset, std::span<std::byte> bytes) const;
  /** Reads exactly `bytes`; throws Error if the file ends before. */
  void read(std::int64_t offset, std::span<std::byte> bytes) const;
  void write(std::int64_t offset, std::span<const std::byte> bytes) const;
  /** The same without exceptions and without memory allocation: returns 0, the error number,
   * EndOfFile if the file ends before, or ScratchLimit if the file may not grow. */
  int tryRead(std::int64_t offset, std::span<std::byte> bytes) const noexcept;
  /** The same; adds the nanoseconds of waiting for the disk to `waited`. */
  int tryRead(std::int64_t offset, std::span<std::byte> bytes, std::int64_t& waited) const noexcept;
  int tryWrite(std::int64_t offset, std::span<const std::byte> bytes) const noexcept;

  /** Reserves room on the disk for this size of the file, so that a full disk shows before hours of
   * work. The size does not change. File systems that cannot reserve do nothing. Throws Error. */
  void reserve(std::int64_t size) const;

  /** Announces a read of these bytes, so that the system starts to load them from disk. */
  void willRead(std::int64_t offset, std::size_t bytes) const noexcept;

  /** Closes the file; some systems report a failed write only here. */
  void close();
  /** Waits until the content is on the disk, unless setDurable(false). Throws Error. */
  void sync() const;
  /** The same for a closed file, or for the names in a folder. `shown` is the file that errors
   * name. */
  static void syncPath(const std::filesystem::path& path, const std::filesystem::path& shown);
  /** The same for an open file or folder, without exceptions; returns false if it failed. */
  static bool trySync(int file) noexcept;
  /**
   * Closes the file and atomically renames it to `path`, replacing an existing file; the target of
   * a symbolic link is replaced and the link is kept. After that, content and name are durable,
   * except in a ScratchFolder: after a power cut `path` is the old file or the whole new one.
   * Throws Error on failure; the file then keeps its temporary name, unless it is renamed and only
   * the new name is not durable.
   */
  void renameTo(const std::filesystem::path& path);
  /** Closes the file, and removes it if its name is temporary. */
  void remove() noexcept;
  /** Removes a closed file; it need not exist. */
  static void removeClosed(const std::filesystem::path& path) noexcept;

  /** Whether this process waits for the disk at sync() and renameTo(); initially it does. */
  static void setDurable(bool isDurable) noexcept;

  /** Throws the Error of a failed write, for callers of tryWrite. */
  [[noreturn]] static void throwWriteError(const std::filesystem::path& path, int errorNumber);
  [[noreturn]] static void throwReadError(const std::filesystem::path& path, int errorNumber);

private:
  void releaseShare() noexcept;
  /** Reads cached bytes from the front; returns their number. */
  std::size_t readCached(std::int64_t offset, std::span<std::byte> bytes) const noexcept;

  int Number = -1;
  std::filesystem::path Path;
  std::filesystem::path Shown; // the name in errors: of the result, not of its temporary file
  bool IsTemporary = false;
  bool IsNamed = false;                // and remains under its name
  std::shared_ptr<ScratchShare> Share; // of a scratch file; else null
};

/** Makes or replaces the file `path` with this content, atomically and durably; throws Error, and
 * then leaves an existing file as it is. */
SMG_EXPORT void writeFile(const std::filesystem::path& path, std::string_view text);

/** Renames a file or folder within a file system, replacing a file `to`; throws Error naming `to`.
 */
SMG_EXPORT void moveFile(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace smg
