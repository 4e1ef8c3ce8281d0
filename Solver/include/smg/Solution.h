// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Additional results of a solution. */
struct ResultOptions
{
  bool gradient = false; ///< grad u of each cell
  bool flux = false;     ///< -K grad u of each cell
  /** The limit of the accounted memory in bytes. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
};

/** The solution of a solve: `columns` values per vertex, in stream order, on disk or in memory. */
class SMG_EXPORT Solution
{
public:
  virtual ~Solution() = default;
  virtual std::int64_t vertices() const = 0;
  virtual int columns() const = 0;
  /**
   * Reads the values of vertices [first, first + count) to `values` (columns * count doubles).
   * Ranges may be read in any order; consecutive ranges are read most efficiently. Not thread-safe.
   * Throws Error.
   */
  virtual void read(std::int64_t first, std::int64_t count, std::span<double> values) = 0;
  /** The report of the solve. */
  virtual const Report& report() const = 0;
};

} // namespace smg
