// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace smg
{

class FolderLock;
class ScratchAccount;

/** The path of a folder whose scratch files are to outlive the program. */
struct KeptFolder
{
  explicit KeptFolder(std::filesystem::path folder)
    : path(std::move(folder))
  {
  }
  std::filesystem::path path;
};

/**
 * A folder for scratch files, which the destructor removes with its content. A folder is locked as
 * long as its program runs; one that a killed program has left is removed by the next ScratchFolder
 * in the same parent.
 *
 * A kept folder has files with names, and stays with them for the next program that opens it, until
 * one discards it. Files in it whose names do not begin like those of a checkpoint are left alone.
 */
class SMG_EXPORT ScratchFolder
{
public:
  /** Creates it in `parent`, or in the system's temporary folder if that is empty. Its files have
   * at most `limit` bytes at once; 0: no limit. Throws Error. */
  explicit ScratchFolder(const std::filesystem::path& parent, std::int64_t limit = 0);
  /** Opens a kept folder, or makes an empty or new folder one, which then remains only after
   * retain(). Throws Error if the folder has other content, or is in use. */
  explicit ScratchFolder(const KeptFolder& kept, std::int64_t limit = 0);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  /** Counts the bytes of its files. */
  const ScratchAccount& account() const { return *this->Account; }

  /** A scratch file: unnamed, or in a kept folder the file of this name, created if it does not
   * exist. */
  FileDescriptor file(const std::string& name) const;
  /** The path of the file of this name in a kept folder. */
  std::filesystem::path pathOf(const std::string& name) const;
  /** A kept folder will remain when it is closed. */
  void retain() { this->Remains = true; }
  /** A kept folder will be removed when it is closed. */
  void discard() { this->Remains = false; }
  /** The lock of a kept folder, which another part of the program may take over. */
  const std::shared_ptr<FolderLock>& lock() const { return this->KeptLock; }

  /** Whether a folder has the marker of a scratch folder, of this program or another one. */
  static bool isOne(const std::filesystem::path& folder);
  /** The folder that the user chose, given a scratch folder in it, which may lie in other scratch
   * folders. */
  static std::filesystem::path placeOf(std::filesystem::path folder);

private:
  void openKept();
  void countKept();
  void removeKept() const noexcept;

  std::filesystem::path Path;
  int Lock = -1;                        // descriptor; of a scratch folder, not of a kept one
  std::shared_ptr<FolderLock> KeptLock; // of a kept folder, whose files have names; else null
  bool Remains = false;                 // when it is closed
  std::shared_ptr<ScratchAccount> Account;
};

/** The path of a file in a scratch folder. */
inline std::filesystem::path operator/(const ScratchFolder& folder, const char* name)
{
  return folder.path() / name;
}

} // namespace smg
