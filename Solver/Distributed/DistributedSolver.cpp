// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DistributedSolver.h"

#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/CheckShared.h"
#include "Solver/Distributed/DistributedDeformation.h"
#include "Solver/Distributed/DistributedRun.h"
#include "Solver/Distributed/GatheredSolution.h"
#include "Solver/Distributed/PartResults.h"
#include "Solver/Distributed/PartSource.h"
#include "Solver/Distributed/PartsOfMesh.h"
#include "Solver/Distributed/SharedCells.h"

#include <optional>
#include <string>

namespace smg
{
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
        checkSharedPositions(*this->vertices, this->part);
      });
  }

  PartsOfMesh parts() const { return { *this->vertices, this->part.info.cellType }; }
  /** What is described may be a problem or handles. */
  template <class Described>
  void prepare(
    Described& described, const std::filesystem::path& scratch, std::int64_t memoryLimit);
  DistributedSolution solve(Problem& problem, const DistributedOptions& options);

  Team team;
  const MeshPart& part;
  std::optional<SharedVertices> vertices;
};

template <class Described>
void DistributedSolver::Implementation::prepare(
  Described& described, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->team.run(
    [&]
    {
      PartSource source(this->part);
      described.preparePart(source, scratch, memoryLimit);
      PartsOfMesh all = this->parts();
      described.endPreparing(all);
    });
}

DistributedSolution DistributedSolver::Implementation::solve(
  Problem& problem, const DistributedOptions& options)
{
  DistributedRun run(*this->vertices, this->part, options, problem.columns());
  run.assemble(problem);
  run.iterate();
  run.fix(problem);
  DistributedSolution solution;
  solution.columns = problem.columns();
  solution.values = run.values();
  run.finish();
  solution.report = run.report;
  return solution;
}

DistributedSolver::DistributedSolver(MPI_Comm communicator, const MeshPart& part)
  : Self(std::make_unique<Implementation>(communicator, part))
{
}

DistributedSolver::~DistributedSolver() = default;

void DistributedSolver::prepare(
  DescribedProblem& problem, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->Self->prepare(problem, scratch, memoryLimit);
}

void DistributedSolver::prepare(
  DescribedHandles& handles, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->Self->prepare(handles, scratch, memoryLimit);
}

std::vector<std::string> DistributedSolver::notes(const DescribedHandles& handles)
{
  std::vector<std::string> notes;
  this->Self->team.run(
    [&]
    {
      PartsOfMesh parts = this->Self->parts();
      notes = handles.notes(parts);
    });
  return notes;
}

DistributedSolution DistributedSolver::deform(
  Handles& handles, Weights weights, const DistributedOptions& options)
{
  DistributedSolution solution;
  const Implementation& self = *this->Self;
  this->Self->team.run(
    [&] { solution = deformParts(*self.vertices, self.part, handles, weights, options); });
  return solution;
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
        throw Error(
          std::to_string(repeated) + (repeated == 1 ? " cell belongs" : " cells belong") +
          " to several processes without a mark as ghost cells, and would count several "
          "times: assign each cell to one process, or mark the others; a mesh that itself has "
          "the same cell twice must be cleaned.");
      }
    });
}

void DistributedSolver::sum(std::span<double> values, int columns)
{
  this->Self->team.run(
    [&]
    {
      this->Self->vertices->addToOwners(values, columns);
      this->Self->vertices->copyFromOwners(values, columns);
    });
}

void DistributedSolver::together(const std::function<void()>& work)
{
  this->Self->team.run(work);
}

} // namespace smg
