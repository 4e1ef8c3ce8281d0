// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"

#include <cmath>

namespace smg
{

/**
 * The weights of conjugate residuals, which minimise the residual over the combinations of
 * iterates; see IterateHistory for the vectors. Only the last direction is kept conjugate, which is
 * sufficient for a symmetric V-cycle; forward Gauss-Seidel is nearly symmetric. Restarts if the
 * products break down.
 */
class ConjugateResiduals
{
public:
  /** The weights of the next step, from the products of the last pass. */
  StepWeights next(const ResidualProducts& p)
  {
    if (this->Steps++ == 0)
    {
      return { 1.0, 0.0, 0.0, 0.0, true };
    }
    if (this->Steps == 2)
    {
      return {}; // a plain V-cycle from z gives the first direction
    }
    const double conjugation = p.qq > 0.0 ? p.aq / p.qq : 0.0;
    const double length = (p.za - conjugation * p.zq) / (p.aa - conjugation * p.aq);
    if (!(std::fabs(length) >= 1 / Longest && std::fabs(length) <= Longest))
    {
      *this = {};
      return this->next(p);
    }
    const StepWeights weights{ length,
      this->Length == 0.0 ? 0.0 : -length * conjugation / this->Length, conjugation, length };
    this->Length = length;
    return weights;
  }

private:
  static constexpr double Longest = 100.0;

  int Steps = 0;
  double Length = 0.0;
};

} // namespace smg
