// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/CellWeights.h"
#include "Solver/Stream/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Which weight w_ij an edge of the mesh carries. See Solver/Problem/CellWeights.h. */
enum class Weights
{
  Uniform, ///< 1 on every edge
  /** The stiffness of linear finite elements itself: negative opposite to obtuse angles. */
  Cotangent,
  /** The finite-element stiffness raised to a positive floor: an M-matrix, whose solutions keep the
   * maximum principle, but another operator where it raises. */
  Clamped,
  Own ///< what Problem::cellWeights makes of the cells, clamped from below
};

/**
 * What holds at the vertices of one MeshBlock: one entry (or `columns` of them) a vertex.
 * Resized and zeroed by the engine before Problem::conditions fills it.
 */
struct VertexConditions
{
  std::vector<std::uint8_t> prescribed; ///< 1: a constrained vertex, its value is given
  std::vector<double> value;  ///< `columns` a vertex: the prescribed value, else the initial guess
  std::vector<double> source; ///< `columns` a vertex: density, times the lumped area or volume
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
 * order of edgeCorners(): 3 of a triangle, 6 of a tetrahedron (see Solver/Problem/CellWeights.h).
 * On entry weights and measures are those of linear finite elements.
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
 * The Poisson problem (L + s M) x = M f + div d with x given at the constrained vertices:
 * L_ij = -w_ij, row sums zero; M the lumped areas or volumes, s the screening, f the source
 * densities; (div d)_i = sum_j w_ij d_ij pulls x_i - x_j towards the edge target d_ij.
 *
 * A problem is asked block by block, in stream order, once, on the thread that solves: nothing is
 * called for a single vertex, cell or edge. What it answers must not depend on how the stream is
 * cut into blocks and batches; then neither does the solution, to the last bit. What it throws ends
 * the solve.
 */
class Problem
{
public:
  virtual ~Problem() = default;

  /** Number of right-hand sides solved at once, at least 1. */
  virtual int columns() const = 0;
  virtual Weights weights() const { return Weights::Cotangent; }

  /**
   * With Weights::Own: replaces or changes the weights and measures of the cells, in stream order.
   * The weight of an edge is the sum over its cells, the same in both directions. Called once for
   * each cell, in batches of any size; a cell that is flat or flagged has no weight, whatever is
   * set.
   *
   * Negative weights may be set, but the sum is raised to a positive floor as for cotangent
   * weights: 5e-4 (triangles) or 1e-4 times the edge's length (tetrahedra), times the scale of the
   * edge's weakest cell, which is the cell's largest weight over the largest it had on entry.
   *
   * It is an Error if a number is not finite, a measure negative, none of a cell's weights
   * positive, or the weight of an edge outside 1e-20 to 1e20.
   *
   * A conductivity k, for -div k grad x, is a factor k of the weights on entry.
   */
  virtual void cellWeights(CellBatch& /*batch*/) {}

  /** The screening s, at least 0. */
  virtual double screening() const { return 0.0; }

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
