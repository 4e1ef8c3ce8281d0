// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dirent.h>
#include <filesystem>

namespace smg
{

/**
 * The names in a folder, one after another. Unlike std::filesystem it can be used where memory may
 * be short and no exception may leave: in destructors and for cleaning up.
 */
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

} // namespace smg
