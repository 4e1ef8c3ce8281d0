// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace smg
{

/** Facets of a mesh with the positions of their corners. */
class SMG_EXPORT FacetList
{
public:
  /** A facet by the stream indices of its corners, ascending; the third one of an edge is None. */
  using Facet = std::array<std::int64_t, 3>;
  static constexpr std::int64_t None = std::numeric_limits<std::int64_t>::max();

  /** `corners` is the number of corners of a facet. `memory` accounts for the list. */
  FacetList(Pool& memory, int corners)
    : Corners(static_cast<std::size_t>(corners))
    , Reserved(memory)
  {
  }

  /** Adds a facet with the positions of its corners, in the same order. */
  void add(const std::int64_t* corners, const double* const* points);
  /** To be called after the last facet: sorts them, and forgets repetitions. */
  void finish();
  /** Forgets all. */
  void clear()
  {
    this->Facets = {};
    this->Vertices = {};
    this->Known = 0;
    this->Reserved.resize(0);
  }

  const std::vector<Facet>& facets() const { return this->Facets; }
  std::size_t corners() const { return this->Corners; }
  /** The position of a vertex of the facets. */
  const Vector& point(std::int64_t vertex) const;
  Vector centre(const Facet& facet) const;
  double area(const Facet& facet) const;
  /** The lowest and highest coordinates of all corners. */
  std::pair<Vector, Vector> bounds() const;

private:
  struct Vertex
  {
    std::int64_t index;
    Vector point;
  };

  void forgetRepeated();

  std::size_t Corners;
  std::vector<Facet> Facets;
  std::vector<Vertex> Vertices; ///< of the facets; by ascending index after finish()
  std::size_t Known = 0;        ///< vertices of which none is repeated, at the front
  Reservation Reserved;
};

/** A facet and its copy at another place or of another body. */
struct FacetCopy
{
  std::size_t first, second; ///< in the lists of facets
  /** The corner of the second facet that is the copy of each corner of the first one. */
  std::array<std::int64_t, 3> corners;
};

/** What the search for copies has found. */
struct FacetCopies
{
  std::vector<FacetCopy> pairs;   ///< by ascending `first`
  std::vector<std::size_t> alone; ///< facets of the first list without a copy
};

/** The vector by which the bounds of the first list lie apart from those of the second one. */
SMG_EXPORT Vector shiftBetween(const FacetList& first, const FacetList& second);
/** How far corners may be from where they should be: more than the rounding of files in single
 * precision, less than any cell; 1e-6 of the larger diagonal of the bounds. */
SMG_EXPORT double usualTolerance(const FacetList& first, const FacetList& second);

/**
 * Finds for each facet of `first` its copy in `second`: the facet whose corners are those of the
 * first one moved by `shift`, each within `tolerance`, and which is not the facet itself. Of
 * several that are as near, the first one counts.
 *
 * Facets are compared by their centres, sorted by their projections on one direction that is
 * parallel to nothing in particular: O(n log n).
 */
SMG_EXPORT FacetCopies findCopies(
  const FacetList& first, const FacetList& second, const Vector& shift, double tolerance);

} // namespace smg
