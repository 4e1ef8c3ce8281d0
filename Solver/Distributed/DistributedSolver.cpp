// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DistributedSolver.h"
#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/DistributedDeformation.h"
#include "Solver/Distributed/DistributedRun.h"
#include "Solver/Distributed/PartResults.h"
#include "Solver/Distributed/SharedElements.h"
#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <optional>
#include <string>

// The public interface of the distributed engine, and the passing of its result to process 0. Every
// function runs inside Team::run(), so an error of one process is thrown on all.
//
// gather() moves the solution block by block: process 0 asks the owners for the vertices that it
// needs next, so no process ever holds the whole solution, which is as large as the mesh.

namespace smg
{

/** What DistributedSolver::gather() does on each process. */
void gatherSolution(const SharedVertices& vertices, const DistributedSolution& solution,
  const std::function<void(Solution&)>& use);

struct DistributedSolver::Implementation
{
  Implementation(MPI_Comm communicator, const MeshPart& meshPart)
    : team(communicator)
    , part(meshPart)
  {
    this->team.run(
      [this]
      {
        // First what needs no other process, so that indices can be trusted in the exchanges.
        checkPart(this->part);
        this->vertices.emplace(this->team, this->part);
        checkSharedPositions(*this->vertices, this->part);
      });
  }

  PartsOfMesh parts() const { return { *this->vertices, this->part.info.cellType }; }
  /** For a problem or for handles, which are prepared alike. */
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
      // Selections are made on the part, and then completed with what the other parts say of them.
      PartSource source(this->part);
      described.preparePart(source, scratch, memoryLimit);
      PartsOfMesh all = this->parts();
      described.endPreparing(all);
    });
}

DistributedSolution DistributedSolver::Implementation::solve(
  Problem& problem, const DistributedOptions& options)
{
  // The report is complete only with finish(), which gathers the costs of all processes.
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

namespace
{

/** A request of process 0 for the values of consecutive vertices. Without vertices it ends the
 * service. */
struct Request
{
  std::int64_t first = 0, count = 0;
};

enum Tag
{
  RequestTag = 1,
  ValuesTag
};

/** The most vertices of a message: their values are counted by an int. */
constexpr std::int64_t MaxVertices = std::int64_t(1) << 20;

/** The values from an own vertex on, given its stream index. */
const double* valuesOf(
  const SharedVertices& vertices, const DistributedSolution& solution, std::int64_t id)
{
  return solution.values.data() + vertices.find(id) * solution.columns;
}

/** The solution as process 0 sees it: what it does not own is asked of the owners. The destructor
 * ends the service of the other processes, also if `use` throws; Team::run() then tells them of
 * the failure. */
class GatheredSolution final : public Solution
{
public:
  GatheredSolution(const SharedVertices& vertices, const DistributedSolution& solution)
    : Vertices(vertices)
    , Part(solution)
  {
  }
  ~GatheredSolution() override
  {
    const Request end;
    for (int p = 1; p < this->Vertices.team().size(); ++p)
    {
      this->send(p, end);
    }
  }

  std::int64_t vertices() const override { return this->Part.report.vertices; }
  int columns() const override { return this->Part.columns; }
  const Report& report() const override { return this->Part.report; }

  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    checkVertexRange(
      first, count, values.size() / static_cast<std::size_t>(this->columns()), this->vertices());
    for (double* to = values.data(); count > 0;)
    {
      // A range may extend over the vertices of several owners.
      const int owner = this->Vertices.ownerOf(first);
      const std::int64_t part =
        std::min({ count, this->Vertices.endOf(owner) - first, MaxVertices });
      this->readFrom(owner, { first, part }, to);
      first += part;
      count -= part;
      to += part * this->columns();
    }
  }

private:
  void send(int process, const Request& request) const
  {
    MPI_Send(&request, static_cast<int>(sizeof(request)), MPI_BYTE, process, RequestTag,
      this->Vertices.team().communicator());
  }

  void readFrom(int owner, const Request& request, double* values) const
  {
    const auto count = static_cast<int>(request.count) * this->columns();
    if (owner == 0)
    {
      std::copy_n(valuesOf(this->Vertices, this->Part, request.first), count, values);
      return;
    }
    this->send(owner, request);
    MPI_Recv(values, count, MPI_DOUBLE, owner, ValuesTag, this->Vertices.team().communicator(),
      MPI_STATUS_IGNORE);
  }

  const SharedVertices& Vertices;
  const DistributedSolution& Part;
};

/** Answers the requests of process 0 until it sends one without vertices. */
void serve(const SharedVertices& vertices, const DistributedSolution& solution)
{
  const MPI_Comm processes = vertices.team().communicator();
  while (true)
  {
    Request request;
    MPI_Recv(&request, static_cast<int>(sizeof(request)), MPI_BYTE, 0, RequestTag, processes,
      MPI_STATUS_IGNORE);
    if (request.count == 0)
    {
      return;
    }
    MPI_Send(valuesOf(vertices, solution, request.first),
      static_cast<int>(request.count) * solution.columns, MPI_DOUBLE, 0, ValuesTag, processes);
  }
}

} // namespace

void gatherSolution(const SharedVertices& vertices, const DistributedSolution& solution,
  const std::function<void(Solution&)>& use)
{
  // Only process 0 uses the solution; all others wait and serve.
  if (vertices.team().rank() != 0)
  {
    serve(vertices, solution);
    return;
  }
  GatheredSolution whole(vertices, solution);
  use(whole);
}

} // namespace smg
