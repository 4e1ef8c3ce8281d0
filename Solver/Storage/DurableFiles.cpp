// SPDX-License-Identifier: BSD-3-Clause
// What makes files and their names durable.
#include "Solver/Storage/FileDescriptor.h"

#include "Solver/Storage/ScratchAccount.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Solver/Storage/SystemCalls.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>

namespace smg
{
namespace
{

std::atomic<bool> durable{ true };

} // namespace

void FileDescriptor::renameTo(const std::filesystem::path& path)
{
  const std::filesystem::path target = targetOf(path);
  const bool isKept = !ScratchFolder::isOne(target.parent_path());
  if (isKept)
  {
    this->sync();
  }
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
    syncPath(target.parent_path());
  }
}

void FileDescriptor::setDurable(bool isDurable) noexcept
{
  durable = isDurable;
}

void FileDescriptor::sync() const
{
  // Some file systems have no such call.
  if (durable && systemCalls().fsync(this->Number) != 0 && errno != EINVAL && errno != ENOTSUP)
  {
    throwWriteError(this->Shown, errno);
  }
}

void FileDescriptor::syncPath(const std::filesystem::path& path)
{
  FileDescriptor file;
  file.Shown = path.empty() ? std::filesystem::path(".") : path;
  file.Number = systemCalls().open(file.Shown.c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (file.isOpen())
  {
    file.sync();
  }
  else if (errno != EACCES) // a folder in which one may write, but not read
  {
    throwWriteError(file.Shown, errno);
  }
}

} // namespace smg
