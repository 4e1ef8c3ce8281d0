// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Doors.h"

#include "Testing/Support/MemorySource.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/SolvedMesh.h"
#include "smg/VsmReader.h"

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace smg::testing
{

CaseRun plain(const CaseRun& run)
{
  CaseRun in;
  in.inCore = true;
  in.blockCells = INT64_MAX / 2;
  in.coreNodes = run.coreNodes;
  in.blockNodes = run.blockNodes;
  in.sweeps = run.sweeps;
  in.acceleration = run.acceleration;
  return in;
}

namespace
{

/** A solve from memory that can be repeated. */
class MemorySolve
{
public:
  MemorySolve(const Case& given, const CaseRun& run)
    : BlockCells(run.blockCells)
    , Source(given.stream(), run.blockCells)
    , Problem(readProblemText(given.problem.dump(), "problem"), this->Source.info())
  {
    this->Problem.prepare(this->Source);
    setOptions(run, this->Options);
    this->Options.scratch = this->Folder.path();
    // As of files and filters: values with more digits than a double where fluxes need them.
    this->Options.again = [given, run]
    { return std::make_unique<MemorySource>(given.stream(), run.blockCells); };
  }

  Result solve()
  {
    this->Source.rewind(this->BlockCells);
    Solved solved = solveMesh(this->Source, this->Problem, this->Options);
    return { std::move(solved.values), std::move(solved.report) };
  }

  SolveOptions& options() { return this->Options; }
  const std::filesystem::path& folder() const { return this->Folder.path(); }

private:
  std::int64_t BlockCells;
  TemporaryFolder Folder;
  MemorySource Source;
  DescribedProblem Problem;
  SolveOptions Options;
};

CheckpointOptions checkpointIn(const std::filesystem::path& folder)
{
  return { folder, "mesh", "problem" };
}

/** Runs this program on the case until it kills itself. */
void runUntilKilled(const Case& given, const CaseRun& run, const std::filesystem::path& folder,
  const std::filesystem::path& checkpoint)
{
  Case killed = given;
  killed.run = run;
  const std::string file = folder / "case.json", option = "--killed", place = checkpoint;
  killed.save(file);
  std::string program = "/proc/self/exe";
  char* const arguments[] = { program.data(), const_cast<char*>(option.c_str()),
    const_cast<char*>(file.c_str()), const_cast<char*>(place.c_str()), nullptr };
  pid_t process = 0;
  int status = 0;
  if (posix_spawn(&process, program.c_str(), nullptr, nullptr, arguments, environ) != 0 ||
      waitpid(process, &status, 0) != process)
  {
    throw std::runtime_error("cannot start the process that is killed");
  }
  const bool isKilled = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  if (!isKilled && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
  {
    throw std::runtime_error("the process that is killed failed before");
  }
}

} // namespace

Result solveInMemory(const Case& given, const CaseRun& run, std::int64_t memoryLimit)
{
  MemorySolve solve(given, run);
  if (memoryLimit > 0)
  {
    solve.options().memoryLimit = memoryLimit;
  }
  if (run.cancelAt == 0)
  {
    return solve.solve();
  }
  const std::filesystem::path checkpoint = solve.folder() / "checkpoint";
  solve.options().checkpoint = checkpointIn(checkpoint);
  if (run.isKilled)
  {
    runUntilKilled(given, run, solve.folder(), checkpoint);
    return solve.solve();
  }
  int calls = 0;
  solve.options().progress = [&](double) { return ++calls != run.cancelAt; };
  try
  {
    return solve.solve();
  }
  catch (const Cancelled&)
  {
    solve.options().progress = {};
    return solve.solve();
  }
}

void solveUntilKilled(const Case& given, const std::filesystem::path& checkpoint)
{
  MemorySolve solve(given, given.run);
  solve.options().checkpoint = checkpointIn(checkpoint);
  int calls = 0;
  solve.options().progress = [&](double)
  {
    if (++calls == given.run.cancelAt)
    {
      std::raise(SIGKILL);
    }
    return true;
  };
  solve.solve();
}

std::filesystem::path convertedFile(const Case& given, const std::filesystem::path& folder)
{
  given.writeVtk(folder / "mesh.vtk");
  ConversionOptions conversion;
  conversion.order = given.run.order == "keep"   ? StreamOrder::Keep
                     : given.run.order == "axis" ? StreamOrder::Axis
                                                 : StreamOrder::BreadthFirst;
  conversion.threads = given.run.threads;
  conversion.scratch = folder;
  convert(folder / "mesh.vtk", folder / "mesh.vsm", conversion);
  return folder / "mesh.vsm";
}

Result solveFile(const Case& given, StreamMesh& result)
{
  const TemporaryFolder folder;
  const VsmReader mesh(convertedFile(given, folder.path()));
  const ProblemDescription description = readProblemText(given.problem.dump(), "problem");
  DescribedProblem problem(description, mesh.info());
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source());
  SolveOptions options;
  setOptions(given.run, options);
  options.scratch = folder.path();
  const std::unique_ptr<Solution> solution = solve(*source(), problem, options);
  ResultOptions results;
  results.gradient = results.flux = true;
  results.integrals = description.integrals;
  results.threads = given.run.threads;
  SolvedMesh solved(mesh, problem, *solution, results);
  result = collect(solved);
  Result found{ Eigen::MatrixXd::Zero(given.vertices(), solution->columns()), solution->report() };
  solved.finish(found.report);
  const auto columnOf = [&](const std::string& name) -> const Column&
  {
    return *std::ranges::find_if(
      result.vertexColumns, [&](const Column& column) { return column.spec.name == name; });
  };
  for (std::int64_t v = 0; v < result.vertices(); ++v)
  {
    const auto original = static_cast<std::int64_t>(columnOf(OriginalIdName).value(v));
    for (int k = 0; k < solution->columns() && original < given.vertices(); ++k)
    {
      found.values(original, k) = columnOf("Solution").value(v, k);
    }
  }
  return found;
}

} // namespace smg::testing
