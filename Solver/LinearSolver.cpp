// SPDX-License-Identifier: BSD-3-Clause
#include "smg/LinearSolver.h"

#include "Solver/Core/Forks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/LinearEngine.h"
#include "Solver/Multigrid/Extended.h"
#include "smg/DescribedProblem.h"

// The entries for many right-hand sides of one problem: they check the options, and hide the engine
// from the public header.

namespace smg
{
namespace
{

/** The options of a linear solver, which are checked like others. */
SolveOptions linearOptions(SolveOptions options)
{
  // Each call begins with vectors of all vertices.
  options.inCore = true;
  checkOptions(options);
  checkOperators(options);
  return options;
}

/** Those of a system on disk. */
SolveOptions onDiskOptions(SolveOptions options)
{
  refuseCheckpoint(options, "a system on disk has");
  options.inCore = false;
  checkOptions(options);
  checkOperators(options);
  return options;
}

/** Throws Error if vertices are tied: loads and values of all but one of them have no row. */
Problem& untied(Problem& problem)
{
  const auto couplings = problem.couplings();
  require(!couplings || couplings->ties.empty(),
    "a linear solver has an equation for each vertex: it takes no problem with vertices that are "
    "one, as those of periodic sides and of contacts without resistance are");
  return problem;
}

/** An engine of this process. */
class OwnEngine
{
public:
  OwnEngine(MeshSource& mesh, Problem& problem, const SolveOptions& options)
    : Engine(compiled(Extended::forCells(mesh.info().cellType)), problem.columns(), options)
  {
    this->Engine.build(mesh, untied(problem));
  }

  const LinearEngine& engine() const { return this->Engine; }
  /** The engine to compute with. Throws Error in a forked child. */
  LinearEngine& ownEngine()
  {
    this->Process.require("a linear solver");
    return this->Engine;
  }

private:
  LinearEngine Engine;
  OwnProcess Process;
};

/** For a problem that is described. */
template <class Implementation>
std::unique_ptr<Implementation> described(const StoredMesh& mesh, const ProblemDescription& problem,
  const SolveOptions& options, const std::string& name)
{
  DescribedProblem described(problem, mesh.info(), name);
  const auto source = [&]
  { return mesh.source(described.vertexColumns(), described.cellColumns()); };
  described.prepare(*source(), options.scratch, options.memoryLimit);
  return std::make_unique<Implementation>(*source(), described, options);
}

template <class Implementation>
std::unique_ptr<Implementation> given(
  MeshSource& mesh, Problem& problem, const SolveOptions& options)
{
  checkProblem(problem);
  return std::make_unique<Implementation>(mesh, problem, options);
}

/** When a solve ends; the tolerance must be a number. */
Stopping stoppingAt(double tolerance, int maxCycles)
{
  SolveOptions asked;
  asked.tolerance = tolerance;
  asked.maxCycles = maxCycles;
  checkOptions(asked);
  refuseAutomaticTolerance(asked, "a linear solver");
  return { tolerance, maxCycles };
}

} // namespace

struct LinearSolver::Implementation : OwnEngine
{
  using OwnEngine::OwnEngine;
};

LinearSolver::LinearSolver(MeshSource& mesh, Problem& problem, const SolveOptions& options)
  : Self(given<Implementation>(mesh, problem, linearOptions(options)))
{
}

LinearSolver::LinearSolver(const StoredMesh& mesh, const ProblemDescription& problem,
  const SolveOptions& options, const std::string& name)
  : Self(described<Implementation>(mesh, problem, linearOptions(options), name))
{
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&& other) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&& other) noexcept = default;

std::int64_t LinearSolver::vertices() const
{
  return this->Self->engine().vertices();
}

int LinearSolver::columns() const
{
  return this->Self->engine().columns();
}

const Report& LinearSolver::solve(std::span<const double> b, std::span<double> x, double tolerance,
  int maxCycles, const ProgressFunction& progress)
{
  this->Self->ownEngine().solve(b, x, stoppingAt(tolerance, maxCycles), progress);
  return this->report();
}

void LinearSolver::precondition(std::span<const double> r, std::span<double> z)
{
  this->Self->ownEngine().precondition(r, z);
}

void LinearSolver::multiply(std::span<const double> x, std::span<double> y)
{
  this->Self->ownEngine().multiply(x, y);
}

const Report& LinearSolver::report() const
{
  return this->Self->engine().report();
}

struct SystemOnDisk::Implementation : OwnEngine
{
  using OwnEngine::OwnEngine;
};

SystemOnDisk::SystemOnDisk(MeshSource& mesh, Problem& problem, const SolveOptions& options)
  : Self(given<Implementation>(mesh, problem, onDiskOptions(options)))
{
}

SystemOnDisk::SystemOnDisk(const StoredMesh& mesh, const ProblemDescription& problem,
  const SolveOptions& options, const std::string& name)
  : Self(described<Implementation>(mesh, problem, onDiskOptions(options), name))
{
}

SystemOnDisk::~SystemOnDisk() = default;
SystemOnDisk::SystemOnDisk(SystemOnDisk&& other) noexcept = default;
SystemOnDisk& SystemOnDisk::operator=(SystemOnDisk&& other) noexcept = default;

std::int64_t SystemOnDisk::vertices() const
{
  return this->Self->engine().vertices();
}

int SystemOnDisk::columns() const
{
  return this->Self->engine().columns();
}

const Report& SystemOnDisk::solve(std::int64_t columns, const GivenVectors& give,
  const TakenVectors& take, double tolerance, int maxCycles, const ProgressFunction& progress)
{
  require(columns >= 1, "at least one right-hand side is needed");
  this->Self->ownEngine().solve(
    { columns, give, take }, stoppingAt(tolerance, maxCycles), progress);
  return this->report();
}

const Report& SystemOnDisk::solve(std::span<const double> b, std::span<double> x, double tolerance,
  int maxCycles, const ProgressFunction& progress)
{
  this->Self->ownEngine().solve(b, x, stoppingAt(tolerance, maxCycles), progress);
  return this->report();
}

const Report& SystemOnDisk::report() const
{
  return this->Self->engine().report();
}

} // namespace smg
