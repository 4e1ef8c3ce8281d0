// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Convergence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace smg
{

/** Of each column: the squares of the initial residual and of its rounding (see InitialResidual),
 * and the norm of what is measured against (see VaryingRightSide), or, without a right-hand side,
 * of the residual itself. */
struct ColumnResiduals
{
  std::vector<double> squares, rounding, references;

  /** All columns together; the residual is measured against itself. */
  FirstResidual alone() const;
};

/** Makes one number of the residuals of all columns. Each quantity, of one column or the columns of
 * a vector, counts beside its own reference: one of small values is to be as exact as one of large
 * ones. Scales are 1 where quantities are alike, have no reference, or are not known. */
class ColumnScales
{
public:
  ColumnScales() = default;
  /** `vectorSize`: see Problem::vectorSize(). */
  ColumnScales(std::span<const double> references, int vectorSize)
  {
    const auto size = static_cast<std::size_t>(std::max(1, vectorSize));
    double squares = 0.0, count = 0.0;
    for (std::size_t first = 0; first < references.size(); first += size)
    {
      double own = 0.0;
      for (const double reference :
        references.subspan(first, std::min(size, references.size() - first)))
      {
        own += reference * reference;
        this->Scales.push_back(0.0);
      }
      std::fill(this->Scales.begin() + static_cast<std::ptrdiff_t>(first), this->Scales.end(),
        own > 0.0 ? 1.0 / std::sqrt(own) : 0.0);
      squares += own;
      count += own > 0.0 ? 1.0 : 0.0;
    }
    this->Reference = std::sqrt(squares);
    for (double& scale : this->Scales)
    {
      scale = scale > 0.0 ? scale * this->Reference / std::sqrt(count) : 1.0;
    }
  }

  double operator[](std::size_t column) const
  {
    return column < this->Scales.size() ? this->Scales[column] : 1.0;
  }
  /** The sum of these squares of the columns. */
  double sum(std::span<const double> squares) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < squares.size(); ++k)
    {
      sum += (*this)[k] * (*this)[k] * squares[k];
    }
    return sum;
  }
  /** The residual of the initial values. */
  FirstResidual of(const ColumnResiduals& columns) const
  {
    return { std::sqrt(this->sum(columns.squares)), roundingOf(this->sum(columns.rounding)),
      this->Reference };
  }

  template <class State>
  void exchange(State& state)
  {
    state(this->Scales, this->Reference);
  }

private:
  std::vector<double> Scales;
  double Reference = 0.0;
};

inline FirstResidual ColumnResiduals::alone() const
{
  FirstResidual residual = ColumnScales().of(*this);
  residual.reference = residual.norm;
  return residual;
}

} // namespace smg
