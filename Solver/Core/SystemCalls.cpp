// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/SystemCalls.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

// The table of system calls, and the words for their errors. A call through the table costs an
// indirect jump; in exchange, a test can replace any entry, let the n-th call fail and see what
// becomes of the files (docs/reliability.md). Locks, readdir() and advice on reading ahead are
// called directly.

namespace smg
{

SystemCalls& systemCalls() noexcept
{
  // open() is variadic, so its address does not have the type of the entry.
  // A function's static: the table must exist before constructors of global objects use files.
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

/** What a user can do about an error; empty where the system's own words say it. */
const char* adviceOn(int errorNumber)
{
  switch (errorNumber)
  {
    // The disk is full, or the quota of the user is used up.
    case ENOSPC:
    case EDQUOT:
      return "; free space, or choose another folder";
    // The limit of this process; the next one is the limit of the whole machine.
    case EMFILE:
      return "; raise the limit of the process (ulimit -n)";
    case ENFILE:
      return "; close other programs";
    // A limit of the process, or the largest file that the file system can have.
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
