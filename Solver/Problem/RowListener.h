// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/** Is told, vertex by vertex, what the rows of the finest level do not keep of the mesh. */
class RowListener
{
public:
  virtual ~RowListener() = default;

  /** The next vertex, which is free, has an edge to constrained vertex index + delta. */
  virtual void link(std::int32_t delta, float weight) = 0;
  /**
   * The next edge of the next vertex's row has this target d_ij, one value a column. Only told when
   * the problem has edge targets; `target` holds for the call.
   */
  virtual void target(const double* /*target*/) {}
  /**
   * What the source and the constrained neighbours bring to the next vertex's b, one value a
   * column; b itself if the vertex is no unknown. `sum` holds for the call.
   */
  virtual void constraint(const double* /*sum*/) {}
  /**
   * The next vertex is complete. `point`: its position; `reach`: the largest neighbour of this and
   * all earlier vertices.
   */
  virtual void close(const double* point, std::int64_t reach) = 0;
};

} // namespace smg
