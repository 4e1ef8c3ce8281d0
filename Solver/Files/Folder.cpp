// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/Folder.h"

#include "Solver/Core/SystemCalls.h"

#include <cstring>
#include <fcntl.h>
#include <unistd.h>

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

} // namespace smg
