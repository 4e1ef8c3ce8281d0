// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/Loads.h"
#include "Solver/Assembly/NeighbourReach.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/ProblemFacets.h"
#include "Solver/Assembly/WeightedCells.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Results/ResultSums.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
   * `problem` is the one that was solved; it is queried again from the first block on (also for
   * CellBatch::conductivity if the flux is requested). Throws Error if the solution belongs to
   * another problem, or if the problem has edge targets, which have no flux.
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

  /** Before the first block, with ResultOptions::gradient: the gradients at the vertices are
   * appended to the file, as far as they are known. They are the means of those of the cells,
   * weighted by area or volume. */
  void appendVertexGradients(VertexFile& file) { this->VertexGradients = &file; }

  /** After the last block: see ResultSums. */
  void finish(Report& report);

  // Of the part of a mesh that a process has (see MeshPart), instead of add() and finish():

  /** Adds the only block. All bodies are one, since those of several parts are not known. */
  void addPart(const MeshBlock& block);
  /** The facets and edges of the cells of the part. Before the terms are taken, facets that other
   * parts have as well are to be excluded, and edges joined with those of other parts. */
  const OpenFacets& facets() const { return this->Facets.open(); }
  void exclude(FacetSet facets) { this->Facets.exclude(std::move(facets)); }
  EdgeStiffness& edges() { return this->Edges; }
  /** What the part contributes to its vertices, VertexTerms::size() numbers each. */
  std::vector<double> takeTerms();
  /** The Dirichlet condition of a vertex of the part; -1: none. */
  std::int32_t dirichlet(std::int64_t i) const { return this->Vertices.dirichlet[i]; }
  /** The sums over its cells and facets, to which the vertices are added. */
  ResultSums& sums() { return this->Sums; }

private:
  void addBlock(const MeshBlock& block);
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  void addCell(const WeightedCell& cell);
  std::int32_t bodyOf(std::int64_t i) const
  {
    return this->IsPart ? 0 : std::max(0, this->Labels.label(i));
  }
  void addGradient(const WeightedCell& cell);
  void closeGradient(std::int64_t i);
  void relateToFirst(const std::int64_t* corners, const double** values);
  void connect(const WeightedCell& cell);
  void addFlows(const WeightedCell& cell, const double* const* values);
  void finalize(std::int64_t final);
  void addLinks(std::int64_t i);
  void addBoundary(std::int64_t i);
  void close(std::int64_t i, double* numbers);
  void addEdges(std::int64_t i, VertexTerms terms);

  CellType Type;
  std::size_t Columns;
  Weights Kind;
  StreamCheck Check;
  Pool Memory;

  // By open vertex.
  OpenVertices Vertices; // with the solution
  NeighbourReach Reach;
  std::optional<VertexLoads> CellLoads, FacetLoads;
  /** Along the edges of a vertex, per column, and the sum of the magnitudes of their weights, if
   * these are sums over cells. */
  Ring<double> Flows;
  WeightedCells Weighted;
  ProblemFacets Facets;
  Components Parts;
  OpenLabels Labels;   // of the bodies of the mesh, of a part one label
  EdgeStiffness Edges; // from Dirichlet vertices to vertices outside the condition, or all

  CellResults Cells;
  VertexFile* VertexGradients = nullptr; // null: not wanted
  Ring<double> Gradients;                // sums over cells and their measure, if they are
  ResultSums Sums;
  std::vector<double> Values, Steps, Sources, Terms; // of a block, a cell; of a vertex two
  std::vector<RowNeighbour> Neighbours;
  bool IsPart = false;
  std::int64_t Final = 0;
};

/** Values in memory as a solution. */
class InMemorySolution final : public Solution
{
public:
  /** `columns` values of each vertex, which another object owns. */
  InMemorySolution(std::span<const double> values, int columns)
    : Values(values)
    , Columns(columns)
  {
  }

  std::int64_t vertices() const override
  {
    return static_cast<std::int64_t>(this->Values.size()) / this->Columns;
  }
  int columns() const override { return this->Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    std::ranges::copy(this->Values.subspan(static_cast<std::size_t>(first * this->Columns),
                        static_cast<std::size_t>(count * this->Columns)),
      values.begin());
  }
  const Report& report() const override { return this->Nothing; }

private:
  std::span<const double> Values;
  int Columns;
  Report Nothing;
};

/** Replaces the vertices of the minima and maxima of a report by numberOf(vertex). */
template <class NumberOf>
void renumberExtremes(Report& report, NumberOf numberOf)
{
  for (std::vector<Report::Extreme>* extremes : { &report.minimum, &report.maximum })
  {
    for (Report::Extreme& extreme : *extremes)
    {
      // Negative if all values are NaN.
      extreme.vertex = extreme.vertex < 0 ? extreme.vertex : numberOf(extreme.vertex);
    }
  }
}

} // namespace smg
