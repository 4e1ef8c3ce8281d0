// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Tracks which vertices of a compact mesh stream are alive at each cell: from the cell that
 * introduces a vertex to the last one that uses it. The last uses may be given in any order. A cell
 * is counted, and forgotten, as soon as they are known of all vertices up to it. */
class StreamStatistics
{
public:
  /** Where vertices remain open for long, cells wait in a scratch file in `scratch`. */
  explicit StreamStatistics(const std::filesystem::path& scratch);

  /** Declares that `cell` is the first to use the next vertex. */
  void introduce(std::int64_t cell) { this->Changes.at(cell) += 1; }
  /** Declares that `cell` is the last to use a vertex. */
  void finalize(std::int64_t cell) { this->Changes.at(cell) += FinalUnit; }
  /** Counts what is known after the cells below `cells` and the last uses of the vertices below
   * `vertices`. */
  void count(std::int64_t cells, std::int64_t vertices);

  struct Result
  {
    std::int64_t width = 0; ///< most vertices alive at a cell
    double mean = 0;        ///< vertices alive at a cell, on average
  };
  /** Over the cells that were counted. */
  Result result() const;

private:
  /** A cell has at most four corners: half a byte each for the vertices that begin and end. */
  static constexpr std::uint8_t FinalUnit = 16;
  PagedArray<std::uint8_t> Changes;
  std::int64_t Cells = 0;    ///< counted
  std::int64_t Vertices = 0; ///< introduced by these
  std::int64_t Alive = 0;    ///< of these, after the last cell
  std::int64_t Width = 0;
  double Sum = 0;
};

} // namespace smg
