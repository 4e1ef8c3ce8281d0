// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/ScratchFolder.h"

#include "smg/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace smg
{
namespace
{

constexpr const char* Prefix = "smg-scratch-";
/** A file that only scratch folders have: no other folder is ever removed. */
constexpr const char* Marker = ".smg-scratch";

/** A descriptor of the folder that holds its lock; -1 if it is locked or does not support locks. */
int lockFolder(const std::filesystem::path& folder)
{
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0)
  {
    ::close(lock);
    return -1;
  }
  return lock;
}

/** Removes the scratch folders of terminated programs in `base`. */
void removeAbandoned(const std::filesystem::path& base)
{
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(base, ignored), end; entry != end;
       entry.increment(ignored))
  {
    const std::filesystem::path& folder = entry->path();
    if (!folder.filename().string().starts_with(Prefix) ||
        !std::filesystem::exists(folder / Marker, ignored))
    {
      continue;
    }
    if (const int lock = lockFolder(folder); lock >= 0)
    {
      std::filesystem::remove_all(folder, ignored);
      ::close(lock);
    }
  }
}

} // namespace

ScratchFolder::ScratchFolder(const std::filesystem::path& parent)
{
  std::error_code failed;
  const std::filesystem::path place =
    parent.empty() ? std::filesystem::temp_directory_path(failed) : parent;
  if (failed)
  {
    throw Error("there is no temporary folder (" + failed.message() + "): name a scratch folder");
  }
  const std::filesystem::path base = std::filesystem::absolute(place);
  removeAbandoned(base);
  // Once locked, it is renamed to the pattern by which others search for abandoned folders.
  std::string made = (base / (std::string(".") + Prefix + "XXXXXX")).string();
  if (!::mkdtemp(made.data()))
  {
    throw Error("cannot make a scratch folder in " + base.string() + ": " + std::strerror(errno) +
                "; name another one");
  }
  this->Path = made;
  this->Lock = lockFolder(this->Path);
  std::ofstream(this->Path / Marker).flush();
  const std::filesystem::path name = base / this->Path.filename().string().substr(1);
  if (this->Lock >= 0 && ::rename(this->Path.c_str(), name.c_str()) == 0)
  {
    this->Path = name;
  }
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(this->Path, ignored);
  if (this->Lock >= 0)
  {
    ::close(this->Lock);
  }
}

} // namespace smg
