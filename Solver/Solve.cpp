// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Solve.h"

#include "Solver/Core/Progress.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/Corrections.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Multigrid/Engine/PoissonSolver.h"
#include "Solver/Multigrid/Extended.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescribedProblem.h"
#include "smg/SolveWith.h"

#include <string>

// The entry of the library: checks the options and chooses the engine. All checks that need neither
// the mesh nor files come first, in sentences for users, so that a long computation does not fail
// at its end for a reason known at its start. The same checks are public (CheckOptions.h): a
// program can refuse an input before it converts a mesh.

namespace smg
{

void checkOptions(const SolveOptions& options)
{
  require(options.sweeps >= 1 && options.sweeps <= 20, "the number of sweeps must be from 1 to 20");
  // Written so that NaN fails.
  require((options.tolerance > 0.0 && options.tolerance < 1.0) ||
            options.tolerance == SolveOptions::AutomaticTolerance,
    "the tolerance must lie between 0 and 1, both excluded, or be automatic");
  require(options.maxCycles >= 1, "at least one V-cycle must be allowed");
  require(options.memoryLimit > 0, "the memory limit must be positive");
  require(options.scratchLimit >= 0, "the limit of scratch files must not be negative");
  require(options.threads >= 0, "the number of threads must not be negative");
  require(options.blockNodes >= 1, "a stage must advance by at least one node");
  // A checkpoint continues from scratch files, which a solve in core does not have, and must
  // recognise its mesh and problem.
  const CheckpointOptions& checkpoint = options.checkpoint;
  require(checkpoint.folder.empty() || !options.inCore,
    "a solve in core has no checkpoint: solve out of core (without --in-core)");
  require(checkpoint.folder.empty() || (!checkpoint.mesh.empty() && !checkpoint.problem.empty()),
    "a checkpoint needs texts that identify the mesh and the problem");
  require(options.coreNodes >= 0, "the number of nodes of a core level must not be negative");
}

void refuseAutomaticTolerance(const SolveOptions& options, const std::string& what)
{
  require(options.tolerance != SolveOptions::AutomaticTolerance,
    what + " has no automatic tolerance: give one between 0 and 1, both excluded");
}

void refuseCheckpoint(const SolveOptions& options, const std::string& who)
{
  require(options.checkpoint.folder.empty(), who + " no checkpoints: leave the folder out");
}

void checkAutomaticTolerance(const SolveOptions& options, Weights weights)
{
  // With uniform weights the operator is a graph Laplacian: there is no continuous problem to
  // compare with.
  require(options.tolerance != SolveOptions::AutomaticTolerance || weights != Weights::Uniform,
    "uniform weights have no discretisation error: give a tolerance between 0 and 1, both "
    "excluded");
}

void checkAutomaticTolerance(const SolveOptions& options, const Problem& problem)
{
  checkAutomaticTolerance(options, problem.weights());
  const bool isAutomatic = options.tolerance == SolveOptions::AutomaticTolerance;
  // The discretisation error is estimated in an additional pass over the mesh.
  require(!isAutomatic || options.again,
    "an automatic tolerance needs SolveOptions::again, which opens the mesh once more");
  require(!isAutomatic || !problem.hasEdgeTargets(),
    "edge targets have no discretisation error: give a tolerance between 0 and 1, both excluded");
}

void checkOperators(const SolveOptions& options)
{
  require(options.operators != "shi2006",
    "the operator set shi2006, the equations as the paper prints them, gives no solutions and is "
    "not "
    "in the library: use extended, or the program solve_shi2006, which is built with the tests");
  require(options.operators == Extended::name,
    "there is no operator set '" + options.operators + "': use " + Extended::name);
}

void checkProblem(const Problem& problem)
{
  require(problem.columns() >= 1, "a problem needs at least one column");
  require(
    !problem.couplings() || (problem.weights() == Weights::Cotangent && !problem.hasEdgeTargets()),
    "coupled vertices need cotangent weights, and no edge targets");
}

std::unique_ptr<Solution> solveWith(const CompiledOperators& operators, MeshSource& mesh,
  Problem& problem, const SolveOptions& options)
{
  checkOptions(options);
  checkProblem(problem);
  checkAutomaticTolerance(options, problem);
  PoissonSolver solver(operators, problem.columns(), options);
  std::unique_ptr<Solution> solution = solver.solve(mesh, problem);
  if (options.again && solver.norms().flow > 0.0 && solution->report().converged)
  {
    solution = corrected(operators, problem, options, std::move(solution), solver);
  }
  if (solver.done() < 1.0)
  {
    Progress(options.progress).update(1.0); // with less to correct than expected
  }
  return solution;
}

std::unique_ptr<Solution> solve(MeshSource& mesh, Problem& problem, const SolveOptions& options)
{
  checkOperators(options);
  return solveWith<Extended>(mesh, problem, options);
}

void identify(SolveOptions& options, const StoredMesh& mesh, const std::string& text)
{
  CheckpointOptions& checkpoint = options.checkpoint;
  if (!checkpoint.folder.empty())
  {
    checkpoint.mesh = checkpoint.mesh.empty() ? mesh.fingerprint() : checkpoint.mesh;
    checkpoint.problem = checkpoint.problem.empty() ? text : checkpoint.problem;
  }
}

std::unique_ptr<Solution> solve(const StoredMesh& mesh, const ProblemDescription& description,
  const SolveOptions& options, const std::string& name)
{
  require(isPosed(description), name + " says nothing to solve for: give it " + PosingData);
  DescribedProblem problem(description, mesh.info(), name);
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  requireMemory(mesh.info(), problem.columns(), problem.weights(), options);
  problem.prepare(*source(), options.scratch, options.memoryLimit);
  SolveOptions completed = options;
  completed.again = source;
  identify(completed, mesh, textOf(description));
  return solve(*source(), problem, completed);
}

} // namespace smg
