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
 * A separate folder for scratch files, removed with its content by the destructor. Folders left by
 * killed programs are removed by the next ScratchFolder in the same parent: a folder is locked as
 * long as its program runs.
 *
 * A kept folder remains with its files, which have names, for the next program that opens it, until
 * one discards it. Other files in it, whose names do not begin as those of its own, are left alone.
 */
class SMG_EXPORT ScratchFolder
{
public:
  /** Creates it in `parent`; empty: in the system's temporary folder. Its files have at most
   * `limit` bytes at once; 0: any number. Throws Error. */
  explicit ScratchFolder(const std::filesystem::path& parent, std::int64_t limit = 0);
  /** Opens a kept folder, or makes one of a path that does not exist or an empty folder, which
   * remains only after retain(). Throws Error if the folder is neither, or is in use. */
  explicit ScratchFolder(const KeptFolder& kept, std::int64_t limit = 0);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  /** Counts the bytes of its files. */
  const ScratchAccount& account() const { return *this->Account; }

  /** A scratch file: nameless, or that of this name in a kept folder, created if necessary. */
  FileDescriptor file(const std::string& name) const;
  /** The path of the file of this name in a kept folder. */
  std::filesystem::path pathOf(const std::string& name) const;
  /** Of a kept folder: it remains when it is closed. */
  void retain() { this->Remains = true; }
  /** Of a kept folder: it is removed when it is closed. */
  void discard() { this->Remains = false; }
  /** The lock of a kept folder, with which it can be handed on. */
  const std::shared_ptr<FolderLock>& lock() const { return this->KeptLock; }

  /** Whether a folder is a scratch folder, of this program or another one. */
  static bool isOne(const std::filesystem::path& folder);
  /** The folder that a user chose for a scratch folder, which may lie in other ones. */
  static std::filesystem::path placeOf(std::filesystem::path folder);

private:
  void openKept();
  void countKept();
  void removeKept() const noexcept;

  std::filesystem::path Path;
  int Lock = -1;                        // of a folder that is not kept
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
