// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/CheckedFile.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Buffer.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** Where the values of vertices are kept. */
struct VertexStorage
{
  Pool& pool;                  ///< accounts for values in memory
  const ScratchFolder* folder; ///< of the files; null: in memory
  IoStatistics& traffic;       ///< of the files
};

/** A tuple of numbers for each vertex of a mesh stream, in an unnamed scratch file or in memory. */
class VertexFile
{
public:
  VertexFile(const VertexStorage& storage, int lanes);

  int lanes() const { return static_cast<int>(this->Lanes); }
  std::int64_t vertices() const { return this->Vertices; }

  /** Adds the tuples of the next vertices. */
  void append(std::span<const double> values);
  /** The next vertex to append is vertex 0; the space is reused. */
  void restart();
  /** Reads the tuples of the vertices [first, first + count), which must exist. */
  void read(std::int64_t first, std::int64_t count, double* values) const;

private:
  Pool* Memory;
  IoStatistics* Traffic;
  std::size_t Lanes;
  CheckedFile File; ///< closed: in memory
  Buffer Values;
  std::int64_t Vertices = 0;
};

} // namespace smg
