// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Results/ProblemResults.h"

#include "Solver/Problem/CommonShare.h"
#include "Solver/Problem/FlatCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

constexpr PoolUse ResultMemory{ "reading the results",
  "raise the memory limit, or convert the mesh with the order bfs" };

} // namespace

ProblemResults::ProblemResults(
  const StreamInfo& info, Problem& problem, Solution& solution, const ResultOptions& options)
  : Type(info.cellType)
  , Given(problem)
  , Solved(solution)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Kind(problem.weights())
  , Check(info.cellType)
  , Memory(options.memoryLimit, ResultMemory)
  , Vertices(this->Memory, problem)
  , Reach(this->Memory)
  , EdgeWeights(this->Memory)
  , Facets(this->Memory, problem, info.cellType, this->Vertices)
  , Edges(this->Memory, problem, info.cellType)
  , Cells(info.cellType, problem.columns(), options.gradient, options.flux)
  , Conditions(info.cellType, problem.conditionCounts(), problem.columns())
  , Load(this->Columns)
  , Reaction(this->Columns)
  , Mean(this->Columns)
  , Source(this->Columns)
  , Screening(this->Columns)
  , ScreeningEnergy(this->Columns)
  , Magnitude(this->Columns)
  , ReactionTerms(this->Columns)
  , RobinTerms(this->Columns)
  , Minimum(this->Columns, { std::numeric_limits<double>::infinity(), -1 })
  , Maximum(this->Columns, { -std::numeric_limits<double>::infinity(), -1 })
{
  if (problem.columns() != solution.columns())
  {
    throw Error(
      "the solution has another number of columns than the problem and does not belong to it");
  }
  if (problem.hasEdgeTargets())
  {
    throw Error("the results of a problem with edge targets have no fluxes that balance");
  }
  if (problem.hasCells())
  {
    this->Own.emplace(problem, this->Type, options.flux);
    this->CellLoads.emplace(this->Memory, this->Type, problem.columns());
  }
  if (problem.hasFacets())
  {
    this->FacetLoads.emplace(this->Memory, this->Type, problem.columns());
  }
}

void ProblemResults::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->addVertices(block);
  this->addCells(block);
  this->Facets.add(block);
  this->finalize(block.finalized);
}

void ProblemResults::addVertices(const MeshBlock& block)
{
  const std::int64_t begin = this->Vertices.end();
  this->Vertices.add(block);
  const std::int64_t end = this->Vertices.end();
  this->Facets.extend(end);
  this->Edges.extend(end);
  if (this->FacetLoads)
  {
    this->EdgeWeights.extend(end);
  }
  for (auto* loads : { &this->CellLoads, &this->FacetLoads })
  {
    if (*loads)
    {
      (*loads)->extend(end);
    }
  }
  this->Values.resize(static_cast<std::size_t>(end - begin) * this->Columns);
  this->Solved.read(begin, end - begin, this->Values);
  std::ranges::copy(this->Values, this->Vertices.values.at(begin));
  for (std::size_t e = 0; e < this->Values.size(); ++e)
  {
    const double value = this->Values[e];
    const std::int64_t vertex = begin + static_cast<std::int64_t>(e / this->Columns);
    Report::Extreme& least = this->Minimum[e % this->Columns];
    Report::Extreme& most = this->Maximum[e % this->Columns];
    least = value < least.value ? Report::Extreme{ value, vertex } : least;
    most = value > most.value ? Report::Extreme{ value, vertex } : most;
  }
}

void ProblemResults::addCells(const MeshBlock& block)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const std::size_t cells = block.corners.size() / corners;
  const Column* flags = block.flags();
  this->Cells.begin(cells);
  for (std::size_t c = 0; c < cells; ++c)
  {
    if (this->Own)
    {
      this->Own->prepare(block, c, this->Vertices.points);
    }
    this->addCell(
      c, block.corners.data() + c * corners, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
  }
}

void ProblemResults::addCell(std::size_t c, const std::int64_t* corners, unsigned flags)
{
  const int count = cornersOf(this->Type);
  const double* points[4] = {};
  const double* values[4] = {};
  for (int k = 0; k < count; ++k)
  {
    points[k] = this->Vertices.points.at(corners[k]);
    values[k] = this->Vertices.values.at(corners[k]);
  }
  const bool repeated = hasRepeatedCorner(corners, count);
  CellWeights cell;
  if (!repeated && flags == 0)
  {
    cell = this->Own ? this->Own->weights() : cellWeights(this->Type, points);
  }
  if (cell.measure == 0.0)
  {
    if (this->Given.connectsFlatCells() && !repeated && (flags & DuplicateCell) == 0)
    {
      this->connect(corners, points, cell);
    }
    return;
  }
  const double flatness = this->Kind != Weights::Cotangent ? 1.0
                          : this->Own                      ? this->Own->flatness()
                                      : flatnessFactor(this->Type, points, cell);
  this->Cells.add(
    c, points, values, cell, flatness, this->Own ? this->Own->conductivity() : nullptr);
  for (int k = 0; k < count; ++k)
  {
    this->Vertices.mass[corners[k]] += cell.measure / count;
  }
  if (this->Own)
  {
    this->CellLoads->add(corners, points, *this->Own);
  }
  if (flatness < 1.0)
  {
    for (double& weight : cell.weight)
    {
      weight *= flatness;
    }
  }
  this->connect(corners, points, cell);
}

/** Collects the weights, as in the solve, of the edges that carry a flux out of a condition. */
void ProblemResults::connect(
  const std::int64_t* corners, const double* const* points, const CellWeights& cell)
{
  if (this->FacetLoads)
  {
    this->weighEdges(corners, cell);
  }
  const Ring<std::int32_t>& dirichlet = this->Vertices.dirichlet;
  const std::int32_t first = dirichlet[corners[0]];
  bool same = true;
  for (int k = 1; k < cornersOf(this->Type); ++k)
  {
    same = same && dirichlet[corners[k]] == first;
  }
  if (!same)
  {
    this->Edges.add(corners, points, cell, this->Own ? this->Own->scale() : 1.0,
      [&](std::int64_t a, std::int64_t b) { return dirichlet[a] != dirichlet[b]; });
  }
}

void ProblemResults::weighEdges(const std::int64_t* corners, const CellWeights& cell)
{
  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    for (const int k : { edgeCorners(this->Type, e)[0], edgeCorners(this->Type, e)[1] })
    {
      this->EdgeWeights[corners[k]] += std::fabs(cell.weight[e]);
    }
  }
}

void ProblemResults::finalize(std::int64_t end)
{
  for (; this->Final < end; ++this->Final)
  {
    this->addBoundary(this->Final);
    this->closeVertex(this->Final);
  }
  this->Vertices.release(this->Reach.advance(this->Final), this->Final);
  for (auto* loads : { &this->CellLoads, &this->FacetLoads })
  {
    if (*loads)
    {
      (*loads)->release(this->Final);
    }
  }
  this->EdgeWeights.release(this->Final);
  this->Facets.release(this->Final);
  this->Edges.release(this->Final);
}

void ProblemResults::addBoundary(std::int64_t i)
{
  this->Facets.take(i,
    [this](const BoundaryFacet& facet)
    {
      const double* points[3] = {};
      for (int k = 0; k < BoundaryFacet::cornersOf(this->Type); ++k)
      {
        points[k] = this->Vertices.points.at(facet.corners[k]);
      }
      const double area = facetArea(this->Type, points);
      if (this->FacetLoads)
      {
        this->FacetLoads->add(facet, area);
      }
      this->Conditions.add(facet, area, this->Vertices);
    });
}

/** Processes a vertex with all its data. */
void ProblemResults::closeVertex(std::int64_t i)
{
  const double mass = this->Vertices.mass[i];
  const double screening =
    this->Vertices.screening[i] * mass + (this->CellLoads ? this->CellLoads->alpha(i) : 0.0);
  const double* u = this->Vertices.values.at(i);
  this->Mass += mass;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double source = mass * this->Vertices.sources.at(i)[k] +
                          (this->CellLoads ? this->CellLoads->load(i)[k] : 0.0);
    this->Load[k] = source + (this->FacetLoads ? this->FacetLoads->load(i)[k] : 0.0);
    this->Mean[k] += mass * u[k];
    this->Source[k] += source;
    this->Screening[k] += screening * u[k];
    this->ScreeningEnergy[k] += 0.5 * screening * u[k] * u[k];
    this->Magnitude[k] += std::fabs(source) + std::fabs(screening * u[k]);
  }
  if (this->FacetLoads)
  {
    const double alpha = this->FacetLoads->alpha(i);
    const double share = commonShare(alpha, this->EdgeWeights[i]);
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      this->RobinTerms[k] +=
        share * (std::fabs(this->FacetLoads->load(i)[k]) + alpha * std::fabs(u[k]));
    }
  }
  this->Neighbours.clear();
  this->Edges.take(i, this->Vertices.points, this->Neighbours);
  this->Reach.close(i, this->Neighbours.empty() ? i : std::max(i, this->Neighbours.back().to));
  if (this->Vertices.dirichlet[i] >= 0)
  {
    this->closeDirichlet(i, screening + (this->FacetLoads ? this->FacetLoads->alpha(i) : 0.0));
  }
}

/** The reaction ((L + S) u - F)_i without the edges within the condition, which cancel. */
void ProblemResults::closeDirichlet(std::int64_t i, double alpha)
{
  const double* u = this->Vertices.values.at(i);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->Reaction[k] = alpha * u[k] - this->Load[k];
    for (const RowNeighbour& neighbour : this->Neighbours)
    {
      const double weight = knownWeight(this->Kind, neighbour);
      const double other = this->Vertices.values.at(neighbour.to)[k];
      this->Reaction[k] += weight * (u[k] - other);
      this->ReactionTerms[k] += std::fabs(weight) * (std::fabs(u[k]) + std::fabs(other));
    }
  }
  this->Conditions.add(this->Vertices.dirichlet[i], u, this->Reaction.data());
}

void ProblemResults::finish(Report& report)
{
  this->finalize(this->Vertices.end());
  report.conditions = this->Conditions.conditions();
  report.energy = this->Cells.energy();
  report.mean = this->Mean;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    report.energy[k] += this->ScreeningEnergy[k];
    report.mean[k] /= this->Mass;
  }
  report.minimum = this->Minimum;
  report.maximum = this->Maximum;
  this->reportBalance(report);
  noteConditionsWithoutEffect(report);
  this->noteFlatCells(report);
}

void ProblemResults::noteConditionsWithoutEffect(Report& report)
{
  for (const Report::Condition& condition : report.conditions)
  {
    const bool isDirichlet = condition.name.starts_with("dirichlet");
    if (isDirichlet && std::isnan(condition.mean.front()))
    {
      report.notes.push_back(condition.name + " has no effect: others hold wherever it does");
    }
    if (condition.area == 0.0 && !isDirichlet)
    {
      report.notes.push_back(
        condition.name + " has no effect: " +
        "no facet of the boundary is where it holds, or later ones hold there");
    }
  }
}

void ProblemResults::reportBalance(Report& report) const
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
    const double rest = this->Conditions.inflow()[k] + report.source[k] - report.screening[k];
    const double all = this->Conditions.magnitude()[k] + this->Magnitude[k];
    const double noise =
      std::max(Rounding * (this->ReactionTerms[k] + this->Conditions.robinTerms()[k]),
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
void ProblemResults::noteFlatCells(Report& report) const
{
  double share = 0.0;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double left = this->Cells.leftOut()[k];
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
