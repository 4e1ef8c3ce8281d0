// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FolderLock.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Core/SystemError.h"
#include "smg/Error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <mutex>
#include <string>
#include <vector>

namespace smg
{
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
