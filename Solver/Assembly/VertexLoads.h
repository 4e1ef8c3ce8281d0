// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/BoundaryFacet.h"
#include "Solver/Assembly/ProblemCells.h"
#include "Solver/Memory/Ring.h"

#include <cstdint>

namespace smg
{

/** The contributions of cells or boundary facets to the diagonal and to the right-hand side of the
 * rows of open vertices, lumped at their corners. */
class VertexLoads
{
public:
  VertexLoads(Pool& pool, CellType type, int columns);

  void extend(std::int64_t vertices);
  /** Provides room for so many more vertices. */
  void reserve(std::int64_t vertices);
  void release(std::int64_t first);

  /** Adds screening, source and field of the prepared cell, which must have a measure. */
  void add(const std::int64_t* corners, const double* const* points, const ProblemCells& cells);
  /** Adds flux and heat transfer of a facet with this length or area. */
  void add(const BoundaryFacet& facet, double area);

  double alpha(std::int64_t i) const { return this->Alpha[i]; }
  /** `columns` numbers. */
  const double* load(std::int64_t i) const { return this->Load.at(i); }

private:
  CellType Type;
  int Columns;
  Ring<double> Alpha, Load;
};

} // namespace smg
