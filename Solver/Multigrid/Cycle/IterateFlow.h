// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"

#include <algorithm>
#include <array>
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
 * Where coefficients differ by many orders of magnitude, the residual of the best constant is as
 * large as the largest of them, but what flows through the whole is limited by the smallest. Fluxes
 * are sums of residuals, so these must be small beside what flows. A good conductor may carry more
 * than flows elsewhere, though: so the residual must also be small beside what flows if each row
 * is divided by its diagonal, where all conductors are alike. Restriction on the finest level has
 * the rows and their values in any case.
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
    , ScaledSquares(static_cast<std::size_t>(strideOf(columns)))
    , ScaledResidualSquares(static_cast<std::size_t>(strideOf(columns)))
    , ValueSquares(static_cast<std::size_t>(strideOf(columns)))
  {
  }

  void startPass()
  {
    for (std::vector<double>* sums : this->sums())
    {
      std::ranges::fill(*sums, 0.0);
    }
  }

  /** Adds row k of a block, which counts as `share`; x and b point to its node 0, `lane` is the
   * first of their columns. */
  template <class Vectors, class Arrays>
  void add(const RowBlock::Header& h, const Arrays& a, std::int64_t k, std::int64_t stride,
    const double* x, const double* b, typename Vectors::Vector residual, double share, int lane)
  {
    using Vector = typename Vectors::Vector;
    const auto magnitude = [](const Vector& v) { return v < 0.0 ? -v : v; };
    const Vector xk = Vectors::load(x + k * stride);
    Vector flow = magnitude(Vectors::load(b + k * stride) - RowBlock::rowSumOf(h, a, k) * xk);
    const BlockRange row = entriesOf(h, a, k);
    for (std::int64_t e = row.begin; e < row.end; ++e)
    {
      flow += magnitude(
        static_cast<double>(a.weight[e]) * (Vectors::load(x + (k + a.delta[e]) * stride) - xk));
    }
    const double diagonal = static_cast<double>(a.diagonal[k]), scale = share / diagonal;
    const auto addSquare = [lane](std::vector<double>& sums, const Vector& value)
    {
      double* const sum = sums.data() + lane;
      Vectors::store(sum, Vectors::load(sum) + value * value);
    };
    addSquare(this->Squares, share * flow);
    addSquare(this->TermSquares, share * diagonal * xk);
    addSquare(this->ScaledSquares, scale * flow);
    addSquare(this->ScaledResidualSquares, scale * residual);
    addSquare(this->ValueSquares, share * xk);
  }

  /** The norm of the column in which least flows, of those in which more does than the rounding of
   * values makes flow, times scale(column); 0 if there is none. */
  template <class Scale>
  double norm(Scale scale) const
  {
    constexpr double OfTerms = 3e-16;
    double least = 0.0;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double flow = std::sqrt(this->Squares[k]);
      const bool flows = flow > OfTerms * std::sqrt(this->TermSquares[k]);
      const double scaled = scale(k) * flow;
      least = flows && (least == 0.0 || scaled < least) ? scaled : least;
    }
    return least;
  }

  /** The norm of the residual beside what flows, both in rows divided by their diagonals, of the
   * column where that is largest; 0 where it is the rounding of values. */
  double scaledResidual() const
  {
    constexpr double Rounding = 4e-15;
    double largest = 0.0;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double residual = this->ScaledResidualSquares[k];
      const bool isRounding = residual <= Rounding * Rounding * this->ValueSquares[k];
      largest = isRounding ? largest : std::max(largest, residual / this->ScaledSquares[k]);
    }
    return std::sqrt(largest);
  }

  template <class State>
  void exchange(State& state)
  {
    state.part("flow");
    const std::size_t lanes = this->Squares.size();
    for (std::vector<double>* sums : this->sums())
    {
      state(*sums);
      if constexpr (requires { state.require(true); })
      {
        state.require(sums->size() == lanes);
      }
    }
  }

private:
  std::array<std::vector<double>*, 5> sums()
  {
    return { &this->Squares, &this->TermSquares, &this->ScaledSquares, &this->ScaledResidualSquares,
      &this->ValueSquares };
  }

  std::size_t Columns;
  std::vector<double> Squares, TermSquares; ///< of what flows, and of A_kk x_k
  std::vector<double> ScaledSquares, ScaledResidualSquares, ValueSquares;
};

} // namespace smg
