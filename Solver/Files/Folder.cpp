// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/Folder.h"

#include "Solver/Core/Forks.h"
#include "Solver/Core/SystemCalls.h"
#include "smg/Error.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

// Folders without std::filesystem's exceptions, temporary files beside a result, and locks.
//
// A temporary file counts as abandoned when nobody holds its lock: the kernel releases a lock when
// its holder ends, however it ends. Process numbers are reused, and the age of a file says nothing.
// Where the file system has no locks nothing is ever removed.

namespace smg
{
namespace
{

/** Removes a file or, from the leaves up, a folder. It works with descriptors relative to the
 * parent, so that a link that somebody puts in the way cannot lead the removal out of the
 * folder. */
void removeEntry(int parent, const char* name) noexcept
{
  if (systemCalls().unlinkat(parent, name, 0) == 0)
  {
    return;
  }
  // unlinkat() refuses folders. O_NOFOLLOW: what was a folder may be a link by this time.
  const int file = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  // Without a descriptor, of which the process may have none left, an empty folder can go all the
  // same.
  if (file >= 0)
  {
    FolderEntries entries(file);
    while (const char* entry = entries.next())
    {
      removeEntry(file, entry);
    }
    if (!entries.isOpen())
    {
      ::close(file);
    }
  }
  systemCalls().unlinkat(parent, name, AT_REMOVEDIR);
}

} // namespace

FolderEntries::FolderEntries(const std::filesystem::path& folder) noexcept
  : Opened(systemCalls().opendir(folder.c_str()))
{
}

FolderEntries::FolderEntries(int file) noexcept
  : Opened(::fdopendir(file))
{
}

FolderEntries::~FolderEntries()
{
  if (this->Opened)
  {
    ::closedir(this->Opened);
  }
}

const char* FolderEntries::next() noexcept
{
  while (const dirent* entry = this->Opened ? ::readdir(this->Opened) : nullptr)
  {
    if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
    {
      return entry->d_name;
    }
  }
  return nullptr;
}

void removeFolder(const char* folder) noexcept
{
  removeEntry(AT_FDCWD, folder);
}

namespace
{

constexpr std::string_view Infix = ".part-";

bool isNumber(std::string_view text)
{
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/** Whether `name` is a temporaryName() of the file `of`. */
bool isTemporaryOf(std::string_view name, std::string_view of)
{
  if (!name.starts_with(of) || !name.substr(of.size()).starts_with(Infix))
  {
    return false;
  }
  const std::string_view numbers = name.substr(of.size() + Infix.size());
  const std::size_t dash = numbers.find('-');
  return dash != std::string_view::npos && isNumber(numbers.substr(0, dash)) &&
         isNumber(numbers.substr(dash + 1));
}

/** A lock of the open file (F_OFD_SETLK), not flock(): HDF5 uses flock() to protect a file that it
 * writes, and would find the file taken by us. */
bool lock(int file) noexcept
{
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return ::fcntl(file, F_OFD_SETLK, &whole) == 0;
}

} // namespace

std::filesystem::path temporaryName(const std::filesystem::path& path)
{
  // The process number tells programs apart, the counter the files of this one.
  static std::atomic<unsigned> count{ 0 };
  return path.string() + std::string(Infix) + std::to_string(::getpid()) + "-" +
         std::to_string(count++);
}

bool isOwnTemporary(const std::filesystem::path& name)
{
  const std::string own = std::string(Infix) + std::to_string(::getpid()) + "-";
  return name.filename().native().find(own) != std::string::npos;
}

bool lockTemporary(int file) noexcept
{
  // Between creation and lock, another program may have found the file, locked and removed it. Then
  // it has no name any more, which the number of its links says, and the caller makes another one.
  lock(file); // where there are no locks, nothing is removed either
  struct stat status = {};
  return systemCalls().fstat(file, &status) != 0 || status.st_nlink > 0;
}

void removeAbandonedTemporaries(const std::filesystem::path& path)
{
  // Only names that temporaryName() can have made for this file: everything else is the user's.
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const std::string of = path.filename().string();
  FolderEntries entries(folder);
  while (const char* name = entries.next())
  {
    if (!isTemporaryOf(name, of))
    {
      continue;
    }
    const std::string found = (folder / name).string();
    // O_RDWR since a write lock needs it; O_NONBLOCK so that a named pipe does not wait for a
    // writer.
    const int file =
      systemCalls().open(found.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0);
    if (file >= 0)
    {
      // Nobody holds it, so its program has ended. The name is removed while the lock is held: a
      // program that is just creating a file of this name sees that it is gone (lockTemporary).
      if (lock(file))
      {
        systemCalls().unlink(found.c_str());
      }
      systemCalls().close(file);
    }
  }
}

namespace
{

/** Guards the list of locks and their use. */
std::mutex& lockGuard()
{
  static ForkedMutex mutex;
  return mutex;
}

/** The locks of this process. flock() belongs to an open folder: a second descriptor of the same
 * folder in the same process would be refused, so parts of a program share one lock instead. */
std::vector<std::weak_ptr<FolderLock>>& heldLocks()
{
  static std::vector<std::weak_ptr<FolderLock>> locks;
  return locks;
}

/** A folder is known by device and inode: its path may be spelled in several ways. */
bool areSame(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

[[noreturn]] void failUsed(const std::filesystem::path& folder)
{
  throw Error(
    folder.string() +
    ": another program is using this checkpoint, or a result of this one that is still open: "
    "wait for its end, or name another folder.");
}

/** The lock of this folder if this process already has it, else null. */
std::shared_ptr<FolderLock> held(const struct stat& folder)
{
  std::vector<std::weak_ptr<FolderLock>>& locks = heldLocks();
  // The list is short and rarely used, so expired entries are removed here rather than by
  // destructors.
  std::erase_if(locks, [](const std::weak_ptr<FolderLock>& lock) { return lock.expired(); });
  for (const std::weak_ptr<FolderLock>& each : locks)
  {
    std::shared_ptr<FolderLock> lock = each.lock();
    struct stat status = {};
    if (lock && systemCalls().fstat(lock->folder(), &status) == 0 && areSame(status, folder))
    {
      return lock;
    }
  }
  return nullptr;
}

/** An open folder, which is closed unless its descriptor is taken over. */
struct OpenFolder
{
  explicit OpenFolder(const std::filesystem::path& path)
    : number(systemCalls().open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0))
  {
  }
  ~OpenFolder()
  {
    if (this->number >= 0)
    {
      systemCalls().close(this->number);
    }
  }
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;

  int number;
};

} // namespace

std::shared_ptr<FolderLock> FolderLock::acquire(const std::filesystem::path& folder)
{
  const std::lock_guard guarded(lockGuard());
  OpenFolder opened(folder);
  struct stat status = {}, named = {};
  if (opened.number < 0 || systemCalls().fstat(opened.number, &status) != 0)
  {
    throw Error(folder.string() + ": the folder cannot be opened: " + systemError(errno) + '.');
  }
  if (std::shared_ptr<FolderLock> lock = held(status))
  {
    return lock;
  }
  // Not waiting: another program may hold the checkpoint for hours.
  if (::flock(opened.number, LOCK_EX | LOCK_NB) != 0)
  {
    if (errno == EWOULDBLOCK)
    {
      failUsed(folder);
    }
    throw Error(folder.string() + ": the folder cannot be locked: " + systemError(errno) + '.');
  }
  // Between opening and locking, another program may have removed the folder and a third one made
  // it again. The lock would then be on a folder without a name, and protect nothing.
  if (::stat(folder.c_str(), &named) != 0 || !areSame(status, named))
  {
    failUsed(folder);
  }
  // From here on the lock owns the descriptor, even if there is no memory for the shared_ptr.
  std::unique_ptr<FolderLock> owner(new FolderLock(opened.number));
  opened.number = -1;
  const std::shared_ptr<FolderLock> lock = std::move(owner);
  heldLocks().push_back(lock);
  return lock;
}

FolderLock::~FolderLock()
{
  this->leaveToParent();
}

void FolderLock::leaveToParent() noexcept
{
  if (this->Folder >= 0)
  {
    systemCalls().close(this->Folder);
    this->Folder = -1;
  }
}

void FolderLock::use(const std::filesystem::path& folder)
{
  const std::lock_guard guarded(lockGuard());
  if (this->IsUsed)
  {
    failUsed(folder);
  }
  this->IsUsed = true;
}

void FolderLock::endUse() noexcept
{
  const std::lock_guard guarded(lockGuard());
  this->IsUsed = false;
}

} // namespace smg
