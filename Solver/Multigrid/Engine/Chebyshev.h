// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"

namespace smg
{

/**
 * Chebyshev acceleration of an iteration whose error is multiplied by a matrix with eigenvalues in
 * [-bound, bound] (Golub and Varga 1961): after k steps the error is that of the polynomial C_k(t /
 * bound) / C_k(1 / bound), the smallest on that interval. V-cycles both under- and overshoot,
 * because coarse operators are sparsified: on scans the measured interval is equally long on the
 * negative side, and polynomials for [0, bound] are slower than no acceleration.
 */
class Chebyshev
{
public:
  /** `bound` in (0, 1). */
  explicit Chebyshev(double bound)
    : Quarter(bound * bound / 4)
  {
  }

  /** The weights of the next step. */
  StepWeights next()
  {
    this->Omega = this->Steps == 0   ? 1.0
                  : this->Steps == 1 ? 1 / (1 - 2 * this->Quarter)
                                     : 1 / (1 - this->Quarter * this->Omega);
    ++this->Steps;
    return { this->Omega, this->Omega - 1 };
  }

private:
  double Quarter;
  double Omega = 1.0;
  int Steps = 0;
};

} // namespace smg
