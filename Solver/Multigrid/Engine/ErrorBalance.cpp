// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/ErrorBalance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

// Balances two estimates that cost differently: the algebraic error comes with every pass, the
// discretisation error needs the mesh once more. All errors here are squares of energy norms, hence
// the squares of shares below.

namespace smg
{
namespace
{

/** The algebraic error that is small enough, over the discretisation error. */
constexpr double Enough = 0.1;
/** The relative residual from which on the discretisation error is worth an estimate. */
constexpr double Promising = 1e-3;
/** The most estimates of the discretisation error. Where it is not much larger than the
 * algebraic error for a long time, it is nothing to stop by. */
constexpr int MaxMeasures = 6;
/** An algebraic error up to this share does not disturb the estimate, which is made with the
 * iterate. */
constexpr double Undisturbing = 0.5;

} // namespace

bool ErrorBalance::add(double energy, double residual, double factor)
{
  this->estimate(energy, factor);
  if (this->Algebraic == Unknown)
  {
    return false;
  }
  // The first estimate waits for a promising residual; a later one replaces an estimate that the
  // algebraic error of its time disturbed, and only where it would decide.
  if (this->Measures == 0)
  {
    if (residual > Promising)
    {
      return false;
    }
    this->measure();
  }
  if (this->isEnough() && this->isDisturbed() && this->Measures < MaxMeasures)
  {
    this->measure();
  }
  return this->isEnough() && !this->isDisturbed();
}

/** Whether the algebraic error was too large at the time of the last estimate. */
bool ErrorBalance::isDisturbed() const
{
  return this->AtMeasure > Undisturbing * Undisturbing * this->Mesh.error;
}

/** Estimates the algebraic error from the last energies. It stays Unknown where the energy did
 * not fall, as may happen with acceleration or at the limit of rounding, or where the factors
 * promise no convergence. */
void ErrorBalance::estimate(double energy, double factor)
{
  this->Energies.push_back(energy);
  const double before = std::exchange(this->Factor, factor);
  this->Algebraic = Unknown;
  const std::size_t n = this->Energies.size();
  if (n < 2)
  {
    return;
  }
  const double* last = this->Energies.data() + n - 1;
  const double fall = 2.0 * (last[-1] - last[0]);
  // The more pessimistic of what is known: an error that is underestimated would end the solve too
  // early.
  const double slower = n == 2 ? factor : std::max(factor, before);
  double q = slower * slower;
  if (n > 2 && last[-2] > last[-1])
  {
    q = std::max(q, fall / (2.0 * (last[-2] - last[-1])));
  }
  if (fall > 0.0 && q < 1.0)
  {
    this->Algebraic = this->Known = fall * q / (1.0 - q);
  }
}

void ErrorBalance::measure()
{
  this->Mesh = this->Estimate();
  this->AtMeasure = this->Algebraic;
  ++this->Measures;
}

bool ErrorBalance::isEnough() const
{
  return this->Algebraic <= Enough * Enough * this->Mesh.error;
}

void ErrorBalance::report(Report& report) const
{
  if (this->Measures == 0)
  {
    if (!this->Energies.empty())
    {
      report.notes.push_back(
        "the V-cycles ended before the discretisation error could be estimated");
    }
    return;
  }
  const auto root = [](double square) { return std::sqrt(std::max(0.0, square)); };
  report.errors = { root(this->Known), root(this->Mesh.error), root(this->Mesh.solution) };
  const Report::Errors& found = *report.errors;
  const bool isRelative = found.energy_norm > 0.0;
  const double unit = isRelative ? found.energy_norm / 100.0 : 1.0;
  char text[200];
  std::snprintf(text, sizeof(text),
    "estimated errors, %s: %.2g%s since the equations are solved approximately, %.2g%s since the "
    "mesh is no finer",
    isRelative ? "of the energy norm of the solution" : "in the energy norm",
    found.algebraic / unit, isRelative ? " %" : "", found.discretisation / unit,
    isRelative ? " %" : "");
  report.notes.emplace_back(text);
}

} // namespace smg
