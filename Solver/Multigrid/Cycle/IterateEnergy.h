// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace smg
{

/**
 * The energy J(x) = 1/2 x.A x - b.x of the iterate of each pass, up to a constant, from the
 * residual r = b - A x that the restriction of the finest level has: J = -1/2 x.(b + r). What the
 * error x* - x loses in its squared energy norm is twice what J loses, since A is symmetric.
 *
 * So that a large mean of the solution does not drown this in rounding, x is counted from a number
 * c of each column: with alpha the row sums of A, -1/2 (x - c).(b - c alpha + r) differs from J by
 * a constant. c is the mean of b / alpha, weighted with |alpha|, which the first pass finds: near
 * what is prescribed. Where all alpha are 0, it is the mean of x.
 */
class IterateEnergy
{
public:
  explicit IterateEnergy(int columns)
    : Stride(static_cast<std::size_t>(strideOf(columns)))
    , Numbers(5 * this->Stride)
  {
  }

  void startPass(bool first)
  {
    if (!first && !this->HasCentre)
    {
      this->HasCentre = true;
      for (std::size_t k = 0; k < this->Stride; ++k)
      {
        const auto mean = [&](std::size_t sum, std::size_t weights) {
          return this->Numbers[sum * this->Stride + k] / this->Numbers[weights * this->Stride + k];
        };
        const bool isHeld = this->Numbers[2 * this->Stride + k] > 0.0;
        const bool hasNodes = this->Numbers[4 * this->Stride + k] > 0.0;
        this->Numbers[k] = isHeld ? mean(1, 2) : hasNodes ? mean(3, 4) : 0.0;
      }
    }
    std::fill(
      this->Numbers.begin() + static_cast<std::ptrdiff_t>(this->Stride), this->Numbers.end(), 0.0);
  }

  /** Adds a node of unknown x: `lane` is the first of its columns that the vectors have. */
  template <class Vectors, class Vector>
  void add(const double* x, const double* b, const Vector& r, double alpha, int lane)
  {
    double* centre = this->Numbers.data() + lane;
    double* sum = centre + this->Stride;
    if (!this->HasCentre)
    {
      const double weight = std::fabs(alpha);
      const double sign = weight > 0.0 ? std::copysign(1.0, alpha) : 0.0;
      Vectors::store(sum, Vectors::load(sum) + sign * Vectors::load(b));
      Vectors::store(sum + this->Stride, Vectors::load(sum + this->Stride) + weight);
      double* plain = sum + 2 * this->Stride;
      Vectors::store(plain, Vectors::load(plain) + Vectors::load(x));
      Vectors::store(plain + this->Stride, Vectors::load(plain + this->Stride) + 1.0);
      return;
    }
    const Vector c = Vectors::load(centre);
    Vectors::store(
      sum, Vectors::load(sum) - 0.5 * (Vectors::load(x) - c) * (Vectors::load(b) - alpha * c + r));
  }

  /** That of the pass, summed over the columns; not of the first pass. */
  double value() const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Stride; ++k)
    {
      sum += this->Numbers[this->Stride + k];
    }
    return sum;
  }

  template <class State>
  void exchange(State& state)
  {
    state.part("energy");
    state(this->HasCentre, this->Numbers);
  }

private:
  std::size_t Stride;
  std::vector<double> Numbers; ///< c; sums of the energy, or of +-b; of |alpha|, of x, of 1
  bool HasCentre = false;
};

} // namespace smg
