// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <utility>

namespace smg
{

/** A facet of a cell, with its corners in ascending order. */
struct CellFacet
{
  std::int64_t vertex[3] = {}; ///< stream indices; the third one is 0 for an edge
  int order[3] = { 0, 1, 2 };  ///< the place of each among the corners in the order of the cell
};

/** The facet opposite to corner k of a cell with these corners. */
inline CellFacet facetOf(CellType type, const std::int64_t* corners, int k)
{
  CellFacet facet;
  for (int e = 0, other = 0; e < cornersOf(type); ++e)
  {
    if (e != k)
    {
      facet.vertex[other++] = corners[e];
    }
  }
  const auto sort = [&facet](int a, int b)
  {
    if (facet.vertex[a] > facet.vertex[b])
    {
      std::swap(facet.vertex[a], facet.vertex[b]);
      std::swap(facet.order[a], facet.order[b]);
    }
  };
  sort(0, 1);
  if (type == CellType::Tetrahedron)
  {
    sort(1, 2);
    sort(0, 1);
  }
  return facet;
}

} // namespace smg
