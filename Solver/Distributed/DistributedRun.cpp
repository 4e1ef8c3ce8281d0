// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/DistributedRun.h"

#include "Solver/Distributed/PartMemory.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

// One or more solves with the same matrix, on all processes: assembly, set-up of the preconditioner
// for the first one, conjugate gradients for each right-hand side, what the equations leave open,
// and the report.
//
// The course depends only on what all processes know alike: options (compared at the beginning),
// and norms and counts that are sums over the processes. Otherwise one would stop while others wait
// for it.

namespace smg
{
namespace
{

/** Checks what the options say for themselves; that they are the same on all processes is checked
 * later. */
void checkOptions(const DistributedOptions& options)
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
}

} // namespace

DistributedRun::DistributedRun(const SharedVertices& vertices, const MeshPart& part,
  const DistributedOptions& options, int columns)
  : Vertices(vertices)
  , Processes(vertices.team())
  , Part(part)
  , Options(options)
  , CpuAtStart(processSeconds())
  , Rows(part.firstOwned, part.endOwned, part.info.vertices)
  , Done(vertices.team().rank() == 0 ? options.progress : ProgressFunction())
{
  checkOptions(options);
  const auto corners = static_cast<std::int64_t>(part.block.corners.size());
  // hypre allocates without a limit, so the estimate is compared with the limit before anything is
  // built.
  checkPartMemory(
    vertices.vertices(), corners / cornersOf(part.info.cellType), columns, options.memoryLimit);
  this->Costs.processes = this->Processes.size();
  this->report.acceleration = "cg";
  this->report.converged = true;
}

void DistributedRun::assemble(Problem& problem)
{
  if (problem.columns() < 1)
  {
    throw Error("a problem needs at least one column");
  }
  if (problem.couplings())
  {
    throw Error("coupled vertices are not solved by several processes: use one");
  }
  const Timer wall;
  this->requireSameOptions(problem);
  Report& r = this->report;
  // Method is made by iterate(), so the first assembly is the one before it.
  const bool isFirst = !this->Method;
  Pool pool(this->Options.memoryLimit,
    { "the assembly of a part of the mesh", "raise the memory limit, or use more processes" });
  // The matrix of the problem before, if any, is used as it is: then only right-hand sides are
  // assembled.
  std::unique_ptr<HypreMatrix> matrix = std::move(this->System.matrix);
  this->System = {}; // releases the memory of the problem before
  PartAssembly assembly(pool, this->Vertices, this->Part, problem);
  this->System = assembly.assemble(std::move(matrix));
  this->MeasuresMotion = problem.beginsAtRest();
  r.relative_to = this->MeasuresMotion ? MeshAtRest : BestConstant;
  r.pool_bytes_peak = std::max(r.pool_bytes_peak, pool.peak());
  if (isFirst)
  {
    // Further problems have the same mesh and matrix, hence the same counts.
    reportAssembly(this->System.counts, r);
    if (r.vertices == 0)
    {
      throw Error("the mesh has no vertices");
    }
    r.levels = { { this->System.unknowns, this->System.nonzeros } };
    if (const double share = this->System.components->incompatibility(); share > 0.0)
    {
      r.removed_source = this->System.components->shiftedSums();
      noteIncompatibility(r, share);
    }
  }
  r.seconds.build += wall.seconds();
}

/** Compares what decides when a process stops. Numbers are compared as text, in hexadecimal without
 * rounding. */
void DistributedRun::requireSameOptions(const Problem& problem)
{
  std::ostringstream text;
  text << std::hexfloat << this->Options.tolerance << ' ' << this->Options.maxIterations << ' '
       << problem.columns() << ' ' << static_cast<int>(problem.weights());
  this->Processes.requireSame("tolerance, number of iterations, columns and weights", text.str());
}

Report::Step DistributedRun::iterate(const std::string& what, double begin, double end)
{
  if (!this->Method)
  {
    this->Method.emplace(this->Processes, this->Rows, *this->System.matrix);
    ++this->Costs.setups;
  }
  Report& r = this->report;
  Report::Step step;
  step.converged = true;
  const std::size_t columns = this->System.x.size();
  const double share = (end - begin) / static_cast<double>(columns);
  for (std::size_t c = 0; c < columns; ++c)
  {
    // Each right-hand side converges for itself; notes and residuals say which one they belong to.
    const std::string column = columns == 1 ? "" : "right-hand side " + std::to_string(c) + ": ";
    const double first = begin + static_cast<double>(c) * share;
    const Convergence convergence = this->solveColumn(c, first, first + share);
    const std::vector<double>& residuals = convergence.residuals();
    r.residuals.insert(r.residuals.end(), residuals.begin(), residuals.end());
    this->Costs.iterations.push_back(convergence.cycles());
    convergence.addNotes(r, what + column);
    step.cycles += convergence.cycles();
    // A step is as good as the worst of its right-hand sides. One whose initial values solve it
    // needs no iteration.
    step.residual = std::max(step.residual, residuals.empty() ? 0.0 : residuals.back());
    step.converged = step.converged && convergence.converged();
  }
  r.cycles += step.cycles;
  r.converged = r.converged && step.converged;
  return step;
}

/** Solves for one right-hand side. What the residual is measured against weighs rows by their
 * shares (commonShare()), as in the streaming engine. */
Convergence DistributedRun::solveColumn(std::size_t column, double begin, double end)
{
  ConjugateGradients& method = *this->Method;
  PartSystem& system = this->System;
  const std::span<const double> residual = method.residual(system.b[column], system.x[column]);
  double squares = 0.0;
  for (std::size_t k = 0; k < residual.size(); ++k)
  {
    squares += system.share[k] * system.share[k] * residual[k] * residual[k];
  }
  this->Processes.sum({ &squares, 1 });
  const double tolerance = this->Options.tolerance;
  Convergence convergence({ tolerance, this->Options.maxIterations },
    { std::sqrt(squares), roundingOf(system.roundingSquares[column]),
      this->MeasuresMotion || system.references[column] == 0.0 ? std::sqrt(squares)
                                                               : system.references[column] });
  // The residual decreases about geometrically, so its logarithm says how much is done.
  const auto iterated = [&]
  {
    const double done =
      convergence.done() ? 1.0 : std::log(convergence.residuals().back()) / std::log(tolerance);
    this->Done.update(begin + std::clamp(done, 0.0, 1.0) * (end - begin));
  };
  method.solve(system.b[column], system.x[column], system.share, convergence, iterated);
  return convergence;
}

void DistributedRun::fix(const Problem& problem)
{
  // The means come first: they are sums over values that must be finite.
  this->fixMeans();
  this->LeavesUndetermined = !problem.keepsUndetermined();
  if (!this->LeavesUndetermined)
  {
    return;
  }
  for (std::vector<double>& x : this->System.x)
  {
    for (const std::int64_t k : this->System.undetermined)
    {
      x[static_cast<std::size_t>(k)] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

/** In a component without constraint the solution is determined up to a constant. It gets the mean
 * of the initial values, weighted by masses, as in the streaming engine; one that is held loosely
 * gets its constant. */
void DistributedRun::fixMeans()
{
  PartSystem& system = this->System;
  SharedComponents& components = *system.components;
  if (components.floatingComponents() == 0)
  {
    return;
  }
  const auto columns = static_cast<int>(system.x.size());
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
  if (this->report.free_components > 0)
  {
    noteFreeComponents(this->report);
  }
}

std::vector<double> DistributedRun::values() const
{
  const PartSystem& system = this->System;
  const std::size_t columns = system.x.size();
  std::vector<double> values(static_cast<std::size_t>(this->Vertices.vertices()) * columns);
  // Own vertices are contiguous in the part; all others come from their owners.
  double* own = values.data() + this->Vertices.begin() * static_cast<std::int64_t>(columns);
  for (std::size_t k = 0; k < system.mass.size(); ++k)
  {
    for (std::size_t c = 0; c < columns; ++c)
    {
      *own++ = system.x[c][k];
    }
  }
  this->Vertices.copyFromOwners(std::span(values), static_cast<int>(columns));
  return values;
}

void DistributedRun::finish()
{
  Report& r = this->report;
  addAssemblyNotes(
    r, this->LeavesUndetermined ? UndeterminedValues::NotNumbers : UndeterminedValues::Stay);
  r.seconds.total = this->Wall.seconds();
  Team& team = this->Processes;
  // The slowest process counts; all time that is not assembly is the solve.
  std::array<double, 2> seconds{ r.seconds.build, r.seconds.total };
  team.largest(std::span<double>(seconds));
  r.seconds.build = seconds[0];
  r.seconds.total = seconds[1];
  r.seconds.solve = r.seconds.total - r.seconds.build;
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
  team.sum({ &r.cpu_seconds, 1 });
  // One figure for each process, in the order of the processes; the report's own figure is the
  // largest.
  this->Costs.rss_bytes_peak = team.gather(std::vector<std::int64_t>{ peakResidentBytes() });
  this->Costs.pool_bytes_peak = team.gather(std::vector<std::int64_t>{ r.pool_bytes_peak });
  r.rss_bytes_peak = *std::ranges::max_element(this->Costs.rss_bytes_peak);
  r.pool_bytes_peak = *std::ranges::max_element(this->Costs.pool_bytes_peak);
  r.distributed = this->Costs;
}

} // namespace smg
