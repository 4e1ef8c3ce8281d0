// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ResultSums.h"

#include "Solver/Assembly/CommonShare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <string>

namespace smg
{
namespace
{

std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2g", 100.0 * share);
  return text;
}

} // namespace

ResultSums::ResultSums(CellType type, Problem& problem)
  : conditions(type, problem.conditionCounts(), problem.columns())
  , Columns(static_cast<std::size_t>(problem.columns()))
  , HasFacets(problem.hasFacets())
  , Reaction(this->Columns)
  , Mean(this->Columns)
  , Source(this->Columns)
  , Screening(this->Columns)
  , ScreeningEnergy(this->Columns)
  , Magnitude(this->Columns)
  , CellEnergy(this->Columns)
  , LeftOut(this->Columns)
  , ReactionTerms(this->Columns)
  , RobinTerms(this->Columns)
{
  constexpr double Far = std::numeric_limits<double>::infinity();
  this->minimum.assign(this->Columns, { Far, -1 });
  this->maximum.assign(this->Columns, { -Far, -1 });
}

void ResultSums::add(VertexTerms terms, const double* u, std::int32_t dirichlet)
{
  if (isUndetermined(u))
  {
    return;
  }
  this->Mass += terms.mass();
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double source = terms.source(k);
    const double screening = terms.screening() * u[k];
    this->Mean[k] += terms.mass() * u[k];
    this->Source[k] += source;
    this->Screening[k] += screening;
    this->ScreeningEnergy[k] += 0.5 * screening * u[k];
    this->Magnitude[k] += std::fabs(source) + std::fabs(screening);
  }
  if (this->HasFacets)
  {
    this->addRobinTerms(terms, u);
  }
  if (dirichlet >= 0)
  {
    this->addDirichlet(terms, u, dirichlet);
  }
}

void ResultSums::addRobinTerms(VertexTerms terms, const double* u)
{
  const double share = commonShare(terms.transfer(), terms.edges());
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->RobinTerms[k] +=
      share * (std::fabs(terms.inflow(k)) + terms.transfer() * std::fabs(u[k]));
  }
}

/** Adds the reaction ((L + S) u - F)_i without the edges within the condition, which cancel. */
void ResultSums::addDirichlet(VertexTerms terms, const double* u, std::int32_t dirichlet)
{
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->Reaction[k] = (terms.screening() + terms.transfer()) * u[k] -
                        (terms.source(k) + terms.inflow(k)) + terms.outflow(k);
    this->ReactionTerms[k] += terms.outflowTerms(k);
  }
  this->conditions.add(dirichlet, u, this->Reaction.data());
}

void ResultSums::setCells(const CellResults& cells)
{
  this->CellEnergy = cells.energy();
  this->LeftOut = cells.leftOut();
}

std::vector<double*> ResultSums::numbers()
{
  std::vector<double*> all{ &this->Mass };
  for (auto* sums :
    { &this->Mean, &this->Source, &this->Screening, &this->ScreeningEnergy, &this->Magnitude,
      &this->CellEnergy, &this->LeftOut, &this->ReactionTerms, &this->RobinTerms })
  {
    std::ranges::transform(*sums, std::back_inserter(all), [](double& sum) { return &sum; });
  }
  this->conditions.appendNumbers(all);
  return all;
}

void ResultSums::finish(Report& report) const
{
  report.conditions = this->conditions.conditions();
  report.energy = this->CellEnergy;
  report.mean = this->Mean;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    report.energy[k] += this->ScreeningEnergy[k];
    report.mean[k] /= this->Mass;
  }
  report.minimum = this->minimum;
  report.maximum = this->maximum;
  this->reportBalance(report);
  noteConditionsWithoutEffect(report);
  this->noteFlatCells(report);
}

void ResultSums::noteConditionsWithoutEffect(Report& report)
{
  for (const Report::Condition& condition : report.conditions)
  {
    const bool isDirichlet = condition.name.starts_with("dirichlet");
    if (isDirichlet && std::isnan(condition.mean.front()))
    {
      report.warn(condition.name + " has no effect: others hold wherever it does");
    }
    if (condition.area == 0.0 && !isDirichlet)
    {
      report.warn(condition.name + " has no effect: " +
                  "no facet of the boundary is where it holds, or later ones hold there");
    }
  }
}

void ResultSums::reportBalance(Report& report) const
{
  // Fluxes below these shares of the terms that they are differences of are rounding or the
  // remaining residual: they count as no flow.
  constexpr double Rounding = 1e-12, Noted = 1e-3;
  double largest = 0.0;
  report.source = this->Source;
  report.screening = this->Screening;
  report.balance.assign(this->Columns, 0.0);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    if (!report.removed_source.empty())
    {
      report.source[k] -= report.removed_source[k];
    }
    const double rest = this->conditions.inflow()[k] + report.source[k] - report.screening[k];
    const double all = this->conditions.magnitude()[k] + this->Magnitude[k];
    const double noise =
      std::max(Rounding * (this->ReactionTerms[k] + this->conditions.robinTerms()[k]),
        report.residual() * (this->ReactionTerms[k] + this->RobinTerms[k]));
    report.balance[k] = all > noise ? rest / all : 0.0;
    largest = std::max(largest, std::fabs(report.balance[k]));
  }
  if (largest > Noted && report.converged)
  {
    report.notes.push_back("the fluxes of the conditions miss their balance by " +
                           percent(largest) +
                           " % of all that flows: a smaller tolerance makes them "
                           "better");
  }
}

/** The energy d of a solution in the omitted part of the cells bounds the energy of its difference
 * from the exact one: for all v, a(u - u_h, v) = d(u_h, v) <= sqrt(d(u_h, u_h) a(v, v)). */
void ResultSums::noteFlatCells(Report& report) const
{
  double share = 0.0;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double left = this->LeftOut[k];
    share = left > 0.0 ? std::max(share, std::sqrt(left / report.energy[k])) : share;
  }
  if (share > 0.0)
  {
    report.notes.push_back("for the cells that are too flat the solution differs from that of "
                           "finite elements by at most " +
                           percent(share) + " % in the energy norm");
  }
}

} // namespace smg
