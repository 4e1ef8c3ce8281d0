// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Convergence.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

// When a solve ends. The norm of the residual comes for free from the restriction of each pass. A
// small residual is no proof of a small error, but it is what can be compared with the rounding of
// its own terms: below that, more V-cycles change nothing.

namespace smg
{
namespace
{

/** A residual above this multiple of the initial one does not recover. */
constexpr double Diverged = 1e4;
/** A residual stagnates if it is still above this share of its value some V-cycles ago: 60 at
 * most, 2 if it is of the size of the rounding of its terms, or has met the tolerance. */
constexpr double Stagnating = 0.9;
constexpr int Patience = 60, RoundingPatience = 2;
/** Half of the allowed V-cycles if that is less than 60, but at least this many. */
constexpr int MinPatience = 10;
constexpr double NearRounding = 10.0;
/** What is left of initial values far from the solution is rounding below this share of their
 * residual. */
constexpr double OfInitial = 1e-12;

} // namespace

/** About two units in the last place for each term, whose squares add up as for independent
 * errors. */
double roundingOf(double termSquares)
{
  constexpr double Rounding = 4e-16;
  return Rounding * std::sqrt(termSquares);
}

std::string scientific(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2e", value);
  return text;
}

/** Initial values that solve the problem up to rounding cannot be improved: reaching the rounding
 * is all that is asked. */
Convergence::Convergence(const Stopping& stopping, const FirstResidual& first)
  : Fixed(stopping.cycles > 0)
  , Limit(this->Fixed ? stopping.cycles : stopping.maxCycles)
  , Tolerance(stopping.tolerance)
  , Rounding(first.rounding)
  , Reference(first.reference > 0.0 ? first.reference : first.rounding)
  , Least(first.norm <= first.rounding ? first.rounding : 0.0)
  , Goal(std::max(stopping.tolerance * first.reference, this->Least))
  , Initial(this->Reference > 0.0 ? first.norm / this->Reference : 0.0)
{
}

/** A share near 1 does not count: the goal is then that of the residual alone. Below the least goal
 * rounding begins: that of the iterate, if it is known, which may be far below that of the initial
 * values. */
void Convergence::setGoal(double share, double rounding)
{
  constexpr double Near = 0.1, OfReference = 1e-12;
  if (this->Goal < this->Reference)
  {
    const double least = rounding > 0.0
                           ? std::min(OfReference, NearRounding * rounding / this->Reference)
                           : OfReference;
    const double tolerance = std::min(
      this->Tolerance, share < Near ? std::max(this->Tolerance * share, least) : this->Tolerance);
    this->Goal = std::max(this->Reference * tolerance, this->Least);
  }
}

void Convergence::begin(double norm, bool mayEnd)
{
  this->Norm = norm;
  // The first sweeps may increase the residual; divergence is measured from the larger of both.
  this->FirstNorm = std::max(this->Reference, norm);
  this->Done = this->Converged = mayEnd && !this->Fixed && norm <= this->Goal;
  if (this->Done && this->Initial > 0.0)
  {
    this->Note = "the initial values meet the tolerance: no V-cycle was needed";
  }
}

/** Order matters: an overflow is an error even of the last V-cycle, divergence only if the goal
 * is not met, and a fixed number of V-cycles asks for neither tolerance nor patience. */
void Convergence::add(double norm, double rounding, double share, double scaled)
{
  this->Rounding = std::max(this->Rounding, rounding);
  this->setGoal(share, rounding);
  const double relative = this->Reference > 0.0 ? norm / this->Reference : 0.0;
  this->NormBefore = this->Norm;
  this->Norm = norm;
  this->Residuals.push_back(relative);
  this->ScaledResiduals.push_back(scaled);
  this->Converged = norm <= this->Goal && scaled <= this->Tolerance;
  if (!std::isfinite(norm))
  {
    throw Error("the numbers of the solve overflow in V-cycle " + std::to_string(this->cycles()) +
                ", from a residual of " + scientific(this->Reference) +
                ": coarse levels compute in single precision, up to 3e38; scale the prescribed "
                "values, the sources or the screening");
  }
  // The first coarse-grid correction is as rough as single precision in a good conductor, where a
  // small roughness is a large residual: the next one is smaller.
  if (norm > Diverged * this->FirstNorm && norm > this->NormBefore && this->cycles() > 1 &&
      !this->Converged)
  {
    throw Error(
      "the solve diverges (relative residual " + scientific(relative) + " after " +
      std::to_string(this->cycles()) +
      " V-cycles), as it may where cells are very flat or where conductivities, screening "
      "or coefficients differ by many orders of magnitude: try more sweeps, or uniform "
      "weights");
  }
  if (this->Fixed)
  {
    this->Done = this->Converged = this->cycles() >= this->Limit;
    return;
  }
  // A note is about the present state only.
  this->Note.clear();
  if (!this->Converged)
  {
    this->watch();
  }
  this->Done = this->Done || this->Converged;
}

namespace
{

const std::string AtRounding = "converged as far as the rounding of the numbers allows: ";
const std::string AtFlow = "converged, but little flows beside what good conductors would carry: ";

} // namespace

bool isOnResidual(const std::string& note)
{
  return note.find(AtRounding) != std::string::npos || note.find(AtFlow) != std::string::npos;
}

/** Ends a solve that has not reached its goal if it stagnates or has used up its V-cycles.
 * Stagnation at the rounding counts as convergence, and so does a residual that met the tolerance.
 */
void Convergence::watch()
{
  const bool isEven = this->ScaledResiduals.back() <= this->Tolerance;
  const double rounded =
    std::max(NearRounding * this->Rounding, OfInitial * this->Initial * this->Reference);
  const bool rounding = isEven && this->Norm <= rounded;
  // Only the lowered goal is missing.
  const bool isMet = isEven && std::ranges::any_of(this->Residuals,
                                 [this](double residual) { return residual <= this->Tolerance; });
  const int patience =
    rounding || isMet ? RoundingPatience : std::clamp(this->Limit / 2, MinPatience, Patience);
  const int n = this->cycles();
  // Of poor conductors, while the residual of good ones waits for them.
  const std::vector<double>& watched = isEven ? this->Residuals : this->ScaledResiduals;
  const bool stagnates =
    n > patience &&
    watched.back() > Stagnating * watched[static_cast<std::size_t>(n - patience - 1)];
  if (!stagnates && n < this->Limit)
  {
    return;
  }
  this->Done = true;
  this->Converged = (stagnates && rounding) || isMet;
  const std::string residual = isEven
                                 ? "the relative residual "
                                 : "the residual of poor conductors, beside what flows in them, ";
  const std::string reached = scientific(watched.back());
  if (stagnates && rounding)
  {
    this->Note = AtRounding + residual + "is " + reached;
  }
  else if (this->Converged)
  {
    this->Note = AtFlow + residual + "is " + reached;
  }
  else if (stagnates)
  {
    this->Note = "not converged: " + residual + "stagnates at " + reached;
  }
  else
  {
    this->Note = "not converged: " + residual + "is " + reached + " after " + std::to_string(n) +
                 (n == 1 ? " V-cycle" : " V-cycles") + ", the most allowed";
  }
}

double Convergence::cyclesLeft(double factor) const
{
  return this->Norm > this->Goal && this->Goal > 0.0
           ? std::log(this->Goal / this->Norm) / std::log(factor)
           : 0.0;
}

void Convergence::addNotes(Report& report, const std::string& what) const
{
  if (this->Note.empty())
  {
    return;
  }
  // Rounding has ended the solve, with a residual that is no measure of its error.
  if (this->Converged && !this->Residuals.empty() &&
      this->Residuals.back() >= std::max(1.0, this->Initial))
  {
    report.warn(what + this->Note +
                ", so that the solution may be wrong in all digits: cells are very thin, or "
                "conductivities, screening or coefficients differ by many orders of magnitude");
    return;
  }
  report.notes.push_back(what + this->Note);
}

void Convergence::addStep(Report& report, const std::string& name, const std::string& what) const
{
  report.cycles += this->cycles();
  report.residuals.insert(report.residuals.end(), this->Residuals.begin(), this->Residuals.end());
  report.steps.push_back({ name, this->cycles(),
    this->Residuals.empty() ? 0.0 : this->Residuals.back(), this->Converged });
  this->addNotes(report, what);
}

} // namespace smg
