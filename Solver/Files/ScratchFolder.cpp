// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchFolder.h"

#include "Solver/Core/Forks.h"
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

// Folders of scratch files, of two kinds.
//
// A scratch folder is made for a run and removed with it. It is locked (flock) as long as its
// program runs, and has a marker, a file that no other folder has. A program that starts removes
// folders that have the marker and no lock: those of killed programs. In a file system without
// locks nothing is removed that way.
//
// A kept folder, for a checkpoint, has files with names and stays. Only files whose names begin as
// those of a checkpoint are ever written or removed in it; it is refused if it is neither empty nor
// marked as a checkpoint. Removal goes in an order such that a kill or a power cut at any moment
// leaves a checkpoint that continues, or one that is empty, but never states that refer to missing
// files.
//
// Folders belong to the process that made them: a forked child, whose objects are copies, can read
// their files but removes none, and does not hold their locks.

namespace smg
{
namespace
{

constexpr const char* Prefix = "smg-scratch-";
/** A file that only scratch folders have: no other folder is ever removed. */
constexpr const char* Marker = ".smg-scratch";
/** A file that only kept folders have. */
constexpr const char* KeptMarker = "smg-checkpoint";
/** In place of the descriptor of a lock: the folder is one of the process that has forked. */
constexpr int OfParent = -2;
/** With this begin the names of the scratch files of kept folders. */
constexpr const char* KeptPrefix = "scratch.";

/** Whether a file of a kept folder belongs to the checkpoint; all others are the user's. */
bool isOwn(std::string_view name)
{
  return name == KeptMarker || name.starts_with(KeptPrefix) || name.starts_with("state.") ||
         name.starts_with("state-");
}

/** The absolute path of a folder, without a slash at its end. */
std::filesystem::path folderPath(const std::filesystem::path& given)
{
  // "folder/" has an empty file name, and its parent is "folder".
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
    // close() may change errno, by which the caller tells a lock from a file system without locks.
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
    // mkdtemp() chooses a name that does not exist and makes the folder accessible to this user
    // alone.
    std::string made = (base / (std::string(".") + Prefix + "XXXXXX")).string();
    if (!systemCalls().mkdtemp(made.data()))
    {
      throw Error("cannot make a scratch folder in " + base.string() + ": " + std::strerror(errno) +
                  "; name another one");
    }
    // Between mkdtemp() and the lock the folder is empty and unlocked, like one of a program that
    // was killed there, and another program may remove it or be about to. Both show: in the number
    // of links of the locked folder, or in the lock that is refused. Then another folder is made.
    lock = lockFolder(made);
    struct stat status = {};
    const bool isRemoved = lock >= 0
                             ? systemCalls().fstat(lock, &status) == 0 && status.st_nlink == 0
                             : errno == EWOULDBLOCK || errno == ENOENT;
    if (!isRemoved)
    {
      return made;
    }
    // Another program has taken it for an abandoned one.
    if (lock >= 0)
    {
      systemCalls().close(lock);
    }
  }
}

/** Without the marker a folder is not removed with its content, whatever its name. That the marker
 * cannot be made is not an error: the folder is then only not cleaned up after a kill. */
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

/** From now on the object of a forked child leaves the folder, and its lock, to the parent, whose
 * own descriptors keep it. */
void leaveToParent(const ScratchFolder& folder, int& lock, FolderLock* kept)
{
  const auto inherit = [&lock, kept]
  {
    if (lock >= 0)
    {
      systemCalls().close(lock);
    }
    lock = OfParent;
    if (kept)
    {
      kept->leaveToParent();
    }
  };
  ForkedObjects::all().add(&folder, { {}, {}, inherit });
}

/** Removes the scratch folders of terminated programs in `base`. */
void removeAbandoned(const std::filesystem::path& base)
{
  FolderEntries entries(base);
  while (const char* name = entries.next())
  {
    const std::filesystem::path folder = base / name;
    // A program that was killed before it renamed the folder has left a name that begins with a
    // dot.
    const std::string_view plain = std::string_view(name).substr(*name == '.' ? 1 : 0);
    // Only folders with the marker, or with a name that mkdtemp() makes, are opened at all.
    const bool isMarked = plain.starts_with(Prefix) && ScratchFolder::isOne(folder);
    if (!isMarked && !isMade(plain))
    {
      continue;
    }
    // The lock was free, so the program that made the folder has ended. It is held during the
    // removal, so that two programs do not remove the same folder.
    if (const int lock = lockFolder(folder); lock >= 0)
    {
      if (isMarked)
      {
        removeFolder(folder.c_str());
      }
      else
      {
        // A power cut may have taken the marker, or the program was killed before it made it. What
        // is in such a folder is not known to be ours, so it is removed only if it is empty.
        systemCalls().unlinkat(AT_FDCWD, folder.c_str(), AT_REMOVEDIR);
      }
      systemCalls().close(lock);
    }
  }
}

/** Requires that the files of a checkpoint are regular files with one name each. They are written
 * under their names; in a folder that somebody else has made, a link, symbolic or hard, might lead
 * to any file of the user. */
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
  // $TMPDIR may name a folder that does not exist.
  std::error_code failed;
  const std::filesystem::path place =
    parent.empty() ? std::filesystem::temp_directory_path(failed) : parent;
  if (failed)
  {
    throw Error("there is no temporary folder (" + failed.message() + "): name a scratch folder");
  }
  // Absolute, since the program may change its working folder before the files are removed.
  const std::filesystem::path base = std::filesystem::absolute(place);
  removeAbandoned(base);
  // The folder gets its final name, without the dot, when it is locked and marked.
  const std::string made = makeLocked(base, this->Lock);
  try
  {
    this->Path = made;
    mark(this->Path);
    std::filesystem::path name = base / this->Path.filename().string().substr(1);
    // A failed renaming changes nothing that matters: the folder is used under the name that it
    // has.
    if (this->Lock >= 0 && systemCalls().rename(made.c_str(), name.c_str()) == 0)
    {
      this->Path.swap(name);
    }
    this->Account = ScratchAccount::open(this->Path, limit);
    leaveToParent(*this, this->Lock, nullptr);
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
  // The name of a new folder is made durable at once: what is synchronised in it would otherwise be
  // lost with it in a power cut.
  if (systemCalls().mkdir(this->Path.c_str(), 0777) == 0)
  {
    FileDescriptor::syncPath(this->Path.parent_path(), this->Path);
  }
  else if (errno != EEXIST)
  {
    throw Error(this->Path.string() + ": the folder cannot be made: " + std::strerror(errno) + '.');
  }
  // The lock comes before everything that reads or changes the folder.
  this->KeptLock = FolderLock::acquire(this->Path);
  this->KeptLock->use(this->Path);
  try
  {
    this->openKept();
    this->Account = ScratchAccount::open(this->Path, limit);
    this->countKept();
    leaveToParent(*this, this->Lock, this->KeptLock.get());
  }
  catch (...)
  {
    // The folder stays; only its account and its use end.
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
  // A folder with the marker is a checkpoint. Any other folder must be empty, so that no file of
  // the user can be taken for one of a checkpoint.
  const std::filesystem::path marker = this->Path / KeptMarker;
  // symlink_status: a marker that is a link does not count.
  this->Remains = std::filesystem::is_regular_file(std::filesystem::symlink_status(marker));
  if (!this->Remains && FolderEntries(this->Path).next())
  {
    throw Error(this->Path.string() + ": is neither empty nor a checkpoint: name another folder.");
  }
  requireOwnFiles(this->Path, this->KeptLock->folder());
  FileDescriptor::openOrCreate(marker).close();
  if (!this->Remains)
  {
    // The marker must be on the disk before any other file: after a power cut, files without it
    // would be refused.
    FileDescriptor::syncPath(this->Path, this->Path);
  }
}

/** Counts the files that an earlier program has left: they are on the disk, and count in the
 * limit. */
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
    // A file that has vanished meanwhile counts nothing.
    if (!share.extend(unknown ? 0 : static_cast<std::int64_t>(size)))
    {
      FileDescriptor::throwWriteError(path, FileDescriptor::ScratchLimit);
    }
    share.keep(path);
  }
}

std::filesystem::path ScratchFolder::placeOf(std::filesystem::path folder)
{
  // Scratch folders may lie in one another.
  while (folder.filename().native().starts_with(Prefix))
  {
    folder = folder.parent_path();
  }
  return folder;
}

ScratchFolder::~ScratchFolder()
{
  ForkedObjects::all().remove(this);
  if (this->Lock == OfParent)
  {
    return;
  }
  // First the account: what follows removes files without telling it of each.
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

/**
 * Removes the files of a checkpoint and, if no others are in it, the folder: first the states, then
 * the scratch files that they refer to, then the marker. Each step is made durable before the next,
 * so that a kill or a power cut in between never leaves a state without its files, or files without
 * the marker.
 */
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
        // Relative to the locked folder: its path may lead elsewhere by now.
        areGone = systemCalls().unlinkat(folder, name, 0) == 0 && areGone;
      }
    }
    // Removals reach the disk in any order unless they are waited for.
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
