// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ConditionSums.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace smg
{

ConditionSums::ConditionSums(CellType type, const ConditionCounts& counts, int columns)
  : Corners(BoundaryFacet::cornersOf(type))
  , Columns(static_cast<std::size_t>(columns))
  , Inflow(this->Columns)
  , Magnitude(this->Columns)
  , RobinTerms(this->Columns)
{
  const std::vector<double> zeros(this->Columns);
  const Sums none{ 0.0, zeros, zeros, zeros, 0.0 };
  this->Dirichlet.assign(static_cast<std::size_t>(counts.dirichlet), none);
  this->Flux.assign(static_cast<std::size_t>(counts.flux), none);
  this->Robin.assign(static_cast<std::size_t>(counts.robin), none);
}

void ConditionSums::add(const BoundaryFacet& facet, double area, const OpenVertices& vertices)
{
  const double share = area / this->Corners;
  const std::int32_t first = vertices.dirichlet[facet.corners[0]];
  bool same = first >= 0;
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
      const std::int64_t corner = facet.corners[e / this->Columns];
      const double weight = isUndetermined(vertices.values.at(corner)) ? 0.0 : share;
      this->addFlux(sums, e % this->Columns, weight * facet.fluxValue[e]);
    }
  }
  if (facet.robin < 0)
  {
    return;
  }
  Sums& sums = this->Robin[static_cast<std::size_t>(facet.robin)];
  this->addMean(sums, facet, area, vertices);
  for (int c = 0; c < this->Corners; ++c)
  {
    const double* value = vertices.values.at(facet.corners[c]);
    const double factor = isUndetermined(value) ? 0.0 : share * facet.coefficient[c];
    for (std::size_t k = 0; factor > 0.0 && k < this->Columns; ++k)
    {
      const double ambient = facet.ambient[static_cast<std::size_t>(c) * this->Columns + k];
      this->addFlux(sums, k, factor * (ambient - value[k]));
      this->RobinTerms[k] += factor * (std::fabs(ambient) + std::fabs(value[k]));
    }
  }
}

void ConditionSums::add(std::int32_t dirichlet, const double* value, const double* reaction)
{
  Sums& sums = this->Dirichlet[static_cast<std::size_t>(dirichlet)];
  sums.vertices += 1.0;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    sums.vertexValue[k] += value[k];
    this->addFlux(sums, k, reaction[k]);
  }
}

void ConditionSums::addMean(
  Sums& sums, const BoundaryFacet& facet, double area, const OpenVertices& vertices)
{
  const double share = area / this->Corners;
  int determined = 0;
  for (int c = 0; c < this->Corners; ++c)
  {
    const double* value = vertices.values.at(facet.corners[c]);
    determined += isUndetermined(value) ? 0 : 1;
    for (std::size_t k = 0; !isUndetermined(value) && k < this->Columns; ++k)
    {
      sums.value[k] += share * value[k];
    }
  }
  sums.area += determined == this->Corners ? area : share * determined;
}

void ConditionSums::addFlux(Sums& sums, std::size_t column, double flux)
{
  sums.flux[column] += flux;
  this->Inflow[column] += flux;
  this->Magnitude[column] += std::fabs(flux);
}

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
  append(this->Magnitude);
  append(this->RobinTerms);
}

std::vector<Report::Condition> ConditionSums::conditions() const
{
  std::vector<Report::Condition> conditions;
  this->append("dirichlet", this->Dirichlet, conditions);
  this->append("flux", this->Flux, conditions);
  this->append("robin", this->Robin, conditions);
  return conditions;
}

void ConditionSums::append(
  const char* kind, const std::vector<Sums>& all, std::vector<Report::Condition>& conditions) const
{
  for (std::size_t number = 0; number < all.size(); ++number)
  {
    const Sums& sums = all[number];
    Report::Condition condition;
    condition.name = kind + ("[" + std::to_string(number) + "]");
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

} // namespace smg
