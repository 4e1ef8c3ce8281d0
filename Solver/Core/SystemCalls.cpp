// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/SystemCalls.h"

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
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

} // namespace smg
