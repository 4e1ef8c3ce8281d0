// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

#include <cstdint>
#include <span>

namespace smg
{

/** What to compute of a solution, beside the solution itself. */
struct ResultOptions
{
  bool gradient = false; ///< grad u of each cell
  bool flux = false;     ///< -K grad u of each cell
  /** Promise on the accounted memory, bytes. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
};

/** The solution of a solve: `columns` values a vertex, in stream order, on disk or in memory. */
class SMG_EXPORT Solution
{
public:
  virtual ~Solution() = default;
  virtual std::int64_t vertices() const = 0;
  virtual int columns() const = 0;
  /**
   * Writes the values of vertices [first, first + count) to `values` (columns * count doubles).
   * Any range in any order; in-order ranges cost the range alone. Not to be called by two threads
   * at once. Throws Error.
   */
  virtual void read(std::int64_t first, std::int64_t count, std::span<double> values) = 0;
  /** What the solve did. */
  virtual const Report& report() const = 0;
};

} // namespace smg
