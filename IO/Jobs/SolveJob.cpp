// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/SolveJob.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Jobs/JobOption.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <limits>

namespace smg
{
namespace
{

/** In the order of AccelerationKind. */
constexpr const char* AccelerationNames[] = { "automatic", "none", "chebyshev", "cg" };

constexpr auto SolveTable = joined(
  std::array{
    JobOption{ .key = "problem",
      .kind = DescriptionOption{ [](const JsonNode& node, Job& job)
        {
          auto& solve = static_cast<SolveJob&>(job);
          solve.description = parseProblem(node);
          solve.text = node.value().dump();
        } },
      .help = "The problem, in a JSON file",
      .isRequired = true },
    JobOption{ .key = "tolerance",
      .kind = NumberOption{ solverMember<double, &SolveOptions::tolerance>, { 0.0, 1.0, true }, "",
        "auto" },
      .help = "Relative residual to stop at; auto: until the algebraic error is below a tenth of "
              "the estimated discretisation error" },
    JobOption{ .key = "acceleration",
      .kind =
        ChoiceOption{ solverMember<std::size_t, &SolveOptions::acceleration>, AccelerationNames },
      .help = "Acceleration of the V-cycles: automatic, none, chebyshev or cg",
      .isAdvanced = true },
  },
  SolverOptions, LimitOptions, ScratchLimitOption, CheckpointOption);

} // namespace

std::span<const JobOption> SolveJob::table() const
{
  return SolveTable;
}

void SolveJob::check() const
{
  if (!isPosed(this->description))
  {
    throw Error(this->name + ": says nothing to solve for: give it " + PosingData + '.');
  }
  checkAutomaticTolerance(this->solving, this->description.weights);
}

std::vector<ColumnSpec> SolveJob::solutionColumns(const StreamInfo& /*info*/) const
{
  constexpr double NoSolution = std::numeric_limits<double>::quiet_NaN();
  return { { SolutionName, ScalarType::Float64, this->description.columns, NoSolution } };
}

bool SolveJob::keeps(const ColumnSpec& column, const StreamInfo& /*info*/) const
{
  return column.name != SolutionName && column.name != GradientName && column.name != FluxName;
}

void SolveJob::checkOn(const StreamInfo& info) const
{
  const DescribedProblem problem(this->description, info, this->name);
}

CoupledGroups SolveJob::coupled() const
{
  return coupledGroups(this->description);
}

Costs SolveJob::costsOn(const StreamInfo& info) const
{
  return solveCosts(info, this->description.columns, this->description.weights, this->solving,
    contrastOf(this->description));
}

AddedValues SolveJob::addedTo(const StreamInfo& /*info*/) const
{
  return solvedValues(this->description);
}

std::unique_ptr<MeshSource> SolveJob::sourceOf(const StoredMesh& mesh) const
{
  return mesh.source(this->Problem->vertexColumns(), this->Problem->cellColumns());
}

void SolveJob::prepareOn(const StoredMesh& mesh)
{
  this->Problem = std::make_unique<DescribedProblem>(this->description, mesh.info(), this->name);
  this->Problem->prepare(*this->sourceOf(mesh), this->solving.scratch, this->solving.memoryLimit);
}

std::unique_ptr<Solution> SolveJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  this->solving.again = [this, &mesh] { return this->sourceOf(mesh); };
  return solve(*this->sourceOf(mesh), *this->Problem, this->solving);
}

void SolveJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& report, const ProgressFunction& progress) const
{
  ResultOptions results;
  results.gradient = this->description.gradientOutput;
  results.flux = this->description.fluxOutput;
  results.gradientAtVertices = this->description.vertexGradientOutput;
  results.integrals = this->description.integrals;
  results.scratch = this->solving.scratch;
  results.memoryLimit = this->solving.memoryLimit;
  results.threads = this->solving.threads;
  SolvedMesh source(mesh, *this->Problem, solution, results);
  read(source, progress);
  source.finish(report);
}

std::string SolveJob::fateOfIsolated(std::int64_t vertices, bool ordered) const
{
  return ordered ? vertices == 1 ? "has no Solution (NaN)." : "have no Solution (NaN)."
                 : this->SolvingJob::fateOfIsolated(vertices, ordered);
}

} // namespace smg
