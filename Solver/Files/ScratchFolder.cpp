// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchFolder.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/Folder.h"
#include "Solver/Files/ScratchAccount.h"
#include "smg/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
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
/** A file that only kept folders have. */
constexpr const char* KeptMarker = "smg-checkpoint";
/** With this begin the names of the scratch files of kept folders. */
constexpr const char* KeptPrefix = "scratch.";

/** Whether a file of a kept folder is one of its own: the others are the user's. */
bool isOwn(std::string_view name)
{
  return name == KeptMarker || name.starts_with(KeptPrefix) || name.starts_with("state.") ||
         name.starts_with("state-");
}

/** The absolute path of a folder, without a slash at its end. */
std::filesystem::path folderPath(const std::filesystem::path& given)
{
  std::filesystem::path path = given.lexically_normal();
  path = path.has_filename() ? path : path.parent_path();
  return std::filesystem::absolute(FileDescriptor::targetOf(path)).lexically_normal();
}

/** A descriptor of the folder that holds its lock; -1 if it is locked or does not support locks,
 * with errno. */
int lockFolder(const std::filesystem::path& folder)
{
  const int lock =
    systemCalls().open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC, 0);
  if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0)
  {
    const int error = errno;
    systemCalls().close(lock);
    errno = error;
    return -1;
  }
  return lock;
}

/** Makes a folder in `base` and locks it, if it supports locks: `lock` is -1 if not. */
std::string makeLocked(const std::filesystem::path& base, int& lock)
{
  for (;;)
  {
    std::string made = (base / (std::string(".") + Prefix + "XXXXXX")).string();
    if (!systemCalls().mkdtemp(made.data()))
    {
      throw Error("cannot make a scratch folder in " + base.string() + ": " + std::strerror(errno) +
                  "; name another one");
    }
    lock = lockFolder(made);
    struct stat status = {};
    const bool isRemoved = lock >= 0
                             ? systemCalls().fstat(lock, &status) == 0 && status.st_nlink == 0
                             : errno == EWOULDBLOCK || errno == ENOENT;
    if (!isRemoved)
    {
      return made;
    }
    // Before the lock, another program has taken it for an abandoned one.
    if (lock >= 0)
    {
      systemCalls().close(lock);
    }
  }
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

/** Whether a name without a dot is one that mkdtemp() makes. */
bool isMade(std::string_view name)
{
  constexpr std::size_t Random = 6;
  const std::string_view prefix = Prefix;
  return name.starts_with(prefix) && name.size() == prefix.size() + Random &&
         std::ranges::all_of(
           name.substr(prefix.size()), [](unsigned char c) { return std::isalnum(c) != 0; });
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
    const bool isMarked = plain.starts_with(Prefix) && ScratchFolder::isOne(folder);
    if (!isMarked && !isMade(plain))
    {
      continue;
    }
    if (const int lock = lockFolder(folder); lock >= 0)
    {
      if (isMarked)
      {
        removeFolder(folder.c_str());
      }
      else
      {
        // A power cut may take the marker, and the program may be killed before it. Only an empty
        // folder is removed.
        systemCalls().unlinkat(AT_FDCWD, folder.c_str(), AT_REMOVEDIR);
      }
      systemCalls().close(lock);
    }
  }
}

/** A file of a checkpoint is written under its name. Where somebody else has made the folder, a
 * link in it, symbolic or not, might lead to any file of the user. */
void requireOwnFiles(const std::filesystem::path& folder, int opened)
{
  FolderEntries entries(folder);
  while (const char* name = entries.next())
  {
    struct stat status = {};
    const bool known = ::fstatat(opened, name, &status, AT_SYMLINK_NOFOLLOW) == 0;
    if (isOwn(name) && !(known && S_ISREG(status.st_mode) && status.st_nlink == 1))
    {
      throw Error((folder / name).string() +
                  ": is not a regular file with this name alone, as those of a checkpoint are: "
                  "remove it, or name another folder.");
    }
  }
}

} // namespace

ScratchFolder::ScratchFolder(const std::filesystem::path& parent, std::int64_t limit)
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
  const std::string made = makeLocked(base, this->Lock);
  try
  {
    this->Path = made;
    mark(this->Path);
    std::filesystem::path name = base / this->Path.filename().string().substr(1);
    if (this->Lock >= 0 && systemCalls().rename(made.c_str(), name.c_str()) == 0)
    {
      this->Path.swap(name);
    }
    this->Account = ScratchAccount::open(this->Path, limit);
  }
  catch (...) // no memory
  {
    systemCalls().close(this->Lock);
    removeFolder(made.c_str());
    removeFolder(this->Path.c_str());
    throw;
  }
}

bool ScratchFolder::isOne(const std::filesystem::path& folder)
{
  std::error_code ignored;
  return std::filesystem::exists(folder / Marker, ignored);
}

ScratchFolder::ScratchFolder(const KeptFolder& kept, std::int64_t limit)
  : Path(folderPath(kept.path))
{
  if (systemCalls().mkdir(this->Path.c_str(), 0777) == 0)
  {
    FileDescriptor::syncPath(this->Path.parent_path(), this->Path);
  }
  else if (errno != EEXIST)
  {
    throw Error(this->Path.string() + ": the folder cannot be made: " + std::strerror(errno) + '.');
  }
  this->KeptLock = FolderLock::acquire(this->Path);
  this->KeptLock->use(this->Path);
  try
  {
    this->openKept();
    this->Account = ScratchAccount::open(this->Path, limit);
    this->countKept();
  }
  catch (...)
  {
    if (this->Account)
    {
      this->Account->close(this->Path);
    }
    this->KeptLock->endUse();
    throw;
  }
}

/** Checks a kept folder, and marks it if it is empty. */
void ScratchFolder::openKept()
{
  const std::filesystem::path marker = this->Path / KeptMarker;
  this->Remains = std::filesystem::is_regular_file(std::filesystem::symlink_status(marker));
  if (!this->Remains && FolderEntries(this->Path).next())
  {
    throw Error(this->Path.string() + ": is neither empty nor a checkpoint: name another folder.");
  }
  requireOwnFiles(this->Path, this->KeptLock->folder());
  FileDescriptor::openOrCreate(marker).close();
  if (!this->Remains)
  {
    // After a power cut, files without the marker would not be a checkpoint.
    FileDescriptor::syncPath(this->Path, this->Path);
  }
}

/** Counts the files of an earlier program. */
void ScratchFolder::countKept()
{
  FolderEntries entries(this->Path);
  while (const char* name = entries.next())
  {
    if (!isOwn(name))
    {
      continue;
    }
    std::error_code unknown;
    const std::filesystem::path path = this->Path / name;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    ScratchShare share(this->Account);
    if (!share.extend(unknown ? 0 : static_cast<std::int64_t>(size)))
    {
      FileDescriptor::throwWriteError(path, FileDescriptor::ScratchLimit);
    }
    share.keep(path);
  }
}

std::filesystem::path ScratchFolder::placeOf(std::filesystem::path folder)
{
  while (folder.filename().native().starts_with(Prefix))
  {
    folder = folder.parent_path();
  }
  return folder;
}

ScratchFolder::~ScratchFolder()
{
  this->Account->close(this->Path);
  if (!this->KeptLock)
  {
    removeFolder(this->Path.c_str());
  }
  else
  {
    if (!this->Remains)
    {
      this->removeKept();
    }
    this->KeptLock->endUse();
  }
  if (this->Lock >= 0)
  {
    systemCalls().close(this->Lock);
  }
}

/** Removes a kept folder: its own files, and, where no others are in it, the folder. States go
 * before the files that they refer to, and these before the marker, also on the disk, since the
 * program may be killed, and the power cut, in between. */
void ScratchFolder::removeKept() const noexcept
{
  const int folder = this->KeptLock->folder();
  bool areGone = true;
  for (const bool states : { true, false })
  {
    FolderEntries entries(this->Path);
    areGone = entries.isOpen() && areGone;
    while (const char* name = entries.next())
    {
      if (isOwn(name) && std::string_view(name) != KeptMarker &&
          states != std::string_view(name).starts_with(KeptPrefix))
      {
        areGone = systemCalls().unlinkat(folder, name, 0) == 0 && areGone;
      }
    }
    FileDescriptor::trySync(folder);
  }
  if (areGone) // without the marker the rest would be refused
  {
    systemCalls().unlinkat(folder, KeptMarker, 0);
    systemCalls().unlinkat(AT_FDCWD, this->Path.c_str(), AT_REMOVEDIR);
  }
}

std::filesystem::path ScratchFolder::pathOf(const std::string& name) const
{
  return this->Path / (KeptPrefix + name);
}

FileDescriptor ScratchFolder::file(const std::string& name) const
{
  return this->KeptLock ? FileDescriptor::openOrCreate(this->pathOf(name))
                        : FileDescriptor::createNameless(this->Path);
}

} // namespace smg
