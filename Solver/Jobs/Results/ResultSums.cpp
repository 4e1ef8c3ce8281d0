// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ResultSums.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Results/KnownFluxes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <string>

// The figures that follow from a solution: energy, means, extremes, and the flow through each
// condition. They are sums over cells, boundary facets and vertices, each taken in the order of the
// stream, so that they have the same bits for any blocks. Sums over the parts of a distributed mesh
// add up: every one of them can be listed as a number.
//
// The flow out of a Dirichlet condition is the reaction of its equations, (L + S) u - F, rather
// than an integral of grad u: with reactions, inflow and outflow balance up to the residual of the
// solve, on any mesh.

namespace smg
{

ConditionSums::ConditionSums(CellType type, const ConditionCounts& counts, int columns)
  : bodies(counts, columns)
  , Corners(BoundaryFacet::cornersOf(type))
  , Columns(static_cast<std::size_t>(columns))
  , Inflow(this->Columns)
  , Groups(counts.groups)
{
  const std::vector<double> zeros(this->Columns);
  const Sums none{ 0.0, zeros, zeros, zeros, 0.0 };
  this->Dirichlet.assign(static_cast<std::size_t>(counts.dirichlet), none);
  this->Flux.assign(static_cast<std::size_t>(counts.flux), none);
  this->Robin.assign(static_cast<std::size_t>(counts.robin), none);
}

/** Adds a facet to each condition that holds on it. Vertices without a value (NaN) have no share in
 * the equations, and none here. */
void ConditionSums::add(
  const BoundaryFacet& facet, double area, const OpenVertices& vertices, std::int32_t label)
{
  const double share = area / this->Corners;
  const std::int32_t first = vertices.dirichlet[facet.corners[0]];
  // A facet is part of a Dirichlet condition if all its corners are prescribed by it.
  bool same = first >= 0 && !facet.isInner;
  for (int c = 1; c < this->Corners; ++c)
  {
    same = same && vertices.dirichlet[facet.corners[c]] == first;
  }
  if (same)
  {
    this->addMean(this->Dirichlet[static_cast<std::size_t>(first)], facet, area, vertices);
  }
  if (facet.flux >= 0)
  {
    Sums& sums = this->Flux[static_cast<std::size_t>(facet.flux)];
    this->addMean(sums, facet, area, vertices);
    for (std::size_t e = 0; e < static_cast<std::size_t>(this->Corners) * this->Columns; ++e)
    {
      const std::int64_t corner = facet.vertices[e / this->Columns];
      const double weight = isUndetermined(vertices.values.at(corner)) ? 0.0 : share;
      const double flux = weight * facet.fluxValue[e];
      this->addFlux(sums, e % this->Columns, flux, label);
      this->bodies.of(label, e % this->Columns).given += std::fabs(flux);
    }
  }
  if (facet.robin >= 0)
  {
    this->addRobin(facet, area, vertices, label);
  }
}

void ConditionSums::addRobin(
  const BoundaryFacet& facet, double area, const OpenVertices& vertices, std::int32_t label)
{
  Sums& sums = this->Robin[static_cast<std::size_t>(facet.robin)];
  this->addMean(sums, facet, area, vertices);
  for (int c = 0; c < this->Corners; ++c)
  {
    const double* value = vertices.values.at(facet.vertices[c]);
    const double factor = isUndetermined(value) ? 0.0 : area / this->Corners * facet.coefficient[c];
    if (factor <= 0.0)
    {
      continue;
    }
    this->bodies.touchRobin(facet.robin, label, factor);
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double ambient = facet.ambient[static_cast<std::size_t>(c) * this->Columns + k];
      this->addFlux(sums, k, factor * vertices.below(ambient, facet.vertices[c], k), label);
      // The flux is a small difference of these where u is close to the ambient value.
      BodyFlows::Sums& body = this->bodies.of(label, k);
      body.terms += factor * (std::fabs(ambient) + std::fabs(value[k]));
      body.prescribe(ambient);
    }
  }
}

/** Adds a prescribed vertex; its reaction is the flow through the condition there. */
void ConditionSums::add(
  std::int32_t dirichlet, const double* value, const double* reaction, std::int32_t label)
{
  Sums& sums = this->Dirichlet[static_cast<std::size_t>(dirichlet)];
  sums.vertices += 1.0;
  this->bodies.touchDirichlet(dirichlet, label);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    sums.vertexValue[k] += value[k];
    this->addFlux(sums, k, reaction[k], label);
    this->bodies.of(label, k).prescribe(value[k]);
  }
}

/** Adds a facet to the mean of u over a condition; its share without a value is left out of value
 * and area alike. */
void ConditionSums::addMean(
  Sums& sums, const BoundaryFacet& facet, double area, const OpenVertices& vertices)
{
  const double share = area / this->Corners;
  int determined = 0;
  for (int c = 0; c < this->Corners; ++c)
  {
    const double* value = vertices.values.at(facet.vertices[c]);
    determined += isUndetermined(value) ? 0 : 1;
    for (std::size_t k = 0; !isUndetermined(value) && k < this->Columns; ++k)
    {
      sums.value[k] += share * value[k];
    }
  }
  // The whole area in the usual case, free of the rounding of a sum of shares.
  sums.area += determined == this->Corners ? area : share * determined;
}

/** Adds a flow to its condition, to the inflow through all conditions, and to the magnitudes
 * against which a balance is judged. */
void ConditionSums::addFlux(Sums& sums, std::size_t column, double flux, std::int32_t label)
{
  sums.flux[column] += flux;
  this->Inflow[column] += flux;
  this->bodies.of(label, column).all += std::fabs(flux);
}

/** Area and number of vertices of each condition, its sums by column, then the sums over all
 * conditions. */
void ConditionSums::appendNumbers(std::vector<double*>& numbers)
{
  const auto append = [&numbers](std::vector<double>& sums)
  { std::ranges::transform(sums, std::back_inserter(numbers), [](double& sum) { return &sum; }); };
  for (auto* all : { &this->Dirichlet, &this->Flux, &this->Robin })
  {
    for (Sums& sums : *all)
    {
      numbers.insert(numbers.end(), { &sums.area, &sums.vertices });
      append(sums.value);
      append(sums.flux);
      append(sums.vertexValue);
    }
  }
  append(this->Inflow);
}

std::vector<Report::Condition> ConditionSums::conditions() const
{
  std::vector<Report::Condition> conditions;
  this->append("dirichlet", this->Dirichlet, conditions);
  this->append("flux", this->Flux, conditions);
  this->append("robin", this->Robin, conditions);
  return conditions;
}

std::string ConditionSums::groupOf(std::size_t place) const
{
  return place < this->Groups.size() ? this->Groups[place] : "";
}

std::string ConditionSums::groupOfPart(std::size_t part) const
{
  return this->groupOf(this->Dirichlet.size() + this->Flux.size() + this->Robin.size() + part);
}

/** The means of a condition: over its facets if it has any, else over its vertices; NaN if it holds
 * nowhere. */
void ConditionSums::append(
  const char* kind, const std::vector<Sums>& all, std::vector<Report::Condition>& conditions) const
{
  for (std::size_t number = 0; number < all.size(); ++number)
  {
    const Sums& sums = all[number];
    Report::Condition condition;
    condition.name = nameOfEntry(kind, number, this->groupOf(conditions.size()));
    condition.vertices = static_cast<std::int64_t>(sums.vertices);
    condition.area = sums.area;
    condition.flux = sums.flux;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      condition.mean.push_back(sums.area > 0.0       ? sums.value[k] / sums.area
                               : sums.vertices > 0.0 ? sums.vertexValue[k] / sums.vertices
                                                     : std::numeric_limits<double>::quiet_NaN());
    }
    conditions.push_back(std::move(condition));
  }
}

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
  , Residual(this->Columns)
  , Mean(this->Columns)
  , Source(this->Columns)
  , Screening(this->Columns)
  , ScreeningEnergy(this->Columns)
  , CellEnergy(this->Columns)
  , LeftOut(this->Columns)
{
  if (const auto couplings = problem.couplings())
  {
    this->Contacts = couplings->contacts;
    for (const VertexCouplings::Contact& contact : this->Contacts)
    {
      const std::vector<double> zeros(this->Columns);
      this->OfContacts.push_back({ contact.name, 0.0, zeros, zeros });
    }
  }
  // Extremes begin with values that every number replaces; the vertex stays -1 if there is none.
  constexpr double Far = std::numeric_limits<double>::infinity();
  this->minimum.assign(this->Columns, { Far, -1 });
  this->maximum.assign(this->Columns, { -Far, -1 });
}

/** Adds a vertex to all sums, unless nothing determines its value. */
void ResultSums::add(VertexTerms terms, const double* u, std::int32_t dirichlet, std::int32_t label)
{
  if (isUndetermined(u))
  {
    return;
  }
  this->Mass += terms.mass();
  BodyFlows& bodies = this->conditions.bodies;
  bodies.screen(label, terms.screening());
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double source = terms.source(k);
    const double screening = terms.screening() * u[k];
    this->Mean[k] += terms.mass() * u[k];
    this->Source[k] += source;
    this->Screening[k] += screening;
    this->ScreeningEnergy[k] += 0.5 * screening * u[k];
    BodyFlows::Sums& body = bodies.of(label, k);
    body.all += std::fabs(source) + std::fabs(screening);
    body.given += std::fabs(source) + std::fabs(screening);
    body.energy += 0.5 * screening * u[k];
    body.include(u[k]);
  }
  this->addResidual(terms, u, dirichlet, label);
}

void ResultSums::addContact(const VertexCouplings::Link& link, std::span<const double> flow)
{
  if (link.contact < 0)
  {
    return;
  }
  const auto contact = static_cast<std::size_t>(link.contact);
  Report::Contact& sums = this->OfContacts[contact];
  sums.area += link.conductance / this->Contacts[contact].coefficient;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    sums.flow[k] += std::fabs(flow[k]);
  }
}

/** Adds the residual ((L + S) u - F)_i of a vertex, of a prescribed one as the reaction of its
 * condition: edges within that are left out, since what they carry cancels in the sum over its
 * vertices. */
void ResultSums::addResidual(
  VertexTerms terms, const double* u, std::int32_t dirichlet, std::int32_t label)
{
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double residual = (terms.screening() + terms.transfer()) * u[k] -
                            (terms.source(k) + terms.inflow(k)) + terms.outflow(k);
    this->Residual[k] = residual;
    if (dirichlet >= 0)
    {
      this->conditions.bodies.of(label, k).terms += terms.outflowTerms(k);
      continue;
    }
    const double weights = terms.weights() + terms.screening() + terms.transfer();
    this->conditions.bodies.of(label, k).addResidual(residual, weights, u[k]);
  }
  if (dirichlet >= 0)
  {
    this->conditions.add(dirichlet, u, this->Residual.data(), label);
  }
}

/** The cells have been summed on their own, over all blocks. */
void ResultSums::setCells(const CellResults& cells)
{
  this->CellEnergy = cells.energy();
  this->LeftOut = cells.leftOut();
  this->Parts = cells.parts();
  this->Integrals = cells.integrals();
  this->IntegralNames = cells.integrated().names;
}

/** The order is the same in all processes, which add these numbers. */
ResultSums::Numbers ResultSums::numbers()
{
  Numbers numbers{ { &this->Mass }, {} };
  std::vector<double*>& all = numbers.sums;
  const auto append = [&all](std::vector<double>& sums)
  { std::ranges::transform(sums, std::back_inserter(all), [](double& sum) { return &sum; }); };
  for (auto* sums : { &this->Mean, &this->Source, &this->Screening, &this->ScreeningEnergy,
         &this->CellEnergy, &this->LeftOut })
  {
    append(*sums);
  }
  const auto appendPart = [&](PartSums& part)
  {
    all.push_back(&part.measure);
    append(part.gradient);
    append(part.flux);
  };
  std::ranges::for_each(this->Parts, appendPart);
  for (IntegralSums& integral : this->Integrals)
  {
    appendPart(integral.part);
    append(integral.value);
  }
  this->conditions.appendNumbers(all);
  this->conditions.bodies.appendNumbers(all, numbers.least);
  return numbers;
}

/** The energy includes the term of screening, 1/2 s u^2. Means are weighted by mass. */
void ResultSums::finish(Report& report, bool hasRest) const
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
  this->reportBalance(report, hasRest);
  this->reportParts(report);
  this->reportIntegrals(report);
  report.contacts = this->OfContacts;
  for (std::size_t k = 0; k < report.contacts.size(); ++k)
  {
    Report::Contact& contact = report.contacts[k];
    const double conductance = this->Contacts[k].coefficient * contact.area;
    std::ranges::transform(
      contact.flow, contact.step.begin(), [=](double flow) { return flow / conductance; });
  }
  noteConditionsWithoutEffect(report);
  this->noteFlatCells(report);
}

/** A condition without effect is most likely a mistake in the description. */
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

/** The whole first; parts if there are several. */
void ResultSums::reportParts(Report& report) const
{
  const auto add = [&report](const std::string& name, const PartSums& sums)
  {
    Report::Part& part = report.parts.emplace_back();
    part = { name, sums.measure, sums.gradient, sums.flux };
    for (auto* means : { &part.gradient, &part.flux })
    {
      std::ranges::for_each(*means, [&sums](double& number) { number /= sums.measure; });
    }
  };
  if (this->Parts.empty())
  {
    return;
  }
  PartSums all = this->Parts.front();
  for (std::size_t p = 1; p < this->Parts.size(); ++p)
  {
    all.measure += this->Parts[p].measure;
    for (std::size_t e = 0; e < all.gradient.size(); ++e)
    {
      all.gradient[e] += this->Parts[p].gradient[e];
      all.flux[e] += this->Parts[p].flux[e];
    }
  }
  add("all", all);
  const std::size_t last = this->Parts.size() - 1;
  for (std::size_t p = 0; p < this->Parts.size(); ++p)
  {
    if (this->Parts[p].measure > 0.0 && this->Parts[p].measure < all.measure)
    {
      add(p == last ? "elsewhere" : nameOfEntry("conductivity", p, this->conditions.groupOfPart(p)),
        this->Parts[p]);
    }
  }
  if (last > 0 && this->Parts[last].measure > 0.0)
  {
    report.notes.push_back("the conductivity is 1 in " +
                           percent(this->Parts[last].measure / all.measure) +
                           " % of the mesh, where none of its entries holds");
  }
}

void ResultSums::reportIntegrals(Report& report) const
{
  for (std::size_t k = 0; k < this->Integrals.size(); ++k)
  {
    const auto& [part, value] = this->Integrals[k];
    std::vector<double> mean = value;
    // Not a number without a measure.
    std::ranges::for_each(mean, [measure = part.measure](double& number) { number /= measure; });
    report.integrals.push_back(
      { this->IntegralNames[k], part.measure, value, std::move(mean), part.gradient, part.flux });
    if (part.measure == 0.0)
    {
      report.warn("integrals: the group " + this->IntegralNames[k] + " has no area or volume");
    }
  }
}

/** The balance of each column: what flows in through conditions and sources, minus what screening
 * takes, relative to all that flows. */
void ResultSums::reportBalance(Report& report, bool hasRest) const
{
  KnownFluxes known(this->conditions.bodies, report, hasRest);
  double largest = 0.0;
  report.source = this->Source;
  report.screening = this->Screening;
  report.balance.assign(this->Columns, 0.0);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    // What the solve has subtracted from sources of components without a condition.
    if (!report.removed_source.empty())
    {
      report.source[k] -= report.removed_source[k];
    }
    const KnownFluxes::Column column = known.judge(k);
    if (column.all <= 0.0)
    {
      continue; // a quotient of rounding errors
    }
    if (column.isLost)
    {
      report.balance[k] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const double rest = this->conditions.inflow()[k] + report.source[k] - report.screening[k];
    report.balance[k] = rest / column.all;
    largest = std::max(largest, std::fabs(report.balance[k]));
  }
  known.warn(largest);
}

/** Notes a bound of the error due to cells that were scaled down (flatnessFactor()). With the
 * energy products a of finite elements and d of what was omitted of them, the solution u_h differs
 * from the finite-element solution u by a(u - u_h, v) = d(u_h, v) <= sqrt(d(u_h, u_h) a(v, v)) for
 * all v. */
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
