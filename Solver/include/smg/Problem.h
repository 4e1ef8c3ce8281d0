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

/** The weights w_ij of the edges of the mesh. See CellWeights.h. */
enum class Weights
{
  Uniform, ///< 1 on every edge
  /** The stiffness of linear finite elements: negative opposite to obtuse angles. */
  Cotangent,
  /** The finite-element stiffness raised to a positive floor: an M-matrix, whose solutions satisfy
   * the maximum principle, but a different operator at raised weights. */
  Clamped
};

/** The conditions at the vertices of one MeshBlock: one entry (or `columns` entries) per vertex.
 * Resized and zeroed (`dirichlet`: -1) by the engine before Problem::conditions fills it. */
struct VertexConditions
{
  /** The index of the Dirichlet condition that prescribes the value of the vertex, below
   * Problem::conditionCounts().dirichlet; -1: the vertex is free. */
  std::vector<std::int32_t> dirichlet;
  std::vector<double> value;     ///< `columns` per vertex: the prescribed or the initial value
  std::vector<double> source;    ///< `columns` per vertex: f, times the lumped area or volume
  std::vector<double> screening; ///< one per vertex: s >= 0, times the lumped area or volume
};

/** A batch of directed edges (i,j) of rows during assembly. Every edge of the mesh occurs once in
 * each direction. */
struct EdgeBatch
{
  std::span<const std::int64_t> from, to;     ///< stream indices i and j
  std::span<const double> fromPoint, toPoint; ///< positions p_i and p_j, 3 per edge
  std::span<double> target;                   ///< out: d_ij, `columns` per edge; zero on entry
};

/**
 * A batch of cells of a MeshBlock with their contributions to the weights of their edges, in the
 * order of edgeCorners(): 3 for a triangle, 6 for a tetrahedron (see CellWeights.h). On entry,
 * weights and measures are those of linear finite elements with K = 1; all others are zero.
 */
struct CellBatch
{
  CellType type;
  const MeshBlock& block;                ///< its cell columns are the attributes of the cells
  std::size_t first;                     ///< the batch's first cell, numbered in the block
  std::span<const std::int64_t> corners; ///< stream indices, cornersOf(type) per cell
  std::span<const double> points;        ///< positions of the corners, 3 per corner
  std::span<double> weight;              ///< in and out: edgesOf(type) per cell
  /** In and out: area or volume of each cell; 0: no weight, independent of `weight`. */
  std::span<double> measure;
  std::span<double> screening; ///< out: s >= 0, one per cell
  std::span<double> source;    ///< out: f, `columns` per cell
  std::span<double> field;     ///< out: the vector q, 3 numbers for each of the `columns` of a cell
  /** Out, unless empty: K, 6 numbers per cell as for conductivityWeights(), the identity on entry.
   * Requested only to compute fluxes (see ResultOptions). */
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
 * The facets of a batch of cells: edges of triangles, faces of tetrahedra; facet k of a cell is
 * opposite to its corner k and has the other corners in their order. The data of a facet apply only
 * if it is on the boundary (open edges of a surface, faces of one tetrahedron). On entry `flux` and
 * `robin` are -1; all others are zero.
 */
struct FacetBatch
{
  CellType type;
  const MeshBlock& block;
  std::size_t first;                     ///< the batch's first cell, numbered in the block
  std::span<const std::int64_t> corners; ///< of the cells: stream indices, cornersOf(type) per cell
  /** Out, one per facet: the index of its flux condition, or -1. */
  std::span<std::int32_t> flux;
  /** Out, `columns` per corner of a facet: (K grad u - q) . n, positive into the body. */
  std::span<double> fluxValue;
  /** Out, one per facet: the index of its Robin condition, or -1: adds the flux coefficient *
   * (ambient - u). */
  std::span<std::int32_t> robin;
  std::span<double> coefficient; ///< out, one per corner of a facet, at least 0
  std::span<double> ambient;     ///< out, `columns` per corner of a facet

  /** The number of cells. */
  std::size_t cells() const
  {
    return this->flux.size() / static_cast<std::size_t>(cornersOf(this->type));
  }
};

/** The numbers of Dirichlet, flux and Robin conditions of a problem, for their balances. */
struct ConditionCounts
{
  int dirichlet = 0, flux = 0, robin = 0;
};

/**
 * The elliptic problem -div(K grad u - q) + s u = f by linear finite elements, lumped at the
 * vertices: (L + S) u = F, with u given at the Dirichlet vertices. L_ij = -w_ij, row sums zero; S
 * and F contain s, f, the Robin coefficients and the fluxes times the share of a vertex in areas,
 * volumes and boundary facets; F also contains the integrals of q . grad phi_i and (div d)_i =
 * sum_j w_ij d_ij, which draws u_i - u_j towards the edge target d_ij. Without a boundary
 * condition, (K grad u - q) . n = 0 on the boundary.
 *
 * A problem is queried block by block, in stream order, on the solving thread, once for a solve and
 * once more for its results (see SolvedMesh), from the first block on. All calls are for blocks or
 * batches; for each block first conditions(), then cells() and facets(). The returned values must
 * not depend on the sizes of blocks and batches; the solution is then independent of these, bit for
 * bit. An exception ends the solve.
 */
class SMG_EXPORT Problem
{
public:
  virtual ~Problem() = default;

  /** The number of simultaneous right-hand sides, at least 1. */
  virtual int columns() const = 0;
  virtual Weights weights() const { return Weights::Cotangent; }

  /** Whether cells() shall be called. */
  virtual bool hasCells() const { return false; }
  /**
   * Sets the data of the cells, in stream order. Called once for each cell, in batches of any size;
   * a flat or flagged cell has no weight in any case.
   *
   * Weights: those of a conductivity K (see conductivityWeights()), or any others. The weight of an
   * edge is the sum over its cells, the same in both directions. Weights::Clamped raises it to a
   * positive floor: 5e-4 (triangles) or 1e-4 times the length of the edge (tetrahedra), times the
   * scale of the weakest cell of the edge, which is the largest weight of the cell over its largest
   * weight on entry. Weights::Cotangent uses them unchanged, except for cells that are too flat
   * (see flatnessFactor()). Weights::Uniform does not use them.
   *
   * It is an Error if a number is not finite, a measure or screening is negative, no weight of a
   * cell is positive, or the largest weight is outside 1e-20 to 1e20.
   */
  virtual void cells(CellBatch& /*batch*/) {}

  /** Whether facets() shall be called. */
  virtual bool hasFacets() const { return false; }
  /** Sets the data of the facets of the cells, which apply to boundary facets only. */
  virtual void facets(FacetBatch& /*batch*/) {}

  /** The numbers of conditions, which bound the returned indices. */
  virtual ConditionCounts conditionCounts() const { return { 1, 0, 0 }; }

  /** Whether edges of cells without area or volume connect distinct corners with the minimum weight
   * of an edge; otherwise such cells have no weight. */
  virtual bool connectsFlatCells() const { return false; }

  /** Sets the conditions at the vertices of the block. Values must be finite. */
  virtual void conditions(const MeshBlock& block, VertexConditions& conditions) = 0;

  /** Whether edgeTargets() shall be called. */
  virtual bool hasEdgeTargets() const { return false; }
  /** Sets d_ij = -d_ji for each edge of the batch. */
  virtual void edgeTargets(EdgeBatch& /*batch*/) {}
};

} // namespace smg
