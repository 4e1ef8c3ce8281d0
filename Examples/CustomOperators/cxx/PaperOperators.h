// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <smg/SolveWith.h>

#include <algorithm>
#include <cstdint>

/**
 * The operators of the paper between two levels: Shi, Bao, Zhou, "Out-of-Core Multigrid Solver for
 * Streaming Meshes", 2009, section 2.1 and equations (3) to (5). A C-point is a lifted node there,
 * an F-point a retained one.
 *
 * The paper has positive weights. Here some may be negative (cotangent weights) or vanish (right
 * angles), and both would spoil (5), a mean with the weights w_ij: so "neighbour" means one that
 * couples(). Then each retained node with a neighbour has a lifted one, the weights in (5) are
 * positive, and their sum is at most 1, and 1 where no constraint reaches.
 *
 * Not of the paper: (5) without its term g, the error on the edges, and a Galerkin product instead
 * of (6) to (10), with which V-cycles would not converge to the solution. Of more than five lifted
 * neighbours, rare on surfaces, P keeps those with the largest weights.
 *
 * Cost: linear in the entries of the row.
 */
template <class Own>
struct PaperRows : smg::RowOperators<Own>
{
  static bool couples(const smg::FineRow& row, const smg::FineRow::Neighbour& other)
  {
    constexpr float Rounding = 1e-6F; // below it, a float beside the strongest weight is noise
    return other.weight > Rounding * row.strongest();
  }

  /** Whether the neighbour is in R(i). While nodes are lifted: so far, which is what lifting asks.
   */
  static bool isLifted(const smg::FineRow& row, const smg::FineRow::Neighbour& other)
  {
    return other.isCoarse && couples(row, other);
  }

  /** Section 2.1: an unconstrained node is lifted unless it has a lifted neighbour: in stream order
   * a maximal independent set. Constrained nodes have no row. Stiff ones, at slivers with large
   * negative weights, are lifted, too: a mean of neighbours is no approximation there. */
  bool isCPoint(const smg::FineRow& row) const
  {
    return !row.empty() &&
           (row.isStiff() || std::ranges::none_of(row.neighbours(),
                               [&](const auto& other) { return isLifted(row, other); }));
  }

  /** Equation (5) of a retained node: w_ij / Z_i for j in R(i), Z_i = sum of these w_ij + alpha_i.
   * alpha_i, what ties i to constraints, is the sum of row i of A; among negative weights it may be
   * negative. Equation (4), that a lifted node copies, is the library's. */
  void weightsOf(const smg::FineRow& row, smg::InterpolationWeights& P) const
  {
    double Z = std::max(0.0, row.rowSum());
    for (const auto& other : row.neighbours())
    {
      Z += isLifted(row, other) ? other.weight : 0.0F;
    }
    for (const auto& other : row.neighbours())
    {
      if (isLifted(row, other))
      {
        P.append(other.coarse, other.weight / Z);
      }
    }
  }
};

/** With the sparsified Galerkin product of the library. */
struct PaperOperators : PaperRows<PaperOperators>
{
  static constexpr const char* name = "paper";
};

/** With the Galerkin product itself: nothing is removed from it. */
struct FullPaperOperators : PaperRows<FullPaperOperators>
{
  static constexpr const char* name = "paper, full";
  void sparsify(smg::CoarseningData&, std::int64_t) const {}
};
