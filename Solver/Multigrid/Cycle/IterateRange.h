// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/SimdPack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/**
 * How much the iterate of each pass varies, beside its distance from the initial values. The
 * tolerance is a share of the residual of the initial values, and the error is about the same share
 * of their distance from the solution. Where that is much larger than the range of the solution, as
 * 293 K are beside a rise by 0.01 K if the iteration begins at 0, that share of the distance can be
 * all of the range.
 *
 * Restriction on the finest level visits the unknowns in any case. Values that are exactly 0 are
 * left out of the iterates: bodies that no condition and no source reaches remain at 0.
 */
class IterateRange
{
public:
  explicit IterateRange(int columns)
    : Columns(static_cast<std::size_t>(columns))
    , First(static_cast<std::size_t>(strideOf(columns)))
    , Now(this->First)
  {
  }

  /** The least and the largest initial value of each column; until they are known, share() is 1. */
  void begin(std::span<const double> least, std::span<const double> most)
  {
    std::ranges::copy(least, this->First.low.begin());
    std::ranges::copy(most, this->First.high.begin());
  }

  void startPass() { this->Now = Ranges(this->Now.low.size()); }

  /** Adds the values of an unknown; `lane` is the first of the columns in the vectors. */
  template <class Vectors>
  void add(const double* x, int lane)
  {
    const auto value = Vectors::load(x);
    const auto first = static_cast<std::size_t>(lane);
    double* least = this->Now.low.data() + first;
    double* most = this->Now.high.data() + first;
    const auto low = Vectors::load(least), high = Vectors::load(most);
    const auto isGiven = value != 0.0;
    Vectors::store(least, (isGiven & (value < low)) ? value : low);
    Vectors::store(most, (isGiven & (value > high)) ? value : high);
  }

  /** The range of the iterate over its largest distance from the initial values, of the column
   * where that is least; at most 1. */
  double share() const
  {
    double share = 1.0;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double range = this->Now.high[k] - this->Now.low[k];
      const double distance =
        std::max(this->Now.high[k] - this->First.low[k], this->First.high[k] - this->Now.low[k]);
      // A column that begins at its solution differs from it by rounding.
      const double rounding =
        Rounding * std::max(std::fabs(this->Now.low[k]), std::fabs(this->Now.high[k]));
      share = range >= 0.0 && distance > std::max(range, rounding)
                ? std::min(share, range / distance)
                : share;
    }
    return share;
  }

  template <class State>
  void exchange(State& state)
  {
    state.part("range");
    const std::size_t lanes = this->Now.low.size();
    state(this->First.low, this->First.high);
    if constexpr (requires { state.require(true); })
    {
      state.require(this->First.low.size() == lanes && this->First.high.size() == lanes);
    }
  }

private:
  static constexpr double Rounding = 1e-13;

  struct Ranges
  {
    explicit Ranges(std::size_t columns)
      : low(columns, std::numeric_limits<double>::infinity())
      , high(columns, -std::numeric_limits<double>::infinity())
    {
    }

    std::vector<double> low, high;
  };

  std::size_t Columns;
  Ranges First, Now;
};

} // namespace smg
