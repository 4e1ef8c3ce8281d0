// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <filesystem>

namespace smg
{

/**
 * A separate folder for scratch files, removed with its content by the destructor. Folders left by
 * killed programs are removed by the next ScratchFolder in the same parent: a folder is locked as
 * long as its program runs.
 */
class SMG_EXPORT ScratchFolder
{
public:
  /** Creates it in `parent`; empty: in the system's temporary folder. Throws Error. */
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }

  /** Whether a folder is a scratch folder, of this program or another one. */
  static bool isOne(const std::filesystem::path& folder);

private:
  std::filesystem::path Path;
  int Lock = -1; // of the folder itself
};

/** The path of a file in a scratch folder. */
inline std::filesystem::path operator/(const ScratchFolder& folder, const char* name)
{
  return folder.path() / name;
}

} // namespace smg
