// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace smg::benchmark
{

/** Measures the order of a compact mesh stream, cell by cell. */
class StreamOrderMeasure
{
public:
  /** `corners` are stream indices; new ones are consecutive. */
  void append(std::span<const std::int64_t> corners);

  /** Largest index distance between two vertices of a cell. */
  std::int64_t span() const { return this->Span; }
  /** Most vertices alive at a cell. */
  std::int64_t width() const;
  /** Mean over the vertices i of the largest neighbour of the vertices up to i, less i. */
  double meanWindow() const;

private:
  std::int64_t cells() const { return static_cast<std::int64_t>(this->Introduced.size()); }

  std::int64_t Span = 0;
  std::vector<std::int64_t> LargestNeighbour; ///< of each vertex; itself if that is larger
  std::vector<std::int64_t> LastCell;         ///< of each vertex
  std::vector<std::uint8_t> Introduced; ///< by each cell: vertices that it is the first to use
};

} // namespace smg::benchmark
