// SPDX-License-Identifier: BSD-3-Clause
// What makes files and their names durable.
#include "Solver/Files/FileDescriptor.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Core/SystemError.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>

namespace smg
{
namespace
{

std::atomic<bool> durable{ true };

/** Fsync; some file systems have none. */
bool sync(int file) noexcept
{
  int result = 0;
  do
  {
    result = systemCalls().fsync(file);
  } while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP;
}

/** Keeps the lock of a temporary file while it is closed, which may report an error, and renamed.
 */
class LockedUntilRenamed
{
public:
  explicit LockedUntilRenamed(int file)
    : Copy(::fcntl(file, F_DUPFD_CLOEXEC, 0))
  {
  }
  ~LockedUntilRenamed()
  {
    if (this->Copy >= 0)
    {
      systemCalls().close(this->Copy);
    }
  }
  LockedUntilRenamed(const LockedUntilRenamed&) = delete;
  LockedUntilRenamed& operator=(const LockedUntilRenamed&) = delete;

private:
  int Copy;
};

} // namespace

void FileDescriptor::renameTo(const std::filesystem::path& path)
{
  const std::filesystem::path target = targetOf(path);
  const bool isKept = !ScratchFolder::isOne(target.parent_path());
  if (isKept)
  {
    this->sync();
  }
  const LockedUntilRenamed lock(this->Number);
  this->close();
  if (systemCalls().rename(this->Path.c_str(), target.c_str()) != 0)
  {
    throwWriteError(path, errno);
  }
  this->IsTemporary = false;
  if (this->Share)
  {
    this->Share->keep(target);
  }
  if (isKept)
  {
    syncPath(target.parent_path(), path);
  }
}

void FileDescriptor::setDurable(bool isDurable) noexcept
{
  durable = isDurable;
}

void FileDescriptor::sync() const
{
  if (!trySync(this->Number))
  {
    throwWriteError(this->Shown, errno);
  }
}

bool FileDescriptor::trySync(int file) noexcept
{
  return !durable || smg::sync(file);
}

void FileDescriptor::syncPath(const std::filesystem::path& path, const std::filesystem::path& shown)
{
  const std::filesystem::path place = path.empty() ? std::filesystem::path(".") : path;
  const int file = systemCalls().open(place.c_str(), O_RDONLY | O_CLOEXEC, 0);
  // There are folders in which one may write, but not read.
  const bool good = file >= 0 ? trySync(file) : errno == EACCES;
  const int error = errno;
  if (file >= 0)
  {
    systemCalls().close(file);
  }
  if (!good)
  {
    throw Error(shown.string() +
                ": is written, but may be lost in a power cut, since its folder cannot be: " +
                systemError(error) + '.');
  }
}

} // namespace smg
