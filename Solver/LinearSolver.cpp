// SPDX-License-Identifier: BSD-3-Clause
#include "smg/LinearSolver.h"

#include "Solver/Core/Forks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/LinearEngine.h"
#include "Solver/Multigrid/Extended.h"
#include "smg/DescribedProblem.h"

// The entry for many right-hand sides of one problem: checks the options, and hides the engine from
// the public header.

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

} // namespace

struct LinearSolver::Implementation
{
  Implementation(MeshSource& mesh, Problem& problem, const SolveOptions& options)
    : engine(compiled(Extended::forCells(mesh.info().cellType)), problem.columns(), options)
  {
    this->engine.build(mesh, problem);
  }

  /** The engine to compute with. Throws Error in a forked child. */
  LinearEngine& ownEngine()
  {
    this->process.require("a linear solver");
    return this->engine;
  }

  LinearEngine engine;
  OwnProcess process;
};

LinearSolver::LinearSolver(MeshSource& mesh, Problem& problem, const SolveOptions& options)
{
  const SolveOptions checked = linearOptions(options);
  checkProblem(problem);
  this->Self = std::make_unique<Implementation>(mesh, problem, checked);
}

LinearSolver::LinearSolver(const StoredMesh& mesh, const ProblemDescription& problem,
  const SolveOptions& options, const std::string& name)
{
  const SolveOptions checked = linearOptions(options);
  DescribedProblem described(problem, mesh.info(), name);
  const auto source = [&]
  { return mesh.source(described.vertexColumns(), described.cellColumns()); };
  described.prepare(*source(), checked.scratch, checked.memoryLimit);
  this->Self = std::make_unique<Implementation>(*source(), described, checked);
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&& other) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&& other) noexcept = default;

std::int64_t LinearSolver::vertices() const
{
  return this->Self->engine.vertices();
}

int LinearSolver::columns() const
{
  return this->Self->engine.columns();
}

const Report& LinearSolver::solve(std::span<const double> b, std::span<double> x, double tolerance,
  int maxCycles, const ProgressFunction& progress)
{
  SolveOptions asked;
  asked.tolerance = tolerance;
  asked.maxCycles = maxCycles;
  checkOptions(asked);
  refuseAutomaticTolerance(asked, "a linear solver");
  this->Self->ownEngine().solve(b, x, { tolerance, maxCycles }, progress);
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
  return this->Self->engine.report();
}

} // namespace smg
