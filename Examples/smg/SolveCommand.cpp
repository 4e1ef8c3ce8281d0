// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Formats/FormatTable.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <algorithm>

namespace
{

/** In the order of smg::AccelerationKind. */
const std::vector<std::string> Accelerations{ "automatic", "none", "chebyshev", "cg" };

/** The tolerance that is SolveOptions::AutomaticTolerance. */
constexpr const char* Automatic = "auto";

/** The help on problem files. */
std::string problemHelp()
{
  std::string keys;
  for (const char* key : smg::ProblemKeys)
  {
    keys += (keys.empty() ? "" : ", ") + std::string(key);
  }
  return "A problem file states -div(K grad u - q) + s u = f. Its keys, all optional: " + keys +
         ". JSON schema: share/StreamingMultigrid/problem.schema.json of the installation, "
         "docs/problem.schema.json of the sources; docs/problem.md explains it";
}

class SolveCommand : public EngineCommand
{
public:
  SolveCommand()
    : EngineCommand("solving")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The mesh with its solution: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " in stream order; of a mesh file IN, " +
        smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded",
      this->Solve);
    command
      .add_option_function<std::string>(
        "--tolerance",
        [this](const std::string& given)
        {
          this->Solve.tolerance =
            given == Automatic ? smg::SolveOptions::AutomaticTolerance : std::stod(given);
        },
        "Relative residual to stop at, between 0 and 1; auto: until the algebraic error is below a "
        "tenth of the estimated discretisation error")
      ->check([](const std::string& given)
        { return given == Automatic ? std::string() : checkTolerance(given); })
      ->type_name("FLOAT|auto")
      ->default_str(CLI::detail::to_string(this->Solve.tolerance));
    this->addCheckpointTo(command);
    command
      .add_option_function<std::string>(
        "--acceleration",
        [this](const std::string& name)
        {
          const auto place = std::find(Accelerations.begin(), Accelerations.end(), name);
          this->Solve.acceleration =
            static_cast<smg::AccelerationKind>(place - Accelerations.begin());
        },
        "Acceleration of the V-cycles: automatic, none, chebyshev or cg")
      ->check(oneOf(Accelerations))
      ->default_str(Accelerations.front());
    this->addEngineTo(command);
    command.add_option("--problem", this->File, "The problem, a JSON file")
      ->required()
      ->type_name("FILE");
    command.footer(problemHelp());
  }

  void checkUsage() const override
  {
    smg::checkOptions(this->Solve);
    smg::checkOperators(this->Solve);
  }

protected:
  void computeOn(const DistributedEngine& engine, const DistributedJob& job) override
  {
    if (this->Solve.tolerance == smg::SolveOptions::AutomaticTolerance)
    {
      throw smg::Error("--tolerance auto is for --engine streaming: give a number");
    }
    DistributedSolve solve;
    solve.read = [this]
    {
      this->readTask();
      return this->Description;
    };
    solve.tolerance = this->Solve.tolerance;
    return engine.solve(job, solve);
  }

  std::string resultColumns() const override { return "a solution"; }

  void readTask() override
  {
    this->Description = smg::readProblemText(this->readText(), this->File.string());
    if (!smg::isPosed(this->Description))
    {
      throw smg::Error(this->File.string() +
                       ": says nothing to solve for: give it dirichlet, source, flux, robin, soft, "
                       "field or initial.");
    }
    smg::checkAutomaticTolerance(this->Solve, this->Description.weights);
    this->announceCheckpoint("pass");
  }

  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    // Those of the other engine are past when this one's result is written.
    return this->hasWholeSolution() ? smg::Costs{}
                                    : smg::solveCosts(info, this->Description.columns,
                                        this->Description.weights, this->withCommon(this->Solve));
  }

  smg::AddedValues addedTo(const smg::StreamInfo& /*info*/) const override
  {
    return smg::solvedValues(
      this->Description.columns, this->Description.gradientOutput, this->Description.fluxOutput);
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    this->Problem =
      std::make_unique<smg::DescribedProblem>(this->Description, mesh.info(), this->File.string());
    this->Problem->prepare(
      *this->sourceOf(mesh), this->scratch, this->withCommon(this->Solve).memoryLimit);
    if (auto whole = this->wholeSolution())
    {
      return whole;
    }
    this->applyTo(this->Solve, std::move(progress));
    this->Solve.again = [this, &mesh] { return this->sourceOf(mesh); };
    this->applyCheckpoint(this->Solve, mesh);
    return smg::solve(*this->sourceOf(mesh), *this->Problem, this->Solve);
  }

  void writeResult(const smg::VsmReader& mesh, smg::Solution& solution, const Writer& write,
    smg::Report& report, const smg::ProgressFunction& progress) const override
  {
    smg::ResultOptions results;
    results.gradient = this->Description.gradientOutput;
    results.flux = this->Description.fluxOutput;
    results.memoryLimit = this->Solve.memoryLimit;
    results.threads = this->Solve.threads;
    smg::SolvedMesh source(mesh, *this->Problem, solution, results);
    write(source, progress);
    source.finish(report);
  }

  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override
  {
    return ordered ? vertices == 1 ? "has no Solution (NaN)." : "have no Solution (NaN)."
                   : this->SolvingCommand::fateOfIsolated(vertices, ordered);
  }

  const smg::SolveOptions& solveOptions() const override { return this->Solve; }

private:
  /** The mesh with the columns of the problem. */
  std::unique_ptr<smg::MeshSource> sourceOf(const smg::VsmReader& mesh) const
  {
    return mesh.source(this->Problem->vertexColumns(), this->Problem->cellColumns());
  }

  smg::ProblemDescription Description; ///< from the problem file
  std::unique_ptr<smg::DescribedProblem> Problem;
  smg::SolveOptions Solve;
};

} // namespace

void addSolveCommand(CLI::App& program, Action& action)
{
  addCommand<SolveCommand>(program, action, "solve", "Solve a Poisson problem on a mesh");
}
