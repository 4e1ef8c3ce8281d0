// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/FacetSet.h"

#include <cstdint>
#include <span>

namespace smg
{

class OpenFacets;

/**
 * A mesh in parts, each of them known to one process, which numbers its vertices for itself: what a
 * selection must know of the other parts. All processes call each function, in the same order.
 */
class MeshParts
{
public:
  virtual ~MeshParts() = default;

  /** Replaces each number by its sum over all parts. */
  virtual void sum(std::span<std::int64_t> counts) = 0;
  /** Marks the vertices of the part that any part marks with 1. */
  virtual void join(std::span<std::uint8_t> marks) = 0;
  /**
   * Given the vertex of the part that is nearest to each point, or -1, and their distances: finds
   * the nearest vertex of all parts, the first one in stream order of several. It replaces those
   * given, with -1 where the part does not have it.
   */
  virtual void nearest(std::span<double> distances, std::span<std::int64_t> vertices) = 0;
  /** The facets that have one cell in the part, but more in all parts. `facets` are those of the
   * cells of the part. */
  virtual FacetSet innerFacets(const OpenFacets& facets) = 0;
};

} // namespace smg
