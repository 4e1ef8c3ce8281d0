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
 * What users quote of a solution: gradients and fluxes of the cells, and, for the report, what
 * flows through the boundary, the energy, the means and the extremes. The mesh stream is read once
 * more, in the sweep in which a caller writes the solution:
 *
 *     ProblemResults results(source.info(), problem, solution);
 *     while (source.next(block)) { results.add(block); ... }
 *     results.finish(report);
 *
 * The window of open vertices alone is in memory. The numbers do not depend on the blocks, to the
 * last bit.
 */
class SMG_EXPORT ProblemResults
{
public:
  /**
   * `problem`: that of the solution, asked once more from the first block on (also for
   * CellBatch::conductivity if the flux is wanted). Throws Error if the solution is of another
   * problem, or if there are edge targets, which have no flux.
   */
  ProblemResults(const StreamInfo& info, Problem& problem, Solution& solution,
    const ResultOptions& options = {});

  /** Takes the next block. Throws Error on a bad block, and what reading the solution throws. */
  void add(const MeshBlock& block);

  // Of the block that was added last.

  /** The solution at its vertices: `columns` a vertex. */
  std::span<const double> values() const { return this->Values; }
  /** If wanted: 3 numbers for each column of each cell; 0 in cells without area or volume. In the
   * plane of the triangle on surfaces. */
  std::span<const double> gradient() const { return this->Cells.gradient(); }
  std::span<const double> flux() const { return this->Cells.flux(); }

  /**
   * After the last block: fills conditions, energy, mean, minimum, maximum, source, screening and
   * balance of the report, which is the solution's. Adds a note on how much a solution of cells
   * that are too flat may differ from that of finite elements.
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
  OpenVertices Vertices; // their values are the solution's
  NeighbourReach Reach;
  std::optional<ProblemCells> Own;
  std::optional<VertexLoads> CellLoads, FacetLoads;
  Ring<double> EdgeWeights; // magnitudes of the weights of the edges, if there are facets' loads
  ProblemFacets Facets;
  WeightedEdges Edges; // of Dirichlet vertices to those that are not of the same condition

  CellResults Cells;
  ConditionSums Conditions;
  std::vector<double> Values, Load, Reaction;
  std::vector<RowNeighbour> Neighbours;
  std::int64_t Final = 0;
  double Mass = 0.0;
  std::vector<double> Mean, Source, Screening, ScreeningEnergy, Magnitude; // sums
  std::vector<double> ReactionTerms; // magnitudes of what the reactions are summed of
  // Those of Robin conditions that the solve's residual may have left, see commonShare().
  std::vector<double> RobinTerms;
  std::vector<Report::Extreme> Minimum, Maximum;
};

} // namespace smg
