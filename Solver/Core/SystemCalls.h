// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <cstddef>
#include <dirent.h>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>

namespace smg
{

/** The calls to the system that concern files and the mapping of memory. What Solver and IO do with
 * files goes through this table, as in the Unix layer of SQLite. Each entry behaves like the call
 * of its name; a test replaces entries to make the n-th call fail. */
struct SystemCalls
{
  int (*open)(const char* path, int flags, mode_t mode);
  int (*close)(int file);
  ssize_t (*pread)(int file, void* bytes, std::size_t size, off_t offset);
  ssize_t (*preadv2)(int file, const iovec* parts, int count, off_t offset, int flags);
  ssize_t (*pwrite)(int file, const void* bytes, std::size_t size, off_t offset);
  int (*fstat)(int file, struct stat* status);
  int (*fsync)(int file);
  int (*fallocate)(int file, int mode, off_t offset, off_t size);
  int (*ftruncate)(int file, off_t size);
  int (*rename)(const char* from, const char* to);
  int (*linkat)(int fromFolder, const char* from, int toFolder, const char* to, int flags);
  int (*unlink)(const char* path);
  int (*unlinkat)(int folder, const char* name, int flags);
  DIR* (*opendir)(const char* path);
  char* (*mkdtemp)(char* pattern);
  int (*mkdir)(const char* path, mode_t mode);
  int (*memfd_create)(const char* name, unsigned flags);
  void* (*mmap)(void* address, std::size_t size, int protection, int flags, int file, off_t offset);
};

/** The table of this process. It may be changed only while no file is in use. */
SMG_EXPORT SystemCalls& systemCalls() noexcept;

/** The system's description of an error number, and what a user can do about it. */
std::string systemError(int errorNumber);

} // namespace smg
