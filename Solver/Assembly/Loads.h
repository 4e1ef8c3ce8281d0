// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/ProblemFacets.h"
#include "Solver/Assembly/WeightedCells.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{

/** The contributions of cells or boundary facets to the diagonal and to the right-hand side of the
 * rows of open vertices, lumped at their corners. */
class VertexLoads
{
public:
  VertexLoads(Pool& pool, CellType type, int columns);

  void extend(std::int64_t vertices);
  /** Provides room for this many more vertices. */
  void reserve(std::int64_t vertices);
  void release(std::int64_t first);

  /** Adds screening, source and field of a cell, which must have a measure, and what jumps at its
   * corners make flow. */
  void add(const WeightedCell& cell);
  /** What equations are for. */
  enum class Of
  {
    Problem,
    Correction ///< of the solution that the vertices have
  };
  /** Adds flux and heat transfer of a facet with this length or area; of a correction what the
   * solution leaves of the heat transfer. */
  void add(const BoundaryFacet& facet, double area, const OpenVertices& vertices, Of of);

  double rowSum(std::int64_t i) const { return this->RowSum[i]; }
  /** `columns` numbers. */
  const double* load(std::int64_t i) const { return this->Load.at(i); }

private:
  void addJumps(const WeightedCell& cell);

  CellType Type;
  int Columns;
  Ring<double> RowSum, Load;
};

/** The contributions of sources, screening and boundary conditions, at vertices, in cells or on
 * facets, to the diagonals and right-hand sides of the rows of open vertices. */
class SMG_EXPORT RowLoads
{
public:
  RowLoads(Pool& pool, CellType type, Problem& problem, const OpenVertices& vertices);

  /** Sets the number of vertices so far. */
  void extend(std::int64_t vertices);
  /** Provides room for this many more vertices: while these are added, another thread may use the
   * loads of cells at earlier ones. */
  void reserve(std::int64_t vertices);
  /** Adds the facets of the cells of the block. */
  void addFacets(const MeshBlock& block);
  /** Adds the data of a cell, which must have some, or jumps at its corners, and a measure. */
  void addCell(const WeightedCell& cell) { this->OfCells->add(cell); }
  void release(std::int64_t first);

  /** The facets so far; null if the problem has no data on facets. */
  const OpenFacets* facets() const { return this->Facets ? &this->Facets->open() : nullptr; }
  /** See ProblemFacets; the problem must have data on facets. */
  void exclude(FacetSet facets) { this->Facets->exclude(std::move(facets)); }

  /** Sums all contributions to vertex i, the lowest open one. Returns the one to the diagonal. */
  double close(std::int64_t i);
  /** The contribution to the right-hand side of the last closed vertex, `columns` numbers. */
  const double* load() const { return this->Load.data(); }

private:
  void addBoundary(std::int64_t i);

  const OpenVertices& Vertices;
  std::optional<ProblemFacets> Facets;
  // Separate sums: when a facet is known to be on the boundary depends on the blocks.
  std::optional<VertexLoads> OfCells, OfFacets;
  std::vector<double> Load;
};

} // namespace smg
