// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <filesystem>
#include <memory>

namespace smg
{

/**
 * The lock of a folder, by which one program at a time uses it. Within the program it can be held
 * by several parts, which work on the folder one after another; one at a time uses it.
 */
class SMG_EXPORT FolderLock
{
public:
  /** Locks an existing folder, or shares the lock that this program has. Throws Error if another
   * program has it, or the folder cannot be opened or locked. */
  static std::shared_ptr<FolderLock> acquire(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /** The descriptor of the folder. */
  int folder() const { return this->Folder; }
  /** Begins to use the folder. Throws Error if another part of the program does, like acquire(). */
  void use(const std::filesystem::path& folder);
  void endUse() noexcept;

private:
  explicit FolderLock(int folder)
    : Folder(folder)
  {
  }

  int Folder;
  bool IsUsed = false;
};

} // namespace smg
