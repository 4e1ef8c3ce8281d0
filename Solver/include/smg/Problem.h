// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The weights w_ij of the edges of the mesh: see CellWeights.h. */
enum class Weights
{
  Uniform,   ///< 1 on every edge
  Cotangent, ///< the stiffness of linear finite elements: negative opposite to obtuse angles
  /** The same, raised to a positive floor (see Problem::cells()): an M-matrix, whose solutions obey
   * the maximum principle, but where a weight is raised the operator is another one. */
  Clamped
};

/**
 * Data at the vertices of a MeshBlock. The solver sets all sizes and zeroes (`dirichlet`: -1)
 * before Problem::conditions() fills this in. All numbers must be finite.
 */
struct VertexConditions
{
  /** One a vertex: the number of the Dirichlet condition that prescribes its value, from 0 and
   * below ConditionCounts::dirichlet; -1: none. */
  std::vector<std::int32_t> dirichlet;
  std::vector<double> value;  ///< `columns` a vertex: the prescribed value, or else the initial one
  std::vector<double> source; ///< `columns` a vertex: f, a density (per area or volume)
  std::vector<double> screening; ///< one a vertex: s, at least 0, a density
};

/** Directed edges (i, j). Every edge of the mesh is given once in each direction. */
struct EdgeBatch
{
  std::span<const std::int64_t> from; ///< stream indices i
  std::span<const std::int64_t> to;   ///< stream indices j
  std::span<const double> fromPoint;  ///< positions p_i: x, y, z an edge
  std::span<const double> toPoint;    ///< positions p_j: x, y, z an edge
  std::span<double> target;           ///< out: d_ij, `columns` an edge; 0 on entry
};

/**
 * Consecutive cells of a MeshBlock, with the weights of their edges in the order of edgeCorners().
 * On entry weights and measures are those of linear finite elements with K = 1; all other numbers
 * are 0. All that is set must be finite.
 */
struct CellBatch
{
  CellType type;                         ///< the kind of the cells
  const MeshBlock& block;                ///< the block, with the columns of the cells
  std::size_t first;                     ///< the batch's first cell, counted from 0 in the block
  std::span<const std::int64_t> corners; ///< stream indices, cornersOf(type) a cell
  std::span<const double> points;        ///< positions of the corners: x, y, z a corner
  std::span<double> weight;              ///< in and out: edgesOf(type) a cell
  /** In and out, one a cell: area or volume. A cell with 0 has no weight, whatever `weight` is. */
  std::span<double> measure;
  std::span<double> screening; ///< out, one a cell: s, at least 0, a density
  std::span<double> source;    ///< out, `columns` a cell: f, a density
  std::span<double> field;     ///< out, 3 * `columns` a cell: the vector q of each column
  /**
   * Out, 6 a cell: K as in conductivityWeights(), the identity on entry. Empty unless fluxes are
   * computed (ResultOptions::flux, ConditionCounts::parts).
   */
  std::span<double> conductivity;
  /** Out, one a cell: the number of its part, below ConditionCounts::parts; -1: none. */
  std::span<std::int32_t> part;

  /** Number of cells of the batch. */
  std::size_t cells() const { return this->measure.size(); }
  /** Position (x, y, z) of corner `k` of cell `c` of the batch, both counted from 0. */
  const double* point(std::size_t c, int k) const
  {
    return this->points.data() + 3 * (c * static_cast<std::size_t>(cornersOf(this->type)) + k);
  }
  /** Weights of cell `c` of the batch: edgesOf(type) numbers. */
  std::span<double> weightsOf(std::size_t c) const
  {
    const auto edges = static_cast<std::size_t>(edgesOf(this->type));
    return this->weight.subspan(c * edges, edges);
  }
};

/**
 * The facets of consecutive cells: the edges of triangles, the faces of tetrahedra. Facet k of a
 * cell is opposite to its corner k and has its other corners in their order. What facets() sets for
 * a facet counts only if the facet turns out to be on the boundary: an open edge of a surface, or a
 * face of a single tetrahedron; what innerFacets() sets, only if it turns out to be between cells.
 * On entry `flux` and `robin` are -1, all other numbers 0.
 */
struct FacetBatch
{
  CellType type;                         ///< the kind of the cells
  const MeshBlock& block;                ///< the block of the cells
  std::size_t first;                     ///< the batch's first cell, counted from 0 in the block
  std::span<const std::int64_t> corners; ///< of the cells: stream indices, cornersOf(type) a cell
  /** Out, one a facet: number of its flux condition, below ConditionCounts::flux; -1: none. */
  std::span<std::int32_t> flux;
  /** Out, `columns` a corner of a facet: (K grad u - q) . n, positive into the body. */
  std::span<double> fluxValue;
  /** Out, one a facet: number of its Robin condition, below ConditionCounts::robin; -1: none. The
   * condition adds the flux coefficient * (ambient - u). */
  std::span<std::int32_t> robin;
  std::span<double> coefficient; ///< out, one a corner of a facet, at least 0
  std::span<double> ambient;     ///< out, `columns` a corner of a facet

  /** Number of cells of the batch. */
  std::size_t cells() const
  {
    return this->flux.size() / static_cast<std::size_t>(cornersOf(this->type));
  }
};

/** Numbers of what a problem tells apart; each condition has an entry in Report::conditions. */
struct ConditionCounts
{
  int dirichlet = 0; ///< Dirichlet conditions
  int flux = 0;      ///< flux conditions
  int robin = 0;     ///< Robin conditions
  /** Parts of the mesh by their conductivity, each with an entry in Report::parts. */
  int parts = 0;
  /** The names of the groups that Dirichlet, flux and Robin conditions and parts are stated for, in
   * this order, for their names in the report; "": none. Empty: there are none. */
  std::vector<std::string> groups = {};
};

/** Vertices that a problem couples beyond the cells of the mesh. Their stream indices are those of
 * the mesh that is solved on. */
struct VertexCouplings
{
  /** Two vertices that are one unknown. */
  struct Tie
  {
    std::int64_t vertex; ///< whose value is that of `to`, and its jump
    std::int64_t to;     ///< less than `vertex`, and not tied itself
  };
  /** Two vertices between which there flows the conductance times the difference of their values.
   */
  struct Link
  {
    std::int64_t from;  ///< not tied
    std::int64_t to;    ///< more than `from`, and not tied
    double conductance; ///< more than 0
    /** The number of its contact in `contacts`; -1: none. */
    int contact = -1;
  };
  /** Links that have an entry in Report::contacts. */
  struct Contact
  {
    std::string name;   ///< in the report
    double coefficient; ///< the conductance of a link over its share of the area or length
  };

  std::vector<Tie> ties;         ///< by ascending `vertex`, each once
  std::vector<double> jumps;     ///< `columns` a tie: what `vertex` has more than `to`; empty: 0
  std::vector<Link> links;       ///< by ascending `from`, then `to`, then `contact`
  std::vector<Contact> contacts; ///< that the links refer to
};

/**
 * The elliptic problem -div(K grad u - q) + s u = f by linear finite elements, lumped at the
 * vertices: (L + S) u = F, with u given at the Dirichlet vertices. L_ij = -w_ij, with row sums 0. S
 * and F have s, f, the Robin coefficients and the fluxes, times the share of a vertex in the cells
 * and boundary facets. F also has the integrals of q . grad phi_i and (div d)_i = sum_j w_ij d_ij,
 * which pulls u_i - u_j towards the edge target d_ij. Where no condition is set on the boundary,
 * (K grad u - q) . n = 0.
 *
 * A problem is asked block by block in stream order, on the thread of the caller: once for a
 * solve, more often as SolveOptions::again says, and once more for its results (see SolvedMesh),
 * each time from the first block on. For each
 * block conditions() is called first, then cells() and facets(). What a problem returns must not
 * depend on how the stream is cut into blocks and batches; then the solution does not either, to
 * the last bit. An exception that it throws ends the solve.
 */
class SMG_EXPORT Problem
{
public:
  virtual ~Problem() = default;

  /** Number of right-hand sides that are solved at once, at least 1. */
  virtual int columns() const = 0;
  /** The number of consecutive columns that are one quantity, at least 1: the components of a
   * vector are as exact as the largest of them, other columns each beside its own range. 1 by
   * default. */
  virtual int vectorSize() const { return 1; }
  /** Whether the initial values are a state at rest, and what matters is how the solution differs
   * from it: the tolerance is then relative to their residual. By default it is relative to the
   * residual of the best constant, whatever the initial values. */
  virtual bool beginsAtRest() const { return false; }
  /** The weights of the edges; cotangent by default. */
  virtual Weights weights() const { return Weights::Cotangent; }

  /** Whether cells() is to be called; false by default. */
  virtual bool hasCells() const { return false; }
  /**
   * Sets weights, screening, sources and fields of cells. Called once for each cell, in stream
   * order, in batches of any size. A cell that is degenerate or flagged (CellFlag) has no weight,
   * whatever is set.
   *
   * The weights may be those of a conductivity (see conductivityWeights()) or any others; the
   * weight of an edge is the sum over its cells, the same in both directions. Weights::Clamped
   * raises it to a positive floor: 5e-4 (triangles) or 1e-4 times the length of the edge
   * (tetrahedra), times the scale of the edge's weakest cell, which is the largest weight of the
   * cell over what it was on entry. Weights::Cotangent takes the weights as they are, except in
   * cells so flat that rounding would drown others: those are scaled down. Weights::Uniform ignores
   * them.
   *
   * The solve throws Error if a number is not finite, a measure or screening is negative, no weight
   * of a cell is positive, or the largest one is outside 1e-20 to 1e20.
   */
  virtual void cells(CellBatch& /*batch*/) {}

  /** Whether facets() is to be called; false by default. */
  virtual bool hasFacets() const { return false; }
  /** Sets flux and Robin conditions for facets of cells, in stream order, in batches of any size.
   * They count on the boundary only. */
  virtual void facets(FacetBatch& /*batch*/) {}
  /** Whether innerFacets() is to be called, after facets() with the same cells; false by default.
   */
  virtual bool hasInnerFacets() const { return false; }
  /** The same for facets between cells. Any cell of a facet may set it; its conditions act once. */
  virtual void innerFacets(FacetBatch& /*batch*/) {}

  /** Numbers of conditions that conditions() and facets() refer to; by default one Dirichlet
   * condition. */
  virtual ConditionCounts conditionCounts() const { return { 1, 0, 0 }; }

  /**
   * Whether cells without area or volume, but with distinct corners, connect these by edges of the
   * smallest weight that an edge can have. False by default: they have no weight.
   */
  virtual bool connectsFlatCells() const { return false; }

  /**
   * Whether a vertex that nothing determines, since it belongs to no cell that has a weight, keeps
   * its initial value; true by default. Otherwise its solution is not a number (NaN).
   */
  virtual bool keepsUndetermined() const { return true; }

  /**
   * Sets the data at the vertices of a block.
   * @param block the next block of the stream
   * @param conditions the block's vertices; the solve throws Error if a number is not finite, a
   * screening is negative, or a condition has a number that conditionCounts() does not allow
   */
  virtual void conditions(const MeshBlock& block, VertexConditions& conditions) = 0;

  /**
   * The bytes that the problem keeps of the stream's open vertices, those that later cells may use;
   * 0 by default. Asked after each conditions(): they count within the memory limit of the solve.
   */
  virtual std::int64_t bytes() const { return 0; }

  /** The vertices that are one unknown, or linked; null, by default: none. Only with
   * Weights::Cotangent, and not with edge targets. The same object for all readings of a mesh. */
  virtual std::shared_ptr<const VertexCouplings> couplings() const { return nullptr; }

  /** Whether edgeTargets() is to be called; false by default. Results (SolvedMesh) are not
   * available then. */
  virtual bool hasEdgeTargets() const { return false; }
  /** Sets the target d_ij = -d_ji, finite, of each edge of the batch. */
  virtual void edgeTargets(EdgeBatch& /*batch*/) {}
};

} // namespace smg
