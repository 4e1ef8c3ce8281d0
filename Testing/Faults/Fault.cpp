// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Faults/Fault.h"

#include "Solver/Core/SystemCalls.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/stat.h>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

const SystemCalls real = systemCalls();
Fault plan;
std::atomic<std::int64_t> counted{ 0 };
std::vector<std::pair<dev_t, ino_t>> spared;

/** Whether the fault is one of this call. */
bool concerns(const std::string& call)
{
  const bool isMemory = call == "mmap" || call == "memfd_create" || call == "ftruncate";
  // Without unlink() and unlinkat(), what a failed command leaves could not be removed.
  const bool isCleaning = call == "unlink" || call == "unlinkat";
  return plan.call == "files"    ? !isMemory && !isCleaning
         : plan.call == "memory" ? isMemory
                                 : plan.call == call;
}

/** Whether the fault strikes this call, in which it can occur. */
bool strikes(const char* call)
{
  if (!concerns(call))
  {
    return false;
  }
  const std::int64_t number = ++counted;
  const bool strikes = plan.nth > 0 && (plan.forever ? number >= plan.nth : number == plan.nth);
  if (strikes && plan.kind == Fault::Kind::Kill)
  {
    std::raise(SIGKILL);
  }
  return strikes;
}

/** Whether the bits of a file are never wrong. */
bool isSpared(int file)
{
  struct stat status = {};
  return !spared.empty() && real.fstat(file, &status) == 0 &&
         std::ranges::count(spared, std::pair(status.st_dev, status.st_ino)) > 0;
}

/** The same for calls that only fail or not. */
bool fails(const char* call)
{
  const bool canOccur = plan.kind == Fault::Kind::Error || plan.kind == Fault::Kind::Kill;
  const bool failed = canOccur && strikes(call);
  errno = failed ? plan.error : errno;
  return failed;
}

/** A transfer of bytes; `transfer` does that of the given number. */
template <typename Transfer>
ssize_t transferred(
  const char* call, int file, std::size_t size, void* read, const Transfer& transfer)
{
  const bool cannotFlip = plan.kind == Fault::Kind::FlippedBit && (!read || isSpared(file));
  if (size == 0 || cannotFlip || !strikes(call))
  {
    return transfer(size);
  }
  switch (plan.kind)
  {
    case Fault::Kind::Short:
      return transfer(std::max<std::size_t>(size / 2, 1));
    case Fault::Kind::Zero:
      return 0;
    case Fault::Kind::FlippedBit:
    {
      const ssize_t done = transfer(size);
      if (done > 0)
      {
        // Anywhere, but in each run at the same place.
        const std::int64_t place = counted * 40503 % done;
        static_cast<unsigned char*>(read)[place] ^= 1U << (place % 8);
      }
      return done;
    }
    default:
      errno = plan.error;
      return -1;
  }
}

SystemCalls faulty()
{
  SystemCalls calls = real;
  calls.open = [](const char* path, int flags, mode_t mode)
  { return fails("open") ? -1 : real.open(path, flags, mode); };
  calls.pread = [](int file, void* bytes, std::size_t size, off_t offset)
  {
    return transferred("pread", file, size, bytes,
      [&](std::size_t part) { return real.pread(file, bytes, part, offset); });
  };
  // All reads are counted as pread, whether their bytes are cached or not.
  calls.preadv2 = [](int, const iovec*, int, off_t, int)
  {
    errno = EOPNOTSUPP;
    return ssize_t(-1);
  };
  calls.pwrite = [](int file, const void* bytes, std::size_t size, off_t offset)
  {
    return transferred("pwrite", file, size, nullptr,
      [&](std::size_t part) { return real.pwrite(file, bytes, part, offset); });
  };
  calls.close = [](int file)
  {
    const int done = real.close(file); // also a close that fails closes the file
    return fails("close") ? -1 : done;
  };
  calls.fstat = [](int file, struct stat* status)
  { return fails("fstat") ? -1 : real.fstat(file, status); };
  calls.fsync = [](int file) { return fails("fsync") ? -1 : real.fsync(file); };
  calls.fallocate = [](int file, int mode, off_t offset, off_t size)
  { return fails("fallocate") ? -1 : real.fallocate(file, mode, offset, size); };
  calls.ftruncate = [](int file, off_t size)
  { return fails("ftruncate") ? -1 : real.ftruncate(file, size); };
  calls.rename = [](const char* from, const char* to)
  { return fails("rename") ? -1 : real.rename(from, to); };
  calls.linkat = [](int fromFolder, const char* from, int toFolder, const char* to, int flags)
  { return fails("linkat") ? -1 : real.linkat(fromFolder, from, toFolder, to, flags); };
  calls.unlink = [](const char* path) { return fails("unlink") ? -1 : real.unlink(path); };
  calls.unlinkat = [](int folder, const char* name, int flags)
  { return fails("unlinkat") ? -1 : real.unlinkat(folder, name, flags); };
  calls.opendir = [](const char* path) { return fails("opendir") ? nullptr : real.opendir(path); };
  calls.mkdtemp = [](char* pattern) { return fails("mkdtemp") ? nullptr : real.mkdtemp(pattern); };
  calls.mkdir = [](const char* path, mode_t mode)
  { return fails("mkdir") ? -1 : real.mkdir(path, mode); };
  calls.memfd_create = [](const char* name, unsigned flags)
  { return fails("memfd_create") ? -1 : real.memfd_create(name, flags); };
  calls.mmap = [](void* address, std::size_t size, int protection, int flags, int file,
                 off_t offset) {
    return fails("mmap") ? MAP_FAILED : real.mmap(address, size, protection, flags, file, offset);
  };
  return calls;
}

} // namespace

Fault Fault::parse(const std::string& text)
{
  Fault fault;
  std::string often, what;
  std::istringstream in(text);
  if (!(in >> fault.call >> fault.nth >> often >> what) || (often != "once" && often != "forever"))
  {
    throw std::invalid_argument("not a fault: " + text);
  }
  fault.forever = often == "forever";
  fault.kind = what == "short"  ? Kind::Short
               : what == "zero" ? Kind::Zero
               : what == "flip" ? Kind::FlippedBit
               : what == "kill" ? Kind::Kill
                                : Kind::Error;
  fault.error = fault.kind == Kind::Error ? std::stoi(what) : 0;
  return fault;
}

void spare(const std::string& paths)
{
  std::istringstream in(paths);
  for (std::string path; std::getline(in, path, ':');)
  {
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0)
    {
      spared.emplace_back(status.st_dev, status.st_ino);
    }
  }
}

void install(const Fault& fault)
{
  plan = fault;
  counted = 0;
  systemCalls() = faulty();
}

std::int64_t countedCalls()
{
  return counted;
}

} // namespace smg::testing
