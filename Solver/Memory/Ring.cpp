// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Ring.h"

#include "Solver/Core/SystemCalls.h"
#include "smg/Error.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

// Memory for windows over unbounded arrays: one file in memory (memfd), mapped three times side by
// side.
//
// An item near the end of the ring has its neighbours in the next image, at the address where they
// would be in an array without an end. So kernels access neighbours by address arithmetic, without
// a test for the wrap in their inner loops. The price is address space, three times the size of the
// window, and pages that are counted as resident in each image that touches them.

namespace smg
{
namespace
{

[[noreturn]] void fail(const char* what)
{
  throw Error(std::string("no memory for a window: ") + what + ": " + std::strerror(errno) +
              "; lower the memory limit or raise that of the system (ulimit -v)");
}

/** Maps three images of a file side by side; returns the middle one. Throws Error. */
std::byte* mapImages(int file, std::size_t bytes)
{
  // First one reservation of address space for all three images, which ensures that they are
  // adjacent; the images then replace it part by part (MAP_FIXED).
  void* all = systemCalls().mmap(
    nullptr, 3 * bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED)
  {
    fail("reserving address space");
  }
  auto* first = static_cast<std::byte*>(all);
  for (std::byte* image : { first, first + bytes, first + 2 * bytes })
  {
    if (systemCalls().mmap(image, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, 0) ==
        MAP_FAILED)
    {
      const int reason = errno;
      ::munmap(all, 3 * bytes);
      errno = reason;
      fail("mapping");
    }
  }
  // Accesses start in the middle image and may go beyond either end.
  return first + bytes;
}

} // namespace

MirroredMemory::MirroredMemory(MirroredMemory&& other) noexcept
  : Owner(other.Owner)
  , Data(std::exchange(other.Data, nullptr))
  , Size(std::exchange(other.Size, 0))
  , Descriptor(std::exchange(other.Descriptor, -1))
{
}

MirroredMemory& MirroredMemory::operator=(MirroredMemory&& other) noexcept
{
  std::swap(this->Owner, other.Owner);
  std::swap(this->Data, other.Data);
  std::swap(this->Size, other.Size);
  std::swap(this->Descriptor, other.Descriptor);
  return *this;
}

void MirroredMemory::grow(std::size_t bytes)
{
  // Windows only grow: clear() releases the memory.
  if (bytes <= this->Size)
  {
    return;
  }
  // Accounted once: the three images are the same memory.
  this->Owner->acquire(static_cast<std::int64_t>(bytes - this->Size));
  const std::size_t before = this->Size;
  try
  {
    if (this->Descriptor < 0)
    {
      this->Descriptor = systemCalls().memfd_create("smg-window", MFD_CLOEXEC);
    }
    // The file grows at its end and keeps its content, so the items keep their offsets.
    if (this->Descriptor < 0 ||
        systemCalls().ftruncate(this->Descriptor, static_cast<off_t>(bytes)) != 0)
    {
      fail("memfd");
    }
    // The images lie side by side, so they cannot grow in place: all are mapped again, usually
    // elsewhere. Not before the old ones are gone: a limit of the address space counts both.
    this->unmap();
    try
    {
      this->Data = mapImages(this->Descriptor, bytes);
      this->Size = bytes;
    }
    catch (const Error&)
    {
      // Whoever catches the error goes on with the content that there was. Another thread may have
      // taken its old place by now.
      if (before > 0)
      {
        this->Data = mapImages(this->Descriptor, before);
      }
      throw;
    }
  }
  catch (...)
  {
    this->Owner->release(static_cast<std::int64_t>(bytes - before));
    throw;
  }
}

void MirroredMemory::unmap()
{
  if (this->Data)
  {
    ::munmap(this->Data - this->Size, 3 * this->Size);
    this->Data = nullptr;
  }
}

void MirroredMemory::clear()
{
  this->unmap();
  if (this->Descriptor >= 0)
  {
    systemCalls().close(this->Descriptor);
    this->Descriptor = -1;
  }
  this->Owner->release(static_cast<std::int64_t>(this->Size));
  this->Size = 0;
}

} // namespace smg
