// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/OpenVertices.h"
#include "Solver/Problem/ProblemCells.h"
#include "Solver/Problem/ProblemFacets.h"
#include "Solver/Problem/VertexLoads.h"
#include "smg/Problem.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/**
 * What sources, screening and boundary conditions bring to the diagonals and right-hand sides of
 * the rows of open vertices, whether a problem states them at vertices, in cells or on facets.
 */
class RowLoads
{
public:
  RowLoads(Pool& pool, CellType type, Problem& problem, const OpenVertices& vertices);

  /** As many vertices have come. */
  void extend(std::int64_t vertices);
  /** Takes the facets of the block's cells. */
  void addFacets(const MeshBlock& block);
  /** Takes what is said of the cell that is prepared, which has a measure. */
  void addCell(const std::int64_t* corners, const double* const* points, const ProblemCells& cells)
  {
    this->OfCells->add(corners, points, cells);
  }
  void release(std::int64_t first);

  /** Sums up what vertex i, the lowest that is open, is brought; answers the diagonal's share. */
  double close(std::int64_t i);
  /** Of the last vertex that was closed: the right-hand side's share, `columns` numbers. */
  const double* load() const { return this->Load.data(); }

private:
  void addBoundary(std::int64_t i);

  CellType Type;
  const OpenVertices& Vertices;
  std::optional<ProblemFacets> Facets;
  // Apart: facets are known when their vertices are final, which depends on the blocks.
  std::optional<VertexLoads> OfCells, OfFacets;
  std::vector<double> Load;
};

} // namespace smg
