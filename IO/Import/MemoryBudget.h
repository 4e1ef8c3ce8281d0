// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace smg
{

/** What a mesh needs in memory while it is brought into order, counted before it is read. */
struct MeshSizes
{
  std::int64_t vertices = 0;
  std::int64_t cells = 0;
  int corners = 3;                    ///< of a cell
  std::int64_t vertexColumnBytes = 0; ///< attributes of a vertex
  std::int64_t cellColumnBytes = 0;   ///< attributes of a cell
};

/** The promise that a conversion stays below a number of bytes. */
class MemoryBudget
{
public:
  MemoryBudget()
    : MemoryBudget(0)
  {
  }
  /** `limit` bytes; 0: half of the machine's memory. */
  explicit MemoryBudget(std::int64_t limit);

  std::int64_t limit() const { return this->Limit; }

  /** Bytes that converting a mesh of these sizes takes: the mesh, the order and the writer. */
  static std::int64_t bytesFor(const MeshSizes& sizes);

  /** Throws Error with both figures when the conversion of `path` would exceed the limit. */
  void check(const std::filesystem::path& path, const MeshSizes& sizes) const;

private:
  std::int64_t Limit;
};

} // namespace smg
