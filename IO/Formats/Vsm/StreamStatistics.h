// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/PagedArray.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Tracks which vertices of a compact mesh stream are alive at each cell: from the cell that
 * introduces a vertex to the last one that uses it. The last uses may be given in any order. */
class StreamStatistics
{
public:
  explicit StreamStatistics(const std::filesystem::path& scratch);

  /** Declares that `cell` is the first to use a vertex. */
  void introduce(std::int64_t cell) { this->Changes.at(cell) += 1; }
  /** Declares that `cell` is the last to use a vertex. */
  void finalize(std::int64_t cell) { this->Changes.at(cell) += FinalUnit; }

  struct Result
  {
    std::int64_t width = 0; ///< most vertices alive at a cell
    double mean = 0;        ///< vertices alive at a cell, on average
  };
  /** Counts over the cells 0 to cells - 1. */
  Result count(std::int64_t cells);

private:
  /** A cell has at most four corners: half a byte each for the vertices that begin and end. */
  static constexpr std::uint8_t FinalUnit = 16;
  PagedArray<std::uint8_t> Changes;
};

} // namespace smg
