// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/NeighbourReach.h"
#include "Solver/Problem/OpenVertices.h"
#include "Solver/Problem/ProblemCells.h"
#include "Solver/Problem/ProblemFacets.h"
#include "Solver/Problem/VertexLoads.h"
#include "Solver/Problem/WeightedEdges.h"
#include "Solver/Results/CellResults.h"
#include "Solver/Results/ConditionSums.h"
#include "Solver/Stream/StreamCheck.h"
#include "smg/Export.h"
#include "smg/Solve.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * The derived results of a solution: gradients and fluxes of the cells, and, for the report, the
 * flow through the boundary, the energy, the means and the extremes. The mesh stream is read once
 * more, in the pass in which the caller writes the solution:
 *
 *     ProblemResults results(source.info(), problem, solution);
 *     while (source.next(block)) { results.add(block); ... }
 *     results.finish(report);
 *
 * Only the window of open vertices is in memory. The results do not depend on the blocks, bit for
 * bit.
 */
class SMG_EXPORT ProblemResults
{
public:
  /**
   * `problem` is that of the solution; it is queried again from the first block on (also for
   * CellBatch::conductivity if the flux is requested). Throws Error if the solution belongs to
   * another problem, or if there are edge targets, which have no flux.
   */
  ProblemResults(const StreamInfo& info, Problem& problem, Solution& solution,
    const ResultOptions& options = {});

  /** Adds the next block. Throws Error for an invalid block, and the errors of reading the
   * solution. */
  void add(const MeshBlock& block);

  // Of the last block:

  /** The solution at its vertices: `columns` per vertex. */
  std::span<const double> values() const { return this->Values; }
  /** If requested: 3 numbers per column of each cell; 0 in cells without area or volume. On
   * surfaces in the plane of the triangle. */
  std::span<const double> gradient() const { return this->Cells.gradient(); }
  std::span<const double> flux() const { return this->Cells.flux(); }

  /**
   * After the last block: sets conditions, energy, mean, minimum, maximum, source, screening and
   * balance of the report of the solution. Adds a note on the maximum difference from finite
   * elements due to cells that are too flat.
   */
  void finish(Report& report);

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  void addCell(std::size_t c, const std::int64_t* corners, unsigned flags);
  void connect(const std::int64_t* corners, const double* const* points, const CellWeights& cell);
  void weighEdges(const std::int64_t* corners, const CellWeights& cell);
  void finalize(std::int64_t end);
  void addBoundary(std::int64_t i);
  void closeVertex(std::int64_t i);
  void closeDirichlet(std::int64_t i, double alpha);
  void reportBalance(Report& report) const;
  static void noteConditionsWithoutEffect(Report& report);
  void noteFlatCells(Report& report) const;

  CellType Type;
  Problem& Given;
  Solution& Solved;
  std::size_t Columns;
  Weights Kind;
  StreamCheck Check;
  Pool Memory;

  // By open vertex.
  OpenVertices Vertices; // their values are the solution
  NeighbourReach Reach;
  std::optional<ProblemCells> Own;
  std::optional<VertexLoads> CellLoads, FacetLoads;
  Ring<double> EdgeWeights; // magnitudes of the edge weights, if there are facet loads
  ProblemFacets Facets;
  WeightedEdges Edges; // from Dirichlet vertices to vertices outside the condition

  CellResults Cells;
  ConditionSums Conditions;
  std::vector<double> Values, Load, Reaction;
  std::vector<RowNeighbour> Neighbours;
  std::int64_t Final = 0;
  double Mass = 0.0;
  std::vector<double> Mean, Source, Screening, ScreeningEnergy, Magnitude; // sums
  std::vector<double> ReactionTerms; // magnitudes of the terms of the reactions
  // Terms of Robin conditions that the residual of the solve may contain, see commonShare().
  std::vector<double> RobinTerms;
  std::vector<Report::Extreme> Minimum, Maximum;
};

} // namespace smg
