// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Acceleration.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

/** Conjugate residuals need two V-cycles to start and pay off from the next one on. */
constexpr double WorthwhileCycles = 4.0;
/** The assumed factor of a V-cycle before one has been measured. */
constexpr double UsualFactor = 0.1;

/** The bound of the eigenvalues is slightly above the measured factor. */
constexpr double Margin = 1.05, MinBound = 0.1, LargestBound = 0.98;
/** V-cycles after which the factor is that of the slowest errors. */
constexpr int Settling = 2;

/** Cycles of a polynomial that must reduce the residual in total. Conjugate residuals may stagnate
 * for longer until they have found the slowest errors of slivers. */
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
  : Watched(convergence)
  , Wanted(wanted == AccelerationKind::Automatic && convergence.fixed() ? AccelerationKind::None
                                                                        : wanted)
{
}

/** Whether so many plain V-cycles remain that a faster method compensates for its start. */
bool Acceleration::pays() const
{
  const double factor = this->Watched.cycles() == 0 ? UsualFactor : this->Watched.factor();
  return factor >= 1.0 || this->Watched.cyclesLeft(factor) >= WorthwhileCycles;
}

void Acceleration::begin()
{
  switch (this->Wanted)
  {
    case AccelerationKind::None:
      return;
    case AccelerationKind::Chebyshev:
      if (this->Watched.cycles() < Settling)
      {
        return;
      }
      this->Bound = boundFrom(this->Watched.factor());
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
  this->Begun = this->Watched.cycles();
}

void Acceleration::decide()
{
  if (this->Kind == AccelerationKind::None)
  {
    this->begin();
    return;
  }
  const std::vector<double>& r = this->Watched.residuals();
  const int since = this->Watched.cycles() - this->Begun;
  if (this->Polynomial && since > Trial && r.back() >= r[r.size() - 1 - Trial])
  {
    this->giveUp("it did not make the residual smaller");
  }
  else if (this->Polynomial)
  {
    this->watchPolynomial();
  }
}

/**
 * With the bound b the residual decreases by s = b / (1 + sqrt(1 - b^2)) per step. If it decreases
 * by s g, g > 1, there are eigenvalues beyond: |t| = b (g + 1/g) / 2, where C_k(t / b) grows by g
 * per step.
 */
void Acceleration::watchPolynomial()
{
  constexpr double Tolerated = 1.2;
  const std::vector<double>& r = this->Watched.residuals();
  if (this->Watched.cycles() - this->Begun <= Settling)
  {
    return;
  }
  const double b = this->Bound;
  const double expected = b / (1 + std::sqrt(1 - b * b));
  const double growth = std::sqrt(r.back() / r[r.size() - 3]) / expected;
  if (growth > Tolerated && b < LargestBound)
  {
    this->Bound = boundFrom(b * (growth + 1 / growth) / 2);
    this->Polynomial.emplace(this->Bound);
    this->Begun = this->Watched.cycles();
  }
}

StepWeights Acceleration::next(const ResidualProducts& products)
{
  this->Used = this->Kind;
  return this->Polynomial ? this->Polynomial->next() : this->Directions.next(products);
}

void Acceleration::saveMemory()
{
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

/** Stops the acceleration, for the given reason. */
void Acceleration::giveUp(const std::string& reason)
{
  this->Note = std::string("acceleration (") + nameOf(this->Kind) + ") was given up after " +
               std::to_string(this->Watched.cycles()) + " V-cycles: " + reason;
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
