// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace smg
{

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
 * one discards it.
 */
class SMG_EXPORT ScratchFolder
{
public:
  /** Creates it in `parent`; empty: in the system's temporary folder. Its files have at most
   * `limit` bytes at once; 0: any number. Throws Error. */
  explicit ScratchFolder(const std::filesystem::path& parent, std::int64_t limit = 0);
  /** Opens a kept folder, or makes one of a path that does not exist or an empty folder, which
   * remains only after keep(true). Throws Error if the folder has other files or another program
   * has opened it. */
  explicit ScratchFolder(const KeptFolder& kept, std::int64_t limit = 0);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  /** Counts the bytes of its files. */
  const ScratchAccount& account() const { return *this->Account; }

  /** A scratch file: nameless, or that of this name in a kept folder, created if necessary. */
  FileDescriptor file(const std::string& name) const;
  /** Of a kept folder: whether it remains. */
  void keep(bool kept) { this->Kept = kept; }

  /** Whether a folder is a scratch folder, of this program or another one. */
  static bool isOne(const std::filesystem::path& folder);
  /** The folder that a user chose for a scratch folder, which may lie in other ones. */
  static std::filesystem::path placeOf(std::filesystem::path folder);

private:
  void lockKept();
  void countKept();
  void removeKept() const noexcept;

  std::filesystem::path Path;
  int Lock = -1;      // of the folder itself
  bool Named = false; // the files have names
  bool Kept = false;  // the folder remains
  std::shared_ptr<ScratchAccount> Account;
};

/** The path of a file in a scratch folder. */
inline std::filesystem::path operator/(const ScratchFolder& folder, const char* name)
{
  return folder.path() / name;
}

} // namespace smg
