// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

#include <cstdint>
#include <span>

namespace smg
{

/** What to compute from a solution. */
struct ResultOptions
{
  bool gradient = false; ///< grad u of each cell
  bool flux = false;     ///< -K grad u of each cell
  /** Limit of the accounted memory, bytes; 1 GiB by default. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
};

/** The solution of a problem: columns() values a vertex, in stream order, on disk or in memory. */
class SMG_EXPORT Solution
{
public:
  virtual ~Solution() = default;
  /** Number of vertices of the mesh. */
  virtual std::int64_t vertices() const = 0;
  /** Number of values of a vertex: the columns of the problem, or 3 of a deformation. */
  virtual int columns() const = 0;
  /**
   * Reads the values of the vertices [first, first + count). Any range may be read in any order;
   * consecutive ranges cost no more than their own values. Not for two threads at once.
   * @param first stream index of the first vertex
   * @param count number of vertices
   * @param values set to the values, vertex by vertex: room for columns() * count numbers
   * @throws Error if the range or the room is not valid, or a scratch file cannot be read
   */
  virtual void read(std::int64_t first, std::int64_t count, std::span<double> values) = 0;
  /** What the solve did; SolvedMesh::finish() completes a copy of it. */
  virtual const Report& report() const = 0;
};

} // namespace smg
