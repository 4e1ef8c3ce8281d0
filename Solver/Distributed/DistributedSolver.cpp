// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DistributedSolver.h"

#include "Solver/Core/Progress.h"
#include "Solver/Core/Timer.h"
#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/ConjugateGradients.h"
#include "Solver/Distributed/GatheredSolution.h"
#include "Solver/Distributed/PartAssembly.h"
#include "Solver/Distributed/PartMemory.h"
#include "Solver/Distributed/PartResults.h"
#include "Solver/Distributed/PartSource.h"
#include "Solver/Distributed/PartsOfMesh.h"
#include "Solver/Distributed/SharedCells.h"
#include "Solver/Engine/FreeComponents.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace smg
{
namespace
{

void checkOptions(const DistributedOptions& options, const Problem& problem)
{
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0))
  {
    throw Error("the tolerance must lie between 0 and 1, both excluded");
  }
  if (options.maxIterations < 1)
  {
    throw Error("at least one iteration must be allowed");
  }
  if (options.memoryLimit <= 0)
  {
    throw Error("the memory limit must be positive");
  }
  if (problem.columns() < 1)
  {
    throw Error("a problem needs at least one column");
  }
  if (problem.hasEdgeTargets())
  {
    throw Error("the distributed engine has no edge targets: use the streaming engine");
  }
}

} // namespace

struct DistributedSolver::Implementation
{
  Implementation(MPI_Comm communicator, const MeshPart& meshPart)
    : team(communicator)
    , part(meshPart)
  {
    this->team.run(
      [this]
      {
        checkPart(this->part);
        this->vertices.emplace(this->team, this->part);
      });
  }

  DistributedSolution solve(Problem& problem, const DistributedOptions& options);
  void iterate(PartSystem& system, const DistributedOptions& options, Report& report);
  void fixMeans(PartSystem& system, int columns, Report& report) const;
  void complete(const Timer& wall, double cpuAtStart, Report& report);

  Team team;
  const MeshPart& part;
  std::optional<SharedVertices> vertices;
};

DistributedSolution DistributedSolver::Implementation::solve(
  Problem& problem, const DistributedOptions& options)
{
  const Timer wall;
  const double cpuAtStart = processSeconds();
  checkOptions(options, problem);
  checkPartMemory(this->vertices->vertices(),
    static_cast<std::int64_t>(this->part.block.corners.size()) /
      cornersOf(this->part.info.cellType),
    problem.columns(), options.memoryLimit);
  DistributedSolution solution;
  solution.columns = problem.columns();
  Report& report = solution.report;
  PartSystem system;
  {
    Pool pool(options.memoryLimit,
      { "the assembly of a part of the mesh", "raise the memory limit, or use more processes" });
    system = PartAssembly(pool, *this->vertices, this->part, problem).assemble();
    report.pool_bytes_peak = pool.peak();
  }
  reportAssembly(system.counts, report);
  if (report.vertices == 0)
  {
    throw Error("the mesh has no vertices");
  }
  report.levels = { { system.unknowns, system.nonzeros } };
  if (const double share = system.components->incompatibility(); share > 0.0)
  {
    report.removed_source = system.components->shiftedSums();
    report.notes.push_back(incompatibilityNote(share));
  }
  report.seconds.build = wall.seconds();
  this->iterate(system, options, report);
  this->fixMeans(system, solution.columns, report);
  addAssemblyNotes(report);

  const auto columns = static_cast<std::size_t>(solution.columns);
  solution.values.resize(static_cast<std::size_t>(this->vertices->vertices()) * columns);
  double* own = solution.values.data() + this->vertices->begin() * solution.columns;
  for (std::size_t k = 0; k < system.mass.size(); ++k)
  {
    for (std::size_t c = 0; c < columns; ++c)
    {
      *own++ = system.x[c][k];
    }
  }
  this->vertices->copyFromOwners(std::span(solution.values), solution.columns);
  this->complete(wall, cpuAtStart, report);
  return solution;
}

/** Solves for one column after the other. */
void DistributedSolver::Implementation::iterate(
  PartSystem& system, const DistributedOptions& options, Report& report)
{
  const HypreRows rows(this->part.firstOwned, this->part.endOwned, this->part.info.vertices);
  ConjugateGradients method(this->team, rows, *system.matrix);
  Progress progress(this->team.rank() == 0 ? options.progress : ProgressFunction());
  const auto columns = system.x.size();
  report.converged = true;
  Report::Distributed distributed;
  distributed.processes = this->team.size();
  for (std::size_t c = 0; c < columns; ++c)
  {
    const std::span<const double> residual = method.residual(system.b[c], system.x[c]);
    double squares = 0.0;
    for (std::size_t k = 0; k < residual.size(); ++k)
    {
      squares += system.share[k] * system.share[k] * residual[k] * residual[k];
    }
    this->team.sum({ &squares, 1 });
    Convergence convergence({ options.tolerance, options.maxIterations },
      { std::sqrt(squares), roundingOf(system.termSquares[c]) });
    const auto iterated = [&]
    {
      const double done =
        convergence.done() ? 1.0
                           : std::log(convergence.residuals().back()) / std::log(options.tolerance);
      progress.update(
        (static_cast<double>(c) + std::clamp(done, 0.0, 1.0)) / static_cast<double>(columns));
    };
    method.solve(system.b[c], system.x[c], convergence, iterated);
    report.residuals.insert(
      report.residuals.end(), convergence.residuals().begin(), convergence.residuals().end());
    report.cycles += convergence.cycles();
    report.converged = report.converged && convergence.converged();
    distributed.iterations.push_back(convergence.cycles());
    convergence.addNotes(
      report.notes, columns == 1 ? "" : "right-hand side " + std::to_string(c) + ": ");
  }
  report.acceleration = "cg";
  report.distributed = distributed;
}

/** Components without constraint keep the mean of their initial values. */
void DistributedSolver::Implementation::fixMeans(
  PartSystem& system, int columns, Report& report) const
{
  if (report.free_components == 0)
  {
    return;
  }
  SharedComponents& components = *system.components;
  const auto weight = [&](std::int64_t k, const SharedComponents::Place& place)
  { return place.components->weightOf(place.label, system.mass[static_cast<std::size_t>(k)]); };
  const auto value = [&](std::int64_t k, int c) -> double&
  { return system.x[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)]; };
  const SharedComponents::Shifts shifts = components.meanShifts(
    [&](std::int64_t k, int c) { return weight(k, components.of(k)) * value(k, c); });
  for (std::int64_t k = 0; k < static_cast<std::int64_t>(system.mass.size()); ++k)
  {
    const SharedComponents::Place place = components.of(k);
    for (int c = 0; place.components && c < columns; ++c)
    {
      value(k, c) -= shifts(place, columns, c);
    }
  }
  report.notes.push_back(freeComponentsNote(report.free_components, report.components));
}

/** Adds what the solve cost. */
void DistributedSolver::Implementation::complete(
  const Timer& wall, double cpuAtStart, Report& report)
{
  report.seconds.total = wall.seconds();
  report.seconds.solve = report.seconds.total - report.seconds.build;
  report.cpu_seconds = processSeconds() - cpuAtStart;
  this->team.sum({ &report.cpu_seconds, 1 });
  Report::Distributed& costs = *report.distributed;
  costs.rss_bytes_peak = this->team.gather(std::vector<std::int64_t>{ peakResidentBytes() });
  costs.pool_bytes_peak = this->team.gather(std::vector<std::int64_t>{ report.pool_bytes_peak });
  report.rss_bytes_peak = *std::ranges::max_element(costs.rss_bytes_peak);
  report.pool_bytes_peak = *std::ranges::max_element(costs.pool_bytes_peak);
}

DistributedSolver::DistributedSolver(MPI_Comm communicator, const MeshPart& part)
  : Self(std::make_unique<Implementation>(communicator, part))
{
}

DistributedSolver::~DistributedSolver() = default;

void DistributedSolver::prepare(DescribedProblem& problem, const std::filesystem::path& scratch)
{
  Implementation& self = *this->Self;
  self.team.run(
    [&]
    {
      PartSource source(self.part);
      problem.preparePart(source, scratch);
      PartsOfMesh parts(*self.vertices, self.part.info.cellType);
      problem.endPreparing(parts);
    });
}

DistributedSolution DistributedSolver::solve(Problem& problem, const DistributedOptions& options)
{
  DistributedSolution solution;
  this->Self->team.run([&] { solution = this->Self->solve(problem, options); });
  return solution;
}

void DistributedSolver::evaluate(
  Problem& problem, DistributedSolution& solution, const ResultOptions& options)
{
  Implementation& self = *this->Self;
  self.team.run([&] { evaluatePart(*self.vertices, self.part, problem, options, solution); });
}

void DistributedSolver::gather(
  const DistributedSolution& solution, const std::function<void(Solution&)>& use)
{
  this->Self->team.run([&] { gatherSolution(*this->Self->vertices, solution, use); });
}

void DistributedSolver::checkCells()
{
  this->Self->team.run(
    [this]
    {
      const std::int64_t repeated = repeatedCells(*this->Self->vertices, this->Self->part);
      if (repeated > 0)
      {
        throw Error(std::to_string(repeated) + (repeated == 1 ? " cell belongs" : " cells belong") +
                    " to several processes without a mark as ghost cells, and would count several "
                    "times: assign each cell to one process, or mark the others.");
      }
    });
}

void DistributedSolver::together(const std::function<void()>& work)
{
  this->Self->team.run(work);
}

} // namespace smg
