// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * What flows along the edges of the iterate of each pass: the norm over the rows of
 * sum_j |w_ij (x_j - x_i)| + |b_i - alpha_i x_i|, alpha_i the row sum.
 *
 * Where coefficients differ by many orders of magnitude, the residual of the initial values is as
 * large as the largest of them, but what flows through the whole is limited by the smallest. Fluxes
 * are sums of residuals, so these must be small beside what flows. Restriction on the finest level
 * has the rows and their values in any case.
 */
class IterateFlow
{
public:
  /** Fluxes are sums of residuals over many rows: the residual is judged by this part of what
   * flows, so that they have the digits of the tolerance but one or two. */
  static constexpr double Judged = 0.1;

  explicit IterateFlow(int columns)
    : Columns(static_cast<std::size_t>(columns))
    , Squares(static_cast<std::size_t>(strideOf(columns)))
    , TermSquares(static_cast<std::size_t>(strideOf(columns)))
  {
  }

  void startPass()
  {
    std::ranges::fill(this->Squares, 0.0);
    std::ranges::fill(this->TermSquares, 0.0);
  }

  /** Adds row k of a block, which counts as `share`; x and b point to its node 0, `lane` is the
   * first of their columns, `term` is A_kk x_k. */
  template <class Vectors, class Arrays>
  void add(const RowBlock::Header& h, const Arrays& a, std::int64_t k, std::int64_t stride,
    const double* x, const double* b, typename Vectors::Vector term, double share, int lane)
  {
    using Vector = typename Vectors::Vector;
    const auto magnitude = [](const Vector& v) { return v < 0.0 ? -v : v; };
    const Vector xk = Vectors::load(x + k * stride);
    Vector flow = magnitude(Vectors::load(b + k * stride) - RowBlock::alphaOf(h, a, k) * xk);
    const BlockRange row = entriesOf(h, a, k);
    for (std::int64_t e = row.begin; e < row.end; ++e)
    {
      flow += magnitude(
        static_cast<double>(a.weight[e]) * (Vectors::load(x + (k + a.delta[e]) * stride) - xk));
    }
    double* sum = this->Squares.data() + lane;
    Vectors::store(sum, Vectors::load(sum) + share * flow * (share * flow));
    double* terms = this->TermSquares.data() + lane;
    Vectors::store(terms, Vectors::load(terms) + share * term * (share * term));
  }

  /** The norm of the column in which least flows, of those in which more does than the rounding of
   * values makes flow; 0 if there is none. */
  double norm() const
  {
    constexpr double OfTerms = 3e-16;
    double least = 0.0;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double flow = std::sqrt(this->Squares[k]);
      const bool flows = flow > OfTerms * std::sqrt(this->TermSquares[k]);
      least = flows && (least == 0.0 || flow < least) ? flow : least;
    }
    return least;
  }

  template <class State>
  void exchange(State& state)
  {
    state.part("flow");
    const std::size_t lanes = this->Squares.size();
    state(this->Squares, this->TermSquares);
    if constexpr (requires { state.require(true); })
    {
      state.require(this->Squares.size() == lanes && this->TermSquares.size() == lanes);
    }
  }

private:
  std::size_t Columns;
  std::vector<double> Squares, TermSquares;
};

} // namespace smg
