// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/TemporaryFiles.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/Folder.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace smg
{
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

} // namespace smg
