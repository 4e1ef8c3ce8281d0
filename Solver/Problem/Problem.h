// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/MeshSource.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Which weight w_ij an edge of the mesh carries. See Solver/Problem/CellWeights.h. */
enum class Weights
{
  Uniform,  ///< 1 on every edge
  Cotangent ///< the finite-element stiffness, clamped from below
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
 * The Poisson problem (L + s M) x = M f + div d with x given at the constrained vertices:
 * L_ij = -w_ij, row sums zero; M the lumped areas or volumes, s the screening, f the source
 * densities; (div d)_i = sum_j w_ij d_ij pulls x_i - x_j towards the edge target d_ij.
 *
 * A problem is asked block by block, in stream order, once.
 */
class Problem
{
public:
  virtual ~Problem() = default;

  /** Number of right-hand sides solved at once, at least 1. */
  virtual int columns() const = 0;
  virtual Weights weights() const { return Weights::Cotangent; }
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
