// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/ScratchFolder.h"

#include "Solver/Storage/Folder.h"
#include "Solver/Storage/SystemCalls.h"
#include "smg/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

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
  const int lock =
    systemCalls().open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC, 0);
  if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0)
  {
    systemCalls().close(lock);
    return -1;
  }
  return lock;
}

void mark(const std::filesystem::path& folder)
{
  const int file =
    systemCalls().open((folder / Marker).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file >= 0)
  {
    systemCalls().close(file);
  }
}

/** Removes the scratch folders of terminated programs in `base`. */
void removeAbandoned(const std::filesystem::path& base)
{
  FolderEntries entries(base);
  while (const char* name = entries.next())
  {
    const std::filesystem::path folder = base / name;
    // A program killed before the renaming below has left a name that begins with a dot.
    const std::string_view plain = std::string_view(name).substr(*name == '.' ? 1 : 0);
    if (!plain.starts_with(Prefix) || !ScratchFolder::isOne(folder))
    {
      continue;
    }
    if (const int lock = lockFolder(folder); lock >= 0)
    {
      removeFolder(folder.c_str());
      systemCalls().close(lock);
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
  if (!systemCalls().mkdtemp(made.data()))
  {
    throw Error("cannot make a scratch folder in " + base.string() + ": " + std::strerror(errno) +
                "; name another one");
  }
  try
  {
    this->Path = made;
    this->Lock = lockFolder(this->Path);
    mark(this->Path);
    std::filesystem::path name = base / this->Path.filename().string().substr(1);
    if (this->Lock >= 0 && systemCalls().rename(made.c_str(), name.c_str()) == 0)
    {
      this->Path.swap(name);
    }
  }
  catch (...) // no memory
  {
    systemCalls().close(this->Lock);
    removeFolder(made.c_str());
    throw;
  }
}

bool ScratchFolder::isOne(const std::filesystem::path& folder)
{
  std::error_code ignored;
  return std::filesystem::exists(folder / Marker, ignored);
}

ScratchFolder::~ScratchFolder()
{
  removeFolder(this->Path.c_str());
  if (this->Lock >= 0)
  {
    systemCalls().close(this->Lock);
  }
}

} // namespace smg
