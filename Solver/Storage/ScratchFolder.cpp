// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/ScratchFolder.h"

#include "Solver/Core/Error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace smg
{

ScratchFolder::ScratchFolder(const std::filesystem::path& parent)
{
  std::error_code failed;
  const std::filesystem::path base = std::filesystem::absolute(
    parent.empty() ? std::filesystem::temp_directory_path(failed) : parent);
  if (failed)
  {
    throw Error("there is no temporary folder (" + failed.message() + "): name a scratch folder");
  }
  std::string name = (base / "smg-XXXXXX").string();
  if (!::mkdtemp(name.data()))
  {
    throw Error("cannot make a scratch folder in " + base.string() + ": " + std::strerror(errno) +
                "; name another one");
  }
  this->Path = name;
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(this->Path, ignored);
}

} // namespace smg
