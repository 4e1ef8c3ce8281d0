// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/MemoryBudget.h"

#include "Solver/Core/Error.h"

#include <string>

#include <unistd.h>

namespace smg
{

namespace
{

/** Code, allocator, writer and compressor, whatever the mesh. */
constexpr std::int64_t FixedBytes = std::int64_t(32) << 20;

std::string mebibytes(std::int64_t bytes)
{
  return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

} // namespace

MemoryBudget::MemoryBudget(std::int64_t limit)
  : Limit(limit)
{
  if (limit < 0)
  {
    throw Error("The memory limit must not be negative, but it is " + std::to_string(limit) + '.');
  }
  if (limit == 0)
  {
    this->Limit =
      static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) / 2 * ::sysconf(_SC_PAGESIZE);
  }
}

std::int64_t MemoryBudget::bytesFor(const MeshSizes& sizes)
{
  // A vertex: coordinates 24, rank, new number, last cell and two arrays of the search 4 each,
  // offset of its cells 8. A cell: corners 8 each and once more 4 each in the table of the cells
  // around a vertex, which is gone when the attributes are written; place in the order 4, flags 1.
  const std::int64_t vertex = 24 + 20 + 8 + sizes.vertexColumnBytes;
  const std::int64_t cell = 12 * std::int64_t(sizes.corners) + 5 + sizes.cellColumnBytes;
  return FixedBytes + vertex * sizes.vertices + cell * sizes.cells;
}

void MemoryBudget::check(const std::filesystem::path& path, const MeshSizes& sizes) const
{
  const std::int64_t need = MemoryBudget::bytesFor(sizes);
  if (need > this->Limit)
  {
    throw Error(
      path.string() + ": converting " + std::to_string(sizes.vertices) + " vertices and " +
      std::to_string(sizes.cells) + " cells needs about " + mebibytes(need) + " of memory, but " +
      mebibytes(this->Limit) +
      " are allowed: raise the memory limit, or convert a file that is already a mesh stream with "
      "the order 'keep', which needs little.");
  }
}

} // namespace smg
