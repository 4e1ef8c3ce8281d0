// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <dirent.h>
#include <filesystem>
#include <memory>

namespace smg
{

/** The names in a folder, one by one. Unlike std::filesystem it throws nothing, so it can be used
 * in destructors and for cleaning up, also when memory is short. */
class FolderEntries
{
public:
  /** A folder that cannot be read has no entries. */
  explicit FolderEntries(const std::filesystem::path& folder) noexcept;
  /** Takes over the descriptor of a folder. */
  explicit FolderEntries(int file) noexcept;
  ~FolderEntries();
  FolderEntries(const FolderEntries&) = delete;
  FolderEntries& operator=(const FolderEntries&) = delete;

  bool isOpen() const noexcept { return this->Opened; }
  /** The next name, valid until the next call; null at the end. */
  const char* next() noexcept;

private:
  DIR* Opened;
};

/** Removes a folder with its content, as far as possible. Symbolic links are removed, not followed.
 */
void removeFolder(const char* folder) noexcept;

/** A temporary name beside a file, unique unless a terminated program left a file with it. */
std::filesystem::path temporaryName(const std::filesystem::path& path);
/** Whether this process made the temporary name; a forked child has copies of its parent's. */
bool isOwnTemporary(const std::filesystem::path& name);
/** Locks a temporary file until it is closed, so that no other program removes it as abandoned.
 * Returns false if one already has. */
bool lockTemporary(int file) noexcept;
/** Removes the temporary files of `path` that killed programs have left: those without a lock. In a
 * file system without locks it removes none. */
void removeAbandonedTemporaries(const std::filesystem::path& path);

/** The lock of a folder, which one program at a time has. Within the program several parts may
 * share it; they use the folder one after another (use(), endUse()). */
class SMG_EXPORT FolderLock
{
public:
  /** Locks an existing folder, or shares the lock if this program already has it. Throws Error if
   * another program has it, or the folder cannot be opened or locked. */
  static std::shared_ptr<FolderLock> acquire(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /** The descriptor of the folder. */
  int folder() const { return this->Folder; }
  /** Begins to use the folder. Throws Error if another part of the program does, like acquire(). */
  void use(const std::filesystem::path& folder);
  void endUse() noexcept;
  /** In a forked child: the lock is its parent's alone, and ends with it. */
  void leaveToParent() noexcept;

private:
  explicit FolderLock(int folder)
    : Folder(folder)
  {
  }

  int Folder;
  bool IsUsed = false;
};

} // namespace smg
