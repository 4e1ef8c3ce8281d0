// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/ErrorBalance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace smg
{
namespace
{

/** The algebraic error that is small enough, over that of the discretisation. */
constexpr double Enough = 0.1;
/** The residual from which on it pays to estimate that of the discretisation. */
constexpr double Promising = 1e-3;
/** The share up to which an algebraic error does not disturb that estimate. */
constexpr double Undisturbing = 0.25;

} // namespace

bool ErrorBalance::add(double energy, double residual, double factor)
{
  this->estimate(energy, factor);
  if (this->Algebraic == Unknown)
  {
    return false;
  }
  if (this->AtMeasure == Unknown)
  {
    if (residual > Promising)
    {
      return false;
    }
    this->measure();
  }
  if (!this->isBelow(Enough))
  {
    return false;
  }
  if (this->AtMeasure > Undisturbing * Undisturbing * this->Mesh.error)
  {
    this->measure();
  }
  return this->isBelow(Enough);
}

void ErrorBalance::estimate(double energy, double factor)
{
  this->Energies.push_back(energy);
  const double slower = std::max(factor, this->Factor);
  this->Factor = factor;
  this->Algebraic = Unknown;
  const std::size_t n = this->Energies.size();
  if (n < 2)
  {
    return;
  }
  const double* last = this->Energies.data() + n - 1;
  const double fall = 2.0 * (last[-1] - last[0]);
  double q = (n == 2 ? factor : slower) * (n == 2 ? factor : slower);
  if (n > 2 && last[-2] > last[-1])
  {
    q = std::max(q, fall / (2.0 * (last[-2] - last[-1])));
  }
  if (fall > 0.0 && q < 1.0)
  {
    this->Algebraic = fall * q / (1.0 - q);
  }
}

void ErrorBalance::measure()
{
  this->Mesh = this->Estimate();
  this->AtMeasure = this->Algebraic;
}

bool ErrorBalance::isBelow(double share) const
{
  return this->Algebraic <= share * share * this->Mesh.error;
}

void ErrorBalance::report(Report& report) const
{
  if (this->Algebraic == Unknown || this->AtMeasure == Unknown)
  {
    report.notes.push_back("the V-cycles ended before the discretisation error could be estimated");
    return;
  }
  report.errors = { std::sqrt(this->Algebraic), std::sqrt(this->Mesh.error),
    std::sqrt(this->Mesh.solution) };
  char text[160];
  std::snprintf(text, sizeof(text),
    "estimated errors, of the energy norm of the solution: %.2g %% since the equations are solved "
    "approximately, %.2g %% since the mesh is no finer",
    100.0 * report.errors->algebraic / report.errors->energy_norm,
    100.0 * report.errors->discretisation / report.errors->energy_norm);
  report.notes.emplace_back(text);
}

} // namespace smg
