// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Acceleration.h"

#include <algorithm>
#include <cmath>

// The choice between plain V-cycles, conjugate residuals and Chebyshev polynomials. All of them
// take one pass per V-cycle; they differ in what IterateHistory keeps, and in what must be known
// before they start.
//
// Decisions follow from residuals, which do not depend on windows or threads, and from the memory
// limit, so an accelerated solve is as reproducible as a plain one.

namespace smg
{
namespace
{

/** Conjugate residuals need two V-cycles to start, and pay off only with some more. */
constexpr double WorthwhileCycles = 4.0;
/** The assumed factor of a V-cycle while none has been measured. */
constexpr double UsualFactor = 0.1;

/** The bound of the eigenvalues is set slightly above the measured factor: a polynomial diverges
 * for eigenvalues beyond its bound, and loses little with a bound that is too large. */
constexpr double Margin = 1.05, MinBound = 0.1, LargestBound = 0.98;
/** The number of V-cycles after which the measured factor is that of the slowest errors. */
constexpr int Settling = 2;

/** A polynomial must have reduced the residual in total over this number of V-cycles. Conjugate
 * residuals may stagnate for longer, until they have found the slowest errors of slivers. */
constexpr int Trial = 5;

double boundFrom(double factor)
{
  return std::clamp(Margin * factor, MinBound, LargestBound);
}

} // namespace

const char* Acceleration::nameOf(AccelerationKind kind)
{
  return kind == AccelerationKind::Chebyshev            ? "chebyshev"
         : kind == AccelerationKind::ConjugateGradients ? "cg"
                                                        : "none";
}

Acceleration::Acceleration(AccelerationKind wanted, const Convergence& convergence)
  : StoppingRule(convergence)
  // Automatic is for solves that stop at a tolerance: a method that saves V-cycles saves nothing if
  // their number is fixed.
  , Wanted(wanted == AccelerationKind::Automatic && convergence.fixed() ? AccelerationKind::None
                                                                        : wanted)
{
}

/** Whether enough plain V-cycles remain, by the factor measured so far, for a faster method to
 * make up for its start. */
bool Acceleration::pays() const
{
  // A factor of 1 or more is no estimate of the remaining V-cycles, but acceleration is most needed
  // then.
  const double factor =
    this->StoppingRule.cycles() == 0 ? UsualFactor : this->StoppingRule.factor();
  return factor >= 1.0 || this->StoppingRule.cyclesLeft(factor) >= WorthwhileCycles;
}

/** Starts the wanted method if it is time: conjugate residuals at once (Automatic: if they pay),
 * polynomials when a factor is known that tells their bound. */
void Acceleration::begin()
{
  switch (this->Wanted)
  {
    case AccelerationKind::None:
      return;
    case AccelerationKind::Chebyshev:
      if (this->StoppingRule.cycles() < Settling)
      {
        return;
      }
      this->Bound = boundFrom(this->StoppingRule.factor());
      this->Polynomial.emplace(this->Bound);
      this->Kind = AccelerationKind::Chebyshev;
      break;
    case AccelerationKind::Automatic:
      if (!this->pays())
      {
        return;
      }
      [[fallthrough]];
    case AccelerationKind::ConjugateGradients:
      this->Kind = AccelerationKind::ConjugateGradients;
      break;
  }
  this->Begun = this->StoppingRule.cycles();
}

void Acceleration::decide()
{
  if (this->Kind == AccelerationKind::None)
  {
    this->begin();
    return;
  }
  // Conjugate residuals minimise what they measure and are left alone.
  const std::vector<double>& r = this->StoppingRule.residuals();
  const int since = this->StoppingRule.cycles() - this->Begun;
  if (this->Polynomial && since > Trial && r.back() >= r[r.size() - 1 - Trial])
  {
    this->giveUp("it did not make the residual smaller");
  }
  else if (this->Polynomial)
  {
    this->watchPolynomial();
  }
}

/** With the bound b the residual decreases by s = b / (1 + sqrt(1 - b^2)) per step. If it
 * decreases by s g with g > 1, there are eigenvalues beyond the bound: the largest t has |t| =
 * b (g + 1/g) / 2, where C_k(t / b) grows by g per step. The polynomial then starts again with
 * that bound. */
void Acceleration::watchPolynomial()
{
  // Less is within the fluctuation of single steps.
  constexpr double Tolerated = 1.2;
  const std::vector<double>& r = this->StoppingRule.residuals();
  if (this->StoppingRule.cycles() - this->Begun <= Settling)
  {
    return;
  }
  const double b = this->Bound;
  const double expected = b / (1 + std::sqrt(1 - b * b));
  // Over two steps, since single ones alternate.
  const double growth = std::sqrt(r.back() / r[r.size() - 3]) / expected;
  if (growth > Tolerated && b < LargestBound)
  {
    this->Bound = boundFrom(b * (growth + 1 / growth) / 2);
    this->Polynomial.emplace(this->Bound);
    this->Begun = this->StoppingRule.cycles();
  }
}

StepWeights Acceleration::next(const ResidualProducts& products)
{
  this->Used = this->Kind;
  return this->Polynomial ? this->Polynomial->next() : this->Directions.next(products);
}

void Acceleration::saveMemory()
{
  // One vector is the least that any method keeps.
  if (this->Kind == AccelerationKind::Chebyshev)
  {
    this->giveUp("it would need more than the memory limit");
    return;
  }
  this->Note = "conjugate gradients would need more than the memory limit: Chebyshev polynomials "
               "accelerate instead, from the third V-cycle on";
  this->Wanted = AccelerationKind::Chebyshev;
  this->Kind = AccelerationKind::None;
}

void Acceleration::noteLimit(bool isLater, bool areFewer)
{
  this->Note = std::string("the memory limit is near what conjugate gradients need: they ") +
               (isLater ? "began one V-cycle later" : "") + (isLater && areFewer ? " and " : "") +
               (areFewer ? "keep the residuals of one vertex in sixteen" : "");
}

/** Stops the acceleration, for the given reason. */
void Acceleration::giveUp(const std::string& reason)
{
  this->Note = std::string("acceleration (") + nameOf(this->Kind) + ") was given up after " +
               std::to_string(this->StoppingRule.cycles()) + " V-cycles: " + reason;
  this->Wanted = this->Kind = AccelerationKind::None;
}

void Acceleration::addNotes(std::vector<std::string>& notes, const std::string& what) const
{
  if (!this->Note.empty())
  {
    notes.push_back(what + this->Note);
  }
}

} // namespace smg
