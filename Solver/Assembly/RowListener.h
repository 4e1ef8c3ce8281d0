// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * Receives, vertex by vertex, the data of the mesh that the rows of the finest level do not store.
 */
class RowListener
{
public:
  virtual ~RowListener() = default;

  /** Rows follow of vertices for which the problem has been asked before, perhaps while it is asked
   * for others on another thread; that is not so during this call. */
  virtual void begin() {}
  /** The next vertex, which is free, has an edge to the constrained vertex index + delta. */
  virtual void link(std::int32_t delta, float weight) = 0;
  /** The next edge of the row of the next vertex has this target d_ij, one value per column. Called
   * only if the problem has edge targets; `target` is valid during the call. */
  virtual void target(const double* /*target*/) {}
  /** The contribution of the source and the constrained neighbours to b of the next vertex, one
   * value per column; b itself if the vertex is not an unknown. `sum` is valid during the call. */
  virtual void constraint(const double* /*sum*/) {}
  /** The next vertex is complete. `point` is its position, `reach` the largest neighbour of this
   * and all earlier vertices. */
  virtual void close(const double* point, std::int64_t reach) = 0;
};

} // namespace smg
