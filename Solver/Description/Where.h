// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/Region.h"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace smg
{

/** Everywhere. */
struct Everywhere
{
};
/** Where a column of one number, of the vertices or the cells, has this value. */
struct ColumnTag
{
  std::string column;
  double value = 0;
};
/** Where a column of one number, of the vertices or the cells, is not 0. */
struct ColumnMask
{
  std::string column;
};
/** The nearest vertex to each of these points; of several, the first in the stream. */
struct NearestVertices
{
  std::vector<std::array<double, 3>> points;
};

/**
 * A part of a mesh on which a datum is defined.
 *
 * A region, a column of the vertices and points select vertices; cells and facets of the boundary
 * are selected if all their corners are. A column of the cells selects cells, their vertices and
 * their facets. If both vertices and cells have a column of the name, conductivity and field refer
 * to that of the cells, all other data to that of the vertices.
 */
using Where = std::variant<Everywhere, Region, ColumnTag, ColumnMask, NearestVertices>;

} // namespace smg
