// SPDX-License-Identifier: BSD-3-Clause
// A library that is loaded before a program (LD_PRELOAD) and records its calls to the system that
// change files, with their data, in the file SMG_RECORD. From this record power_cut.py rebuilds
// what may be on the disk after a power cut. One line for each call that succeeded, with absolute
// paths:
//   open FILE FLAGS PATH       pwrite FILE OFFSET SIZE, then so many bytes and a line break
//   ftruncate FILE SIZE        fsync FILE             close FILE
//   link FILE PATH             rename FROM<tab>TO     unlink PATH     rmdir PATH     mkdir PATH
// FILE is the number of the file descriptor.
#include "Solver/Core/SystemCalls.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace smg::testing
{
namespace
{

const SystemCalls real = systemCalls();
int record = -1;
/** The order of the record is that of the calls: no call begins before the one before is recorded.
 */
std::mutex oneAtATime;

std::string absolute(const std::string& path)
{
  return std::filesystem::absolute(path).lexically_normal().string();
}

/** The path of `name`, relative to an open folder. */
std::string absolute(int folder, const std::string& name)
{
  if (folder == AT_FDCWD || name.starts_with('/'))
  {
    return absolute(name);
  }
  return (std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(folder)) / name).string();
}

void put(std::string_view bytes)
{
  while (!bytes.empty())
  {
    const ssize_t done = ::write(record, bytes.data(), bytes.size());
    if (done <= 0)
    {
      std::abort(); // an incomplete record would be misleading
    }
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

template <typename... Words>
void put(const Words&... words)
{
  const int error = errno;
  std::ostringstream line;
  const char* gap = "";
  ((line << gap << words, gap = " "), ...);
  line << '\n';
  put(std::string_view(line.view()));
  errno = error;
}

/** Does a call, and records these words if it returns no error. */
template <typename Call, typename... Words>
auto recorded(const Call& call, const Words&... words)
{
  const std::lock_guard guarded(oneAtATime);
  const auto result = call();
  if (result == 0)
  {
    put(words...);
  }
  return result;
}

int openRecorded(const char* path, int flags, mode_t mode)
{
  const std::lock_guard guarded(oneAtATime);
  const int file = real.open(path, flags, mode);
  if (file >= 0)
  {
    put("open", file, flags, absolute(path));
  }
  return file;
}

ssize_t pwriteRecorded(int file, const void* bytes, std::size_t size, off_t offset)
{
  const std::lock_guard guarded(oneAtATime);
  const ssize_t done = real.pwrite(file, bytes, size, offset);
  if (done > 0)
  {
    put("pwrite", file, offset, done);
    put(std::string_view(static_cast<const char*>(bytes), static_cast<std::size_t>(done)));
    put("");
  }
  return done;
}

int linkRecorded(int fromFolder, const char* from, int toFolder, const char* to, int flags)
{
  constexpr std::string_view Own = "/proc/self/fd/";
  if (!std::string_view(from).starts_with(Own))
  {
    std::abort(); // the record has no links of named files: the libraries make none
  }
  return recorded([&] { return real.linkat(fromFolder, from, toFolder, to, flags); }, "link",
    from + Own.size(), absolute(toFolder, to));
}

char* mkdtempRecorded(char* pattern)
{
  const std::lock_guard guarded(oneAtATime);
  char* const made = real.mkdtemp(pattern);
  if (made)
  {
    put("mkdir", absolute(made));
  }
  return made;
}

SystemCalls recording()
{
  SystemCalls calls = real;
  calls.open = openRecorded;
  calls.pwrite = pwriteRecorded;
  calls.linkat = linkRecorded;
  calls.mkdtemp = mkdtempRecorded;
  calls.close = [](int file) { return recorded([&] { return real.close(file); }, "close", file); };
  calls.fsync = [](int file) { return recorded([&] { return real.fsync(file); }, "fsync", file); };
  calls.ftruncate = [](int file, off_t size)
  { return recorded([&] { return real.ftruncate(file, size); }, "ftruncate", file, size); };
  calls.fallocate = [](int file, int mode, off_t offset, off_t size)
  {
    if (!(mode & FALLOC_FL_KEEP_SIZE))
    {
      std::abort(); // reserving room does not change a file; anything else would have to be
                    // recorded
    }
    return real.fallocate(file, mode, offset, size);
  };
  calls.rename = [](const char* from, const char* to)
  {
    return recorded(
      [&] { return real.rename(from, to); }, "rename", absolute(from) + '\t' + absolute(to));
  };
  calls.unlink = [](const char* path)
  { return recorded([&] { return real.unlink(path); }, "unlink", absolute(path)); };
  calls.unlinkat = [](int folder, const char* name, int flags)
  {
    // Before the call, since it may be relative to a folder that it removes.
    const std::string path = absolute(folder, name);
    return recorded([&] { return real.unlinkat(folder, name, flags); },
      flags & AT_REMOVEDIR ? "rmdir" : "unlink", path);
  };
  calls.mkdir = [](const char* path, mode_t mode)
  { return recorded([&] { return real.mkdir(path, mode); }, "mkdir", absolute(path)); };
  return calls;
}

/** Installed after the libraries are initialized. */
const bool installed = []
{
  if (const char* name = std::getenv("SMG_RECORD"))
  {
    record = ::open(name, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
    if (record < 0)
    {
      std::abort();
    }
    systemCalls() = recording();
  }
  return true;
}();

} // namespace
} // namespace smg::testing
