// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/KnownFluxes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

// With phi the solution for 1 on a condition and 0 on the others, without sources, the flux through
// that condition is wrong by the sum of phi_i r_i over the residuals r, where phi is between 0 and
// 1. Rounding has residuals of random signs, an unfinished solve of one sign: the larger one of the
// sum and of a multiple of the root of the squares is what a flux may be wrong by.
//
// Where a condition holds its body loosely, phi is about a constant m there, so that the sum of r
// counts m times, and phi - m little else. The energy of phi, phi . A phi, is at most C, what the
// condition adds to the sums of the rows, and likewise at most what all others add: the energies of
// 1 - phi and phi differ by no more. Residuals of random signs are a sum of A d with random d, the
// rounding of u for instance, so (phi - m) . r = phi . A d is at most the root of C d . A d, and
// d . A d is about the sum of r_i^2 / A_ii. This is the smaller bound by far if C is tiny beside
// the weights: in a body that stands in air of 1e-13 W/(m2 K), the last digit of u moves more heat
// from vertex to vertex than flows through the whole, and none of it leaves.

namespace smg
{
namespace
{

constexpr double Digit = std::numeric_limits<double>::epsilon();
/** Values that differ by no more than this part of their size count as one number. */
constexpr double OfValues = 1e-6;

/** Whether numbers from least to most, if there are any, differ by no more than a part of their
 * size. */
bool isOneNumber(double least, double most, double part)
{
  return !(most - least > part * std::max(std::fabs(most), std::fabs(least)));
}

bool isGiven(const Report::Condition& condition)
{
  return condition.name.starts_with("flux");
}

bool isNowhere(const Report::Condition& condition)
{
  return condition.vertices == 0 && condition.area == 0.0;
}

std::string formatted(const char* format, double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

/** The names of conditions, of many the first ones. */
std::string namesOf(const std::set<std::size_t>& conditions, const Report& report)
{
  constexpr std::size_t Most = 8;
  std::string names;
  std::size_t count = 0;
  for (const std::size_t c : conditions)
  {
    if (count == Most)
    {
      return names + " and " + std::to_string(conditions.size() - Most) + " more";
    }
    names += (count++ == 0 ? "" : ", ") + report.conditions[c].name;
  }
  return names;
}

} // namespace

KnownFluxes::KnownFluxes(const BodyFlows& bodies, Report& report, bool hasRest)
  : Bodies(bodies)
  , Into(report)
  , HasRest(hasRest)
{
  for (std::size_t c = 0; c < report.conditions.size(); ++c)
  {
    if (!isGiven(report.conditions[c]))
    {
      this->Places.push_back(c);
    }
  }
  for (const auto& [place, rowSum] : bodies.touched())
  {
    Hold& hold =
      this->Holds.try_emplace(place.second, Hold{ bodies.screened(place.second) }).first->second;
    const bool isFirm = rowSum == BodyFlows::Far;
    hold.sum += isFirm ? 0.0 : rowSum;
    hold.firm += isFirm ? 1 : 0;
  }
}

/**
 * The power, twice the energy, over the range of u is what flows at least through the whole.
 * Nothing flows where one number is prescribed, up to rounding, no source or flux is given, and the
 * values are one number, up to what the solve leaves: then what flows is only that.
 */
KnownFluxes::Flow KnownFluxes::flowIn(std::int32_t body, std::size_t k) const
{
  constexpr double OfTerms = 1e-6, OfPrescribed = 4.0 * Digit;
  const BodyFlows::Sums& sums = this->Bodies.of(body, k);
  Flow flow{ sums.all };
  flow.varies = !isOneNumber(sums.least, -sums.most, OfValues);
  if (!flow.varies && isOneNumber(sums.lowest, -sums.highest, OfPrescribed) && sums.given == 0.0 &&
      this->Into.converged && sums.all <= OfTerms * sums.terms)
  {
    return {};
  }
  flow.least = flow.varies ? 2.0 * sums.energy / (-sums.most - sums.least) : flow.all;
  return flow;
}

/** By how much the flux of a condition that adds this to the sums of the rows of a body may be
 * wrong there. */
double KnownFluxes::doubt(std::int32_t body, double rowSum, const Flow& flow, std::size_t k) const
{
  constexpr double Sure = 3.0;
  const BodyFlows::Sums& sums = this->Bodies.of(body, k);
  // With the first body, others may be judged whose sources the solve has changed: their residuals
  // are what it has taken away.
  if (body == 0 && !this->Into.removed_source.empty() && this->Into.removed_source[k] != 0.0)
  {
    return 0.0;
  }
  const Hold& hold = this->Holds.at(body);
  const bool isFirm = rowSum == BodyFlows::Far;
  const double others = hold.firm > (isFirm ? 1 : 0)
                          ? BodyFlows::Far
                          : std::max(0.0, hold.sum - (isFirm ? 0.0 : rowSum));
  const double energy = std::min(rowSum, others);
  const double squares =
    energy < BodyFlows::Far ? std::min(sums.squares, energy * sums.scaled) : sums.squares;
  const double left = std::max(std::fabs(sums.residual), Sure * std::sqrt(squares));
  // Fluxes are differences of nearly equal terms.
  return flow.varies || this->HasRest ? left : std::max(left, Digit * sums.terms);
}

/** Adds what is known of the flux of a condition in a body that it holds by this. */
void KnownFluxes::add(Known& known, std::int32_t body, double rowSum, std::size_t k) const
{
  // Values that differ little have lost digits before they came here.
  constexpr double Noted = 1e-3, NotedOfOffsets = 1e-4;
  // Below some ten times what the last digit of u makes, a smaller tolerance changes little.
  constexpr double OfRounding = 1e3;
  const BodyFlows::Sums& sums = this->Bodies.of(body, k);
  const Flow flow = this->flowIn(body, k);
  if (flow.all <= 0.0)
  {
    return;
  }
  const double wrong = this->doubt(body, rowSum, flow, k);
  known.flow.all += flow.all;
  known.flow.least += flow.least;
  known.doubt += wrong;
  if (wrong > (flow.varies ? Noted : NotedOfOffsets) * flow.all)
  {
    const bool isOffset =
      this->Bodies.screened(body) == 0.0 && isOneNumber(sums.lowest, -sums.highest, OfValues);
    known.share = std::max(known.share, wrong / flow.all);
    known.isOffset = known.isOffset || isOffset;
    known.helps = known.helps || (!isOffset && sums.squares > OfRounding * sums.rounding);
  }
}

KnownFluxes::Column KnownFluxes::judge(std::size_t k)
{
  // Of the flux, of what flows through the whole, and of a tenth of all that flows.
  constexpr double Unknown = 0.1;
  Column column{};
  for (std::int32_t body = 0; body < this->Bodies.labels(); ++body)
  {
    column.all += this->flowIn(body, k).all;
  }
  std::vector<Known> all(this->Places.size());
  for (const auto& [place, rowSum] : this->Bodies.touched())
  {
    this->add(all[static_cast<std::size_t>(place.first)], place.second, rowSum, k);
  }
  for (std::size_t c = 0; c < all.size(); ++c)
  {
    const Known& known = all[c];
    Report::Condition& of = this->Into.conditions[this->Places[c]];
    const double large = std::max(known.flow.least, Unknown * known.flow.all);
    if (isNowhere(of))
    {
      continue;
    }
    if (known.doubt > Unknown * std::max(std::fabs(of.flux[k]), large))
    {
      of.flux[k] = std::numeric_limits<double>::quiet_NaN();
      column.isLost = true;
      this->Lost.insert(this->Places[c]);
      this->LostBy = std::max(this->LostBy, known.doubt);
    }
    else if (known.share > 0.0)
    {
      this->Few.insert(this->Places[c]);
      this->Worst.share = std::max(this->Worst.share, known.share);
      this->Worst.helps = this->Worst.helps || known.helps;
      this->Worst.isOffset = this->Worst.isOffset || known.isOffset;
    }
  }
  return column;
}

void KnownFluxes::warn(double rest)
{
  constexpr double Noted = 1e-3;
  if (!this->Lost.empty())
  {
    this->Into.warn("the flux of " + namesOf(this->Lost, this->Into) +
                    " is not known: what the solve has left may change it by up to " +
                    formatted("%.1e", this->LostBy));
  }
  if (!this->Into.converged || (this->Few.empty() && rest <= Noted))
  {
    return;
  }
  const std::string names = this->Few.empty() ? "the conditions" : namesOf(this->Few, this->Into);
  this->Into.warn(
    "the fluxes of " + names + " are known up to " +
    formatted("%.2g", 100.0 * std::max(this->Worst.share, rest)) + " % of all that flows there" +
    (this->Worst.helps       ? ": a smaller tolerance may make them better"
      : this->Worst.isOffset ? ": values that differ little beside their size have few digits; "
                               "take off what they have in common"
                             : ""));
}

} // namespace smg
