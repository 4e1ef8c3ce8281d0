// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/SystemCalls.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace smg
{

SystemCalls& systemCalls() noexcept
{
  static SystemCalls calls{
    [](const char* path, int flags, mode_t mode) { return ::open(path, flags, mode); },
    ::close,
    ::pread,
    ::preadv2,
    ::pwrite,
    [](int file, struct stat* status) { return ::fstat(file, status); },
    ::fsync,
    ::fallocate,
    ::ftruncate,
    [](const char* from, const char* to) { return ::rename(from, to); },
    ::linkat,
    ::unlink,
    ::unlinkat,
    ::opendir,
    ::mkdtemp,
    ::mkdir,
    ::memfd_create,
    ::mmap,
  };
  return calls;
}

namespace
{

/** Empty: nothing that the system's own words do not say. */
const char* adviceOn(int errorNumber)
{
  switch (errorNumber)
  {
    case ENOSPC:
    case EDQUOT:
      return "; free space, or choose another folder";
    case EMFILE:
      return "; raise the limit of the process (ulimit -n)";
    case ENFILE:
      return "; close other programs";
    case EFBIG:
      return "; raise the limit of the process (ulimit -f), or choose another file system";
    case EIO:
      return "; check the disk and its connection";
    default:
      return "";
  }
}

} // namespace

std::string systemError(int errorNumber)
{
  return std::generic_category().message(errorNumber) + adviceOn(errorNumber);
}

} // namespace smg
