// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Which weight w_ij an edge of the mesh carries. See CellWeights.h. */
enum class Weights
{
  Uniform, ///< 1 on every edge
  /** The stiffness of linear finite elements itself: negative opposite to obtuse angles. */
  Cotangent,
  /** The finite-element stiffness raised to a positive floor: an M-matrix, whose solutions keep the
   * maximum principle, but another operator where it raises. */
  Clamped
};

/**
 * What holds at the vertices of one MeshBlock: one entry (or `columns` of them) a vertex.
 * Resized and zeroed (`dirichlet`: -1) by the engine before Problem::conditions fills it.
 */
struct VertexConditions
{
  /** The number of the Dirichlet condition that prescribes the vertex's value, below
   * Problem::conditionCounts().dirichlet; -1: the vertex is free. */
  std::vector<std::int32_t> dirichlet;
  std::vector<double> value;  ///< `columns` a vertex: the prescribed value, else the initial guess
  std::vector<double> source; ///< `columns` a vertex: f, times the lumped area or volume
  std::vector<double> screening; ///< one a vertex: s >= 0, times the lumped area or volume
};

/**
 * A stretch of directed edges (i,j) of rows that are being assembled. Every edge of the mesh is
 * given once in each direction.
 */
struct EdgeBatch
{
  std::span<const std::int64_t> from, to;     ///< stream indices i and j
  std::span<const double> fromPoint, toPoint; ///< positions p_i and p_j, 3 an edge
  std::span<double> target;                   ///< out: d_ij, `columns` an edge; zero on entry
};

/**
 * A stretch of the cells of a MeshBlock, with the weights that each gives to its edges, in the
 * order of edgeCorners(): 3 of a triangle, 6 of a tetrahedron (see CellWeights.h).
 * On entry weights and measures are those of linear finite elements with K = 1, all else is zero.
 */
struct CellBatch
{
  CellType type;
  const MeshBlock& block;                ///< whose cell columns are the attributes of the cells
  std::size_t first;                     ///< the batch's first cell, numbered in the block
  std::span<const std::int64_t> corners; ///< stream indices, cornersOf(type) a cell
  std::span<const double> points;        ///< positions of the corners, 3 a corner
  std::span<double> weight;              ///< in and out: edgesOf(type) a cell
  /** In and out: area or volume of each cell; at 0 it has no weight, whatever `weight` says. */
  std::span<double> measure;
  std::span<double> screening; ///< out: s >= 0, one a cell
  std::span<double> source;    ///< out: f, `columns` a cell
  std::span<double> field;     ///< out: the vector q, 3 numbers for each of the `columns` of a cell
  /**
   * Out, where it is not empty: K itself, 6 numbers a cell as of conductivityWeights(), the
   * identity on entry. Asked for where fluxes are computed (see ResultOptions) only.
   */
  std::span<double> conductivity;

  std::size_t cells() const { return this->measure.size(); }
  /** The position of corner k of cell c of the batch. */
  const double* point(std::size_t c, int k) const
  {
    return this->points.data() + 3 * (c * static_cast<std::size_t>(cornersOf(this->type)) + k);
  }
  /** The weights of cell c of the batch. */
  std::span<double> weightsOf(std::size_t c) const
  {
    const auto edges = static_cast<std::size_t>(edgesOf(this->type));
    return this->weight.subspan(c * edges, edges);
  }
};

/**
 * The facets of a stretch of cells: edges of triangles, faces of tetrahedra; facet k of a cell is
 * opposite to its corner k and has the other corners in their order. What is said of a facet counts
 * where it turns out to lie on the boundary (open edges of a surface, faces of one tetrahedron).
 * On entry `flux` and `robin` are -1, all else is zero.
 */
struct FacetBatch
{
  CellType type;
  const MeshBlock& block;
  std::size_t first;                     ///< the batch's first cell, numbered in the block
  std::span<const std::int64_t> corners; ///< of the cells: stream indices, cornersOf(type) a cell
  /** Out, one a facet: number of the flux condition that holds, or -1. */
  std::span<std::int32_t> flux;
  /** Out, `columns` a corner of a facet: (K grad u - q) . n, positive into the body. */
  std::span<double> fluxValue;
  /** Out, one a facet: number of the Robin condition that holds, or -1: adds the flux coefficient *
   * (ambient - u). */
  std::span<std::int32_t> robin;
  std::span<double> coefficient; ///< out, one a corner of a facet, at least 0
  std::span<double> ambient;     ///< out, `columns` a corner of a facet

  /** The number of cells. */
  std::size_t cells() const
  {
    return this->flux.size() / static_cast<std::size_t>(cornersOf(this->type));
  }
};

/** How many Dirichlet, flux and Robin conditions a problem has, for which balances are kept. */
struct ConditionCounts
{
  int dirichlet = 0, flux = 0, robin = 0;
};

/**
 * The elliptic problem -div(K grad u - q) + s u = f by linear finite elements, lumped at the
 * vertices: (L + S) u = F, with u given at the Dirichlet vertices. L_ij = -w_ij, row sums zero; S
 * and F have s, f, the Robin coefficients and the fluxes times the share of a vertex in areas,
 * volumes and boundary facets; F also has the integrals of q . grad phi_i and (div d)_i = sum_j
 * w_ij d_ij, which pulls u_i - u_j towards the edge target d_ij. Where nothing else is said,
 * (K grad u - q) . n = 0 on the boundary.
 *
 * A problem is asked block by block, in stream order, on the thread that solves, once for a solve
 * and once more for its results (see SolvedMesh), from the first block on:
 * nothing is called for a single vertex, cell or edge; of a block first conditions(), then cells()
 * and facets(). What it answers must not depend on how the stream is cut into blocks and batches;
 * then neither does the solution, to the last bit. What it throws ends the solve.
 */
class SMG_EXPORT Problem
{
public:
  virtual ~Problem() = default;

  /** Number of right-hand sides solved at once, at least 1. */
  virtual int columns() const = 0;
  virtual Weights weights() const { return Weights::Cotangent; }

  /** Whether cells() is to be called. */
  virtual bool hasCells() const { return false; }
  /**
   * Says what holds in the cells, in stream order. Called once for each cell, in batches of any
   * size; a cell that is flat or flagged has no weight, whatever is set.
   *
   * Weights: those of a conductivity K (see conductivityWeights()), or any others. The weight of an
   * edge is the sum over its cells, the same in both directions. Weights::Clamped raises it to a
   * positive floor: 5e-4 (triangles) or 1e-4 times the edge's length (tetrahedra), times the scale
   * of the edge's weakest cell, which is the cell's largest weight over the largest it had on
   * entry. Weights::Cotangent takes them as they are, but for cells that are too flat (see
   * flatnessFactor()). Weights::Uniform does not look at them.
   *
   * It is an Error if a number is not finite, a measure or screening negative, none of a cell's
   * weights positive, or the largest of them outside 1e-20 to 1e20.
   */
  virtual void cells(CellBatch& /*batch*/) {}

  /** Whether facets() is to be called. */
  virtual bool hasFacets() const { return false; }
  /** Says what would hold on the facets of the cells, if they lie on the boundary. */
  virtual void facets(FacetBatch& /*batch*/) {}

  /** The numbers of conditions that the answers name. */
  virtual ConditionCounts conditionCounts() const { return { 1, 0, 0 }; }

  /**
   * Whether the edges of cells without area or volume that have distinct corners connect these,
   * with the least weight that an edge can have; else such cells carry no weight.
   */
  virtual bool connectsFlatCells() const { return false; }

  /** Says what holds at the vertices of the block. Values that are not finite are an error. */
  virtual void conditions(const MeshBlock& block, VertexConditions& conditions) = 0;

  /** Whether edgeTargets is to be called. */
  virtual bool hasEdgeTargets() const { return false; }
  /** Sets d_ij = -d_ji for each edge of the batch. */
  virtual void edgeTargets(EdgeBatch& /*batch*/) {}
};

} // namespace smg
