// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/Folder.h"

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

namespace smg
{
namespace
{

void removeEntry(int parent, const char* name) noexcept
{
  if (systemCalls().unlinkat(parent, name, 0) == 0)
  {
    return;
  }
  const int file = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0)
  {
    return;
  }
  const int own = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  FolderEntries entries(file);
  while (const char* entry = entries.next())
  {
    removeEntry(own, entry);
  }
  ::close(own);
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

/** Not flock(): with that HDF5 protects a file that it writes from us. */
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
  static std::atomic<unsigned> count{ 0 };
  return path.string() + std::string(Infix) + std::to_string(::getpid()) + "-" +
         std::to_string(count++);
}

bool lockTemporary(int file) noexcept
{
  lock(file); // where there are no locks, nothing is removed either
  struct stat status = {};
  return systemCalls().fstat(file, &status) != 0 || status.st_nlink > 0;
}

void removeAbandonedTemporaries(const std::filesystem::path& path)
{
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
    const int file =
      systemCalls().open(found.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0);
    if (file >= 0)
    {
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
  static std::mutex mutex;
  return mutex;
}

std::vector<std::weak_ptr<FolderLock>>& heldLocks()
{
  static std::vector<std::weak_ptr<FolderLock>> locks;
  return locks;
}

bool areSame(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

[[noreturn]] void failUsed(const std::filesystem::path& folder)
{
  throw Error(folder.string() +
              ": another program is using this checkpoint: wait for its end, or name another "
              "folder.");
}

/** The lock of this folder, if the program has it. */
std::shared_ptr<FolderLock> held(const struct stat& folder)
{
  std::vector<std::weak_ptr<FolderLock>>& locks = heldLocks();
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

/** An open folder, closed unless it is released. */
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
  if (::flock(opened.number, LOCK_EX | LOCK_NB) != 0)
  {
    if (errno == EWOULDBLOCK)
    {
      failUsed(folder);
    }
    throw Error(folder.string() + ": the folder cannot be locked: " + systemError(errno) + '.');
  }
  // Another program may have removed the folder, and a third one made it anew, before the lock.
  if (::stat(folder.c_str(), &named) != 0 || !areSame(status, named))
  {
    failUsed(folder);
  }
  // Owned from here on, also where there is no memory for the shared_ptr.
  std::unique_ptr<FolderLock> owner(new FolderLock(opened.number));
  opened.number = -1;
  const std::shared_ptr<FolderLock> lock = std::move(owner);
  heldLocks().push_back(lock);
  return lock;
}

FolderLock::~FolderLock()
{
  systemCalls().close(this->Folder);
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
