// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ProblemResults.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>

// Derived results of a solution in one further reading of the mesh. The matrix is not kept by a
// solve; what the results need of it is computed again, in the same way as in the assembly, from
// the same data of the problem: loads of all vertices, and the weights of edges that lead from
// prescribed vertices out of their condition. The windows are the same as in the assembly, without
// rows.

namespace smg
{
namespace
{

constexpr PoolUse ResultMemory{ "reading the results",
  "raise the memory limit, or convert the mesh with the order bfs if it has another" };

/** For Problems that have not checked the names. */
IntegratedParts integratedParts(const std::vector<std::string>& wanted, const MeshGroups& groups)
{
  return { wanted, groups, [](const std::string& key, const std::string& sentence) {
            throw Error(key + ": " + sentence + '.');
          } };
}

} // namespace

ProblemResults::ProblemResults(
  const StreamInfo& info, Problem& problem, Solution& solution, const ResultOptions& options)
  : Type(info.cellType)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Kind(problem.weights())
  , Check(info.cellType)
  , Memory(options.memoryLimit, ResultMemory)
  , Vertices(this->Memory, problem, &solution)
  , Reach(this->Memory)
  , Flows(this->Memory, problem.columns() + 1)
  , Weighted(info.cellType, problem,
      options.flux || problem.conditionCounts().parts > 0 || !options.integrals.empty())
  , Facets(this->Memory, problem, info.cellType, this->Vertices)
  , Parts(1, &this->Memory)
  , Labels(this->Memory, this->Parts, BodyFlows::mostLabels(problem.columns()))
  , Edges(this->Memory, problem, info.cellType)
  , Cells(info.cellType, problem.columns(), options.gradient, options.flux,
      problem.conditionCounts().parts, integratedParts(options.integrals, info.groups))
  , Gradients(this->Memory, 3 * problem.columns() + 1)
  , Sums(info.cellType, problem)
  , Steps(4 * this->Columns)
  , Sources(this->Columns)
  , Terms(VertexTerms::size(this->Columns))
{
  // A solution of another problem would give plausible numbers without meaning.
  if (problem.columns() != solution.columns())
  {
    throw Error(
      "the solution has another number of columns than the problem and does not belong to it");
  }
  if (problem.hasEdgeTargets())
  {
    throw Error("the results of a problem with edge targets have no fluxes that balance");
  }
  if (problem.hasCells() || this->Vertices.ties.anyJump())
  {
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
  this->addBlock(block);
  this->finalize(block.finalized);
}

void ProblemResults::addPart(const MeshBlock& block)
{
  this->IsPart = true;
  this->addBlock(block);
}

void ProblemResults::addBlock(const MeshBlock& block)
{
  this->addVertices(block);
  this->addCells(block);
  this->Facets.add(block);
}

void ProblemResults::addVertices(const MeshBlock& block)
{
  const std::int64_t begin = this->Vertices.end();
  this->Vertices.add(block);
  const std::int64_t end = this->Vertices.end();
  this->Facets.extend(end);
  this->Edges.extend(end);
  this->Flows.extend(end);
  if (this->VertexGradients)
  {
    this->Gradients.extend(end);
  }
  this->Labels.extend(end);
  for (auto* loads : { &this->CellLoads, &this->FacetLoads })
  {
    if (*loads)
    {
      (*loads)->extend(end);
    }
  }
  const std::span<const double> solution = this->Vertices.values.range(begin, end);
  this->Values.assign(solution.begin(), solution.end());
  for (std::size_t e = 0; e < this->Values.size(); ++e)
  {
    // Extremes of all vertices, in stream order: of equal ones the first remains.
    this->Sums.compare(
      e % this->Columns, this->Values[e], begin + static_cast<std::int64_t>(e / this->Columns));
  }
}

void ProblemResults::addCells(const MeshBlock& block)
{
  this->Cells.begin(block);
  this->Weighted.forEach(
    block, this->Vertices, [this](const WeightedCell& cell) { this->addCell(cell); });
}

/** Adds a cell as the assembly does: the same cells have no weight, and the same ones connect their
 * corners. */
void ProblemResults::addCell(const WeightedCell& cell)
{
  if (!cell.connects)
  {
    return;
  }
  const int count = cornersOf(this->Type);
  this->Labels.join(cell.nodes, count);
  if (cell.weights.measure == 0.0)
  {
    this->connect(cell);
    return;
  }
  const double* values[4] = {};
  for (int k = 0; k < count; ++k)
  {
    values[k] = this->Vertices.values.at(cell.corners[k]);
    this->Vertices.mass[cell.corners[k]] += cell.weights.measure / count;
  }
  this->Cells.integrate(cell, values);
  this->relateToFirst(cell.corners, values);
  this->Cells.add(cell, values);
  if (this->VertexGradients)
  {
    this->addGradient(cell);
  }
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->Sums.conditions.bodies.of(this->bodyOf(cell.nodes[0]), k).energy +=
      this->Cells.energyOfCell()[k];
  }
  if (this->CellLoads)
  {
    this->CellLoads->add(cell);
  }
  // The energy has been computed with the full weights; edges get the weights of the solve.
  if (this->Kind == Weights::Cotangent)
  {
    this->addFlows(cell, values);
  }
  this->connect(cell);
}

/** Each corner has the same share of the cell. */
void ProblemResults::addGradient(const WeightedCell& cell)
{
  const std::size_t numbers = 3 * this->Columns;
  const std::span<const double> gradient =
    this->Cells.gradient().subspan(cell.number * numbers, numbers);
  const int count = cornersOf(this->Type);
  for (int c = 0; c < count; ++c)
  {
    double* sums = this->Gradients.at(cell.corners[c]);
    for (std::size_t k = 0; k < numbers; ++k)
    {
      sums[k] += cell.weights.measure / count * gradient[k];
    }
    sums[numbers] += cell.weights.measure / count;
  }
}

/** Only differences within a cell matter for its results: those to its first corner have all
 * digits of the solution. */
void ProblemResults::relateToFirst(const std::int64_t* corners, const double** values)
{
  for (int c = 0; this->Vertices.hasRest() && c < cornersOf(this->Type); ++c)
  {
    double* steps = this->Steps.data() + static_cast<std::size_t>(c) * this->Columns;
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      steps[k] = this->Vertices.difference(corners[c], corners[0], k);
    }
    values[c] = steps;
  }
}

/** Collects the weights, as in the solve, of the edges that carry a flow out of a condition. Most
 * cells have no such edge, which the comparison of their corners shows at once. What flows along
 * others is a sum over the cells, unless the weights of edges are no sums. */
void ProblemResults::connect(const WeightedCell& cell)
{
  const bool areSums = this->Kind == Weights::Cotangent;
  const Ring<std::int32_t>& dirichlet = this->Vertices.dirichlet;
  const std::int32_t first = dirichlet[cell.corners[0]];
  bool same = areSums;
  for (int k = 1; k < cornersOf(this->Type); ++k)
  {
    same = same && dirichlet[cell.corners[k]] == first;
  }
  if (!same)
  {
    this->Edges.add(cell.nodes, cell.points, cell.stiffness(), cell.scale,
      [&](std::int64_t a, std::int64_t b)
      { return a != b && (!areSums || dirichlet[a] != dirichlet[b]); });
  }
}

/** Adds what flows along the edges of a cell to the residuals of its nodes, whose corners have
 * these values, and the magnitudes of its weights. What flows because of jumps is a load. */
void ProblemResults::addFlows(const WeightedCell& cell, const double* const* values)
{
  const int count = cornersOf(this->Type), edges = edgesOf(this->Type);
  const CellWeights stiffness = cell.stiffness();
  double weights[4] = {};
  for (int e = 0; e < edges; ++e)
  {
    const int* ends = edgeCorners(this->Type, e);
    weights[ends[0]] += std::fabs(stiffness.weight[e]);
    weights[ends[1]] += std::fabs(stiffness.weight[e]);
  }
  double* flows[4] = {};
  for (int c = 0; c < count; ++c)
  {
    flows[c] = this->Flows.at(cell.nodes[c]);
    flows[c][this->Columns] += weights[c];
  }
  const auto jump = [&](int c, std::size_t k) { return cell.jumps[c] ? cell.jumps[c][k] : 0.0; };
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    double sums[4] = {};
    for (int e = 0; e < edges; ++e)
    {
      const int* ends = edgeCorners(this->Type, e);
      const double step =
        (values[ends[0]][k] - values[ends[1]][k]) - (jump(ends[0], k) - jump(ends[1], k));
      const double flow = stiffness.weight[e] * step;
      sums[ends[0]] += flow;
      sums[ends[1]] -= flow;
    }
    for (int c = 0; c < count; ++c)
    {
      flows[c][k] += sums[c];
    }
  }
}

/** Completes the vertices below `final` that need not wait, in ascending order, which fixes the
 * order of all sums, and releases what no later one needs. */
void ProblemResults::finalize(std::int64_t final)
{
  const std::int64_t end = this->Vertices.ties.closable(final);
  for (; this->Final < end; ++this->Final)
  {
    if (this->VertexGradients)
    {
      this->closeGradient(this->Final);
    }
    this->close(this->Final, this->Terms.data());
    this->Sums.add(VertexTerms(this->Terms.data()), this->Vertices.values.at(this->Final),
      this->Vertices.dirichlet[this->Final], this->bodyOf(this->Final));
  }
  this->Vertices.release(this->Reach.advance(this->Final), this->Final);
  for (auto* loads : { &this->CellLoads, &this->FacetLoads })
  {
    if (*loads)
    {
      (*loads)->release(this->Final);
    }
  }
  this->Flows.release(this->Final);
  this->Gradients.release(this->Final);
  this->Labels.release(this->Final);
  this->Facets.release(this->Final);
  this->Edges.release(this->Final);
}

/** Without a cell that has area or volume, nothing determines the gradient: not a number. */
void ProblemResults::closeGradient(std::int64_t i)
{
  // Its own cells count, not those of vertices that are one unknown with it.
  const std::span<double> gradient = this->Gradients.range(i, i + 1).first(3 * this->Columns);
  const double mass = this->Gradients.at(i)[3 * this->Columns];
  std::ranges::for_each(gradient, [mass](double& sum) { sum /= mass; });
  this->VertexGradients->append(gradient);
}

/** Adds the boundary facets whose lowest corner is i to their corners and conditions. */
void ProblemResults::addBoundary(std::int64_t i)
{
  this->Facets.take(i,
    [this](const BoundaryFacet& facet, double area)
    {
      if (this->FacetLoads)
      {
        this->FacetLoads->add(facet, area, this->Vertices, VertexLoads::Of::Problem);
      }
      this->Sums.conditions.add(facet, area, this->Vertices, this->bodyOf(facet.corners[0]));
    });
}

/** Adds what flows through the links of a vertex to higher ones, or keeps the link for a prescribed
 * end. */
void ProblemResults::addLinks(std::int64_t i)
{
  this->Vertices.ties.forLinks(i,
    [&](const VertexCouplings::Link& link)
    {
      const std::int64_t ends[] = { i, link.to };
      this->Labels.join(ends, 2);
      const Ring<std::int32_t>& dirichlet = this->Vertices.dirichlet;
      if (dirichlet[i] != dirichlet[link.to])
      {
        this->Edges.addLink(i, link.to, link.conductance);
      }
      double* const flows[] = { this->Flows.at(i), this->Flows.at(link.to) };
      for (std::size_t k = 0; k < this->Columns; ++k)
      {
        const double flow = link.conductance * this->Vertices.difference(i, link.to, k);
        flows[0][k] += flow;
        flows[1][k] -= flow;
        this->Steps[k] = flow;
      }
      flows[0][this->Columns] += link.conductance;
      flows[1][this->Columns] += link.conductance;
      this->Sums.addContact(link, std::span(this->Steps).first(this->Columns));
    });
}

/** Sets the terms of the next vertex, which has all of its data. */
void ProblemResults::close(std::int64_t i, double* numbers)
{
  this->addBoundary(i);
  this->addLinks(i);
  VertexTerms terms(numbers);
  terms.mass() = this->Vertices.mass[i];
  terms.screening() = this->Vertices.sumDensities(i, this->Sources) +
                      (this->CellLoads ? this->CellLoads->rowSum(i) : 0.0);
  terms.transfer() = this->FacetLoads ? this->FacetLoads->rowSum(i) : 0.0;
  terms.weights() = 0.0;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    terms.source(k) = this->Sources[k] + (this->CellLoads ? this->CellLoads->load(i)[k] : 0.0);
    terms.inflow(k) = this->FacetLoads ? this->FacetLoads->load(i)[k] : 0.0;
    terms.outflow(k) = terms.outflowTerms(k) = 0.0;
  }
  // As a rule only edges out of a condition are stored, so most vertices have none.
  this->Neighbours.clear();
  this->Edges.take(i, this->Vertices.points, this->Neighbours);
  this->Reach.close(i, this->Neighbours.empty() ? i : std::max(i, this->Neighbours.back().to));
  if (this->Vertices.dirichlet[i] >= 0 || this->Kind != Weights::Cotangent)
  {
    this->addEdges(i, terms);
    return;
  }
  terms.weights() = this->Flows.at(i)[this->Columns];
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    terms.outflow(k) = this->Flows.at(i)[k];
  }
}

/** Adds what flows along the edges of a vertex, by the weights of the matrix; of a prescribed one
 * along those that lead out of its condition. */
void ProblemResults::addEdges(std::int64_t i, VertexTerms terms)
{
  const double* u = this->Vertices.values.at(i);
  const std::int32_t condition = this->Vertices.dirichlet[i];
  for (const RowNeighbour& neighbour : this->Neighbours)
  {
    if (condition >= 0 && this->Vertices.dirichlet[neighbour.to] == condition)
    {
      continue;
    }
    const double weight = knownWeight(this->Kind, neighbour);
    const double* other = this->Vertices.values.at(neighbour.to);
    terms.weights() += std::fabs(weight);
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      terms.outflow(k) += weight * this->Vertices.difference(i, neighbour.to, k);
      terms.outflowTerms(k) += std::fabs(weight) * (std::fabs(u[k]) + std::fabs(other[k]));
    }
  }
}

/** All vertices of a part at once: the terms of other parts are added before they become
 * results. */
std::vector<double> ProblemResults::takeTerms()
{
  const std::size_t each = this->Terms.size();
  std::vector<double> all(static_cast<std::size_t>(this->Vertices.end()) * each);
  for (; this->Final < this->Vertices.end(); ++this->Final)
  {
    this->close(this->Final, all.data() + static_cast<std::size_t>(this->Final) * each);
  }
  this->Sums.setCells(this->Cells);
  return all;
}

void ProblemResults::finish(Report& report)
{
  this->finalize(this->Vertices.end());
  this->Sums.setCells(this->Cells);
  this->Sums.conditions.bodies.settle(this->Parts);
  this->Sums.finish(report, this->Vertices.hasRest());
}

} // namespace smg
