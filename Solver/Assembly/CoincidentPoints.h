// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "smg/Export.h"

#include <cstdint>
#include <vector>

namespace smg
{

/**
 * Finds vertices of different components that lie at the same place: bodies that look connected
 * there and are not. Of a large mesh only a sample of the places is remembered, chosen by a hash of
 * the coordinates, so that coincident vertices are chosen together. So the memory is bounded, the
 * count of a large mesh is an estimate, and it depends on neither blocks nor threads.
 */
class SMG_EXPORT CoincidentPoints
{
public:
  struct Count
  {
    std::int64_t places = 0;
    bool isExact = true;
  };

  /** `most`: the number of vertices that are remembered. */
  explicit CoincidentPoints(std::size_t most = std::size_t(1) << 16)
    : Most(most)
  {
  }

  /** Adds a vertex with the label of its component. */
  void add(const double* point, std::int32_t label);
  /** The number of places with vertices of several components. */
  Count count(const Components& components) const;

private:
  struct Vertex
  {
    std::uint64_t place; ///< hash of the coordinates
    std::int32_t label;
  };

  void halve();

  std::size_t Most;
  int Shift = 0; ///< of 2^Shift places, one is remembered
  std::vector<Vertex> Sample;
};

} // namespace smg
