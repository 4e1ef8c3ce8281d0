// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Ring.h"

#include "Solver/Core/Forks.h"
#include "Solver/Core/SystemCalls.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>
#include <vector>

// Memory for windows over unbounded arrays: one file in memory (memfd), mapped three times side by
// side.
//
// An item near the end of the ring has its neighbours in the next image, at the address where they
// would be in an array without an end. So kernels access neighbours by address arithmetic, without
// a test for the wrap in their inner loops. The price is address space, three times the size of the
// window, and pages that are counted as resident in each image that touches them.
//
// A solve makes hundreds of rings, and for one of a few pages the system takes longer than the
// solve for what is in it: small mappings are kept for the next ring of their size. They have no
// descriptor, and grow into another mapping; large ones grow as files.

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

/** Three images of a new file; `file` receives its descriptor. Throws Error. */
std::byte* mapNew(std::size_t bytes, int& file)
{
  file = systemCalls().memfd_create("smg-window", MFD_CLOEXEC);
  if (file < 0)
  {
    fail("memfd");
  }
  try
  {
    if (systemCalls().ftruncate(file, static_cast<off_t>(bytes)) != 0)
    {
      fail("memfd");
    }
    return mapImages(file, bytes);
  }
  catch (const Error&)
  {
    systemCalls().close(std::exchange(file, -1));
    throw;
  }
}

/** Small mappings that no ring uses. A forked child shares the pages of its parent's: it takes none
 * of them and keeps none. */
class SpareMappings
{
public:
  static constexpr std::size_t Pages = 16; ///< of the largest that are kept
  static constexpr bool keeps(std::size_t bytes) { return bytes <= Pages * Page; }

  static SpareMappings& all()
  {
    static SpareMappings& spare = *new SpareMappings;
    return spare;
  }

  /** Of zeros. Throws Error. */
  std::byte* take(std::size_t bytes)
  {
    std::byte* data = this->spare(bytes);
    if (data)
    {
      std::memset(data, 0, bytes);
      return data;
    }
    int file = -1;
    data = mapNew(bytes, file);
    systemCalls().close(file);
    return data;
  }

  /** `process` is that of number() when it was taken. */
  void give(std::byte* data, std::size_t bytes, int process)
  {
    const std::lock_guard lock(this->Mutex);
    if (process == this->Number && this->Kept + bytes <= Most)
    {
      this->Spare[bytes / Page - 1].push_back(data);
      this->Kept += bytes;
      return;
    }
    ::munmap(data - bytes, 3 * bytes);
  }

  /** How many forks led to this process. */
  int number() const { return this->Number; }

private:
  static constexpr std::size_t Page = MirroredMemory::PageBytes;
  static constexpr std::size_t Most = std::size_t(1) << 20; ///< bytes, of all that are kept

  SpareMappings()
  {
    // As many as there may be: to give one back, which destructors do, allocates nothing.
    for (std::size_t i = 0; i < Pages; ++i)
    {
      this->Spare[i].reserve(Most / ((i + 1) * Page));
    }
    ForkedObjects::all().add(
      this, { [this] { this->Mutex.lock(); }, [this] { this->Mutex.unlock(); },
              [this]
              {
                std::ranges::for_each(this->Spare, [](auto& each) { each.clear(); });
                this->Kept = 0;
                ++this->Number;
                this->Mutex.unlock();
              } });
  }

  std::byte* spare(std::size_t bytes)
  {
    const std::lock_guard lock(this->Mutex);
    std::vector<std::byte*>& fitting = this->Spare[bytes / Page - 1];
    if (fitting.empty())
    {
      return nullptr;
    }
    std::byte* data = fitting.back();
    fitting.pop_back();
    this->Kept -= bytes;
    return data;
  }

  std::mutex Mutex;
  std::array<std::vector<std::byte*>, Pages> Spare; // by pages - 1
  std::size_t Kept = 0;
  int Number = 0;
};

} // namespace

MirroredMemory::MirroredMemory(MirroredMemory&& other) noexcept
  : Owner(other.Owner)
  , Data(std::exchange(other.Data, nullptr))
  , Size(std::exchange(other.Size, 0))
  , Descriptor(std::exchange(other.Descriptor, -1))
  , Process(other.Process)
{
}

MirroredMemory& MirroredMemory::operator=(MirroredMemory&& other) noexcept
{
  std::swap(this->Owner, other.Owner);
  std::swap(this->Data, other.Data);
  std::swap(this->Size, other.Size);
  std::swap(this->Descriptor, other.Descriptor);
  std::swap(this->Process, other.Process);
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
    this->Descriptor < 0 ? this->moveInto(bytes) : this->growFile(bytes);
  }
  catch (...)
  {
    this->Owner->release(static_cast<std::int64_t>(bytes - before));
    throw;
  }
}

void MirroredMemory::moveInto(std::size_t bytes)
{
  int file = -1;
  std::byte* data =
    SpareMappings::keeps(bytes) ? SpareMappings::all().take(bytes) : mapNew(bytes, file);
  std::copy_n(this->Data, this->Size, data);
  this->unmap();
  this->Data = data;
  this->Size = bytes;
  this->Descriptor = file;
  this->Process = SpareMappings::all().number();
}

void MirroredMemory::growFile(std::size_t bytes)
{
  // The file grows at its end and keeps its content, so the items keep their offsets.
  if (systemCalls().ftruncate(this->Descriptor, static_cast<off_t>(bytes)) != 0)
  {
    fail("memfd");
  }
  // The images lie side by side, so they cannot grow in place: all are mapped again, usually
  // elsewhere. Not before the old ones are gone: a limit of the address space counts both.
  const std::size_t before = this->Size;
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
    this->Data = mapImages(this->Descriptor, before);
    throw;
  }
}

void MirroredMemory::unmap()
{
  if (this->Data && SpareMappings::keeps(this->Size))
  {
    SpareMappings::all().give(this->Data, this->Size, this->Process);
  }
  else if (this->Data)
  {
    ::munmap(this->Data - this->Size, 3 * this->Size);
  }
  this->Data = nullptr;
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
