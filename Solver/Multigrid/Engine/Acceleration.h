// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/**
 * Chebyshev acceleration of an iteration whose error is multiplied by a matrix with eigenvalues in
 * [-bound, bound] (Golub and Varga 1961): after k steps the error is that of the polynomial C_k(t /
 * bound) / C_k(1 / bound), the smallest one on that interval. V-cycles both under- and overshoot,
 * because coarse operators are sparsified. On scans the measured interval reaches as far to the
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

/**
 * The weights of conjugate residuals, which minimise the residual over the combinations of
 * iterates; IterateHistory has the vectors and the formulas. Only the last direction is kept
 * conjugate, which is sufficient for a symmetric V-cycle, and forward Gauss-Seidel is nearly
 * symmetric. It restarts if the products break down.
 */
class ConjugateResiduals
{
public:
  /** The weights of the next step, from the products of the last pass. A start takes two passes:
   * one that stores z, a plain V-cycle that gives the first direction; from the third step on
   * there are weights. */
  StepWeights next(const ResidualProducts& p)
  {
    if (this->Steps++ == 0)
    {
      return { 1.0, 0.0, 0.0, 0.0, true };
    }
    if (this->Steps == 2)
    {
      return {}; // a plain V-cycle from z makes the first direction
    }
    const double conjugation = p.qq > 0.0 ? p.aq / p.qq : 0.0;
    const double length = (p.za - conjugation * p.zq) / (p.aa - conjugation * p.aq);
    // Also false for NaN: an extreme length means that the products are rounding only.
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

/** Decides before each V-cycle whether and how it is accelerated, from the residuals so far.
 * Solves with a fixed number of V-cycles are not accelerated automatically. */
class SMG_EXPORT Acceleration
{
public:
  /** `convergence` has begun and must outlive this object. */
  Acceleration(AccelerationKind wanted, const Convergence& convergence);

  /** The method of the next V-cycle: None, Chebyshev or ConjugateGradients. */
  AccelerationKind kind() const { return this->Kind; }
  /** Decides; to be called before each V-cycle. */
  void decide();
  /** The weights of the next V-cycle if it is accelerated. `products`: from the history after
   * the last one. */
  StepWeights next(const ResidualProducts& products);
  bool isWanted() const { return this->Wanted != AccelerationKind::None; }
  /** To be called if the memory limit has no room for what kind() keeps: falls back to Chebyshev
   * polynomials, which keep the least, from the third V-cycle on, or, if there is no room for
   * these either, to none. */
  void saveMemory();
  /** To be called if what conjugate gradients keep follows from the memory limit, since the
   * solution has other bits then: they began a V-cycle later, for which the memory was measured, or
   * sample fewer residuals. */
  void noteLimit(bool isLater, bool areFewer);

  /** "none", or the method that was last used: "chebyshev" or "cg". */
  const char* used() const { return nameOf(this->Used); }
  void addNotes(std::vector<std::string>& notes, const std::string& what) const;

  template <class State>
  void exchange(State& state)
  {
    state.part("acceleration");
    state(this->Wanted, this->Kind, this->Polynomial, this->Directions, this->Bound, this->Begun,
      this->Used, this->Note);
  }

private:
  static const char* nameOf(AccelerationKind kind);
  bool pays() const;
  void begin();
  void watchPolynomial();
  void giveUp(const std::string& reason);

  const Convergence& StoppingRule;
  AccelerationKind Wanted;
  AccelerationKind Kind = AccelerationKind::None;
  std::optional<Chebyshev> Polynomial;
  ConjugateResiduals Directions;
  double Bound = 0.0;
  int Begun = 0; // V-cycles before the method began
  AccelerationKind Used = AccelerationKind::None;
  std::string Note;
};

} // namespace smg
