// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedEngine.h"
#include "ProgressBar.h"
#include "SolvingCommand.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/Problem/ProblemKeys.h"
#include "Solver/Description/ComposeDescriptions.h"
#include "Solver/Engine/CheckOptions.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <algorithm>
#include <cstdlib>

namespace
{

/** In the order of smg::AccelerationKind. */
const std::vector<std::string> Accelerations{ "automatic", "none", "chebyshev", "cg" };

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

/** A solution that another object owns. */
class BorrowedSolution final : public smg::Solution
{
public:
  explicit BorrowedSolution(smg::Solution& solution)
    : Lent(solution)
  {
  }
  std::int64_t vertices() const override { return this->Lent.vertices(); }
  int columns() const override { return this->Lent.columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->Lent.read(first, count, values);
  }
  const smg::Report& report() const override { return this->Lent.report(); }

private:
  smg::Solution& Lent;
};

class SolveCommand : public SolvingCommand
{
public:
  SolveCommand()
    : SolvingCommand("solving")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The mesh with its solution: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " in stream order; of a mesh file IN, " +
        smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded",
      this->Solve, { "extended", "shi2006" });
    command.get_option("--operators")
      ->description("Operator set; shi2006: the paper's printed equations, biased, --in-core only");
    addTolerance(command, this->Solve.tolerance)->capture_default_str();
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
    command
      .add_option("--engine", this->Engine,
        "streaming, or hypre: BoomerAMG on the processes that mpiexec starts; IN is a .vsm file, "
        "OUT may be .pvtu or .pvtp, with a piece of each process")
      ->check(oneOf({ "streaming", "hypre" }))
      ->capture_default_str();
    this->MaxCycles = command.get_option("--max-cycles");
    command.add_option("--problem", this->File, "The problem, a JSON file")
      ->required()
      ->type_name("FILE");
    command.footer(problemHelp());
  }

protected:
  void compute() override
  {
    if (this->Engine == "streaming")
    {
      this->SolvingCommand::compute();
      return;
    }
    this->computeDistributed();
  }

  std::string resultColumns() const override { return "a solution"; }

  void readTask() override
  {
    smg::checkOptions(this->Solve);
    smg::checkOperators(this->Solve);
    this->Description = smg::readProblemText(this->readText(), this->File.string());
    if (!smg::isPosed(this->Description))
    {
      throw smg::Error(this->File.string() +
                       ": says nothing to solve for: give it dirichlet, source, flux, robin, soft, "
                       "field or initial.");
    }
    this->announceCheckpoint("pass");
  }

  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    // Those of the other engine are past when this one's result is written.
    return this->Whole ? smg::Costs{}
                       : smg::solveCosts(
                           info, this->Description.columns, this->Description.weights, this->Solve);
  }

  smg::AddedValues addedTo(const smg::StreamInfo& /*info*/) const override
  {
    const int cellValues = this->Description.gradientOutput + this->Description.fluxOutput;
    return { this->Description.columns, 3 * this->Description.columns * cellValues };
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    this->Problem =
      std::make_unique<smg::DescribedProblem>(this->Description, mesh.info(), this->File.string());
    this->Problem->prepare(*this->sourceOf(mesh), this->scratch);
    if (this->Whole)
    {
      return std::make_unique<BorrowedSolution>(*this->Whole);
    }
    this->applyTo(this->Solve, std::move(progress));
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
    smg::SolvedMesh source(mesh, *this->Problem, solution, results);
    write(source, progress);
    source.finish(report);
  }

  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override
  {
    return ordered ? vertices == 1 ? "has the Solution 0." : "have the Solution 0."
                   : this->SolvingCommand::fateOfIsolated(vertices, ordered);
  }

  const smg::SolveOptions& solveOptions() const override { return this->Solve; }

private:
  /** Solves on the processes of mpiexec; on the first of them, writes and reports as ever. */
  void computeDistributed()
  {
    constexpr int MostIterations = 200;
    auto bar = std::make_unique<ProgressBar>("solving", this->quiet);
    DistributedSolve task;
    task.in = this->In;
    task.out = this->Out;
    task.scratch = this->scratch;
    task.problem = this->File.string();
    task.tolerance = this->Solve.tolerance;
    task.maxIterations = this->MaxCycles->count() > 0 ? this->Solve.maxCycles : MostIterations;
    task.memoryLimit = this->memoryBytes(INT64_MAX);
    task.progress = bar->function();
    task.check = [this] { this->checkDistributed(); };
    task.read = [this]
    {
      this->readTask();
      return this->Description;
    };
    task.use = [this, &bar](smg::Solution& solution)
    {
      bar.reset();
      this->Whole = &solution;
      this->SolvingCommand::compute();
    };
    task.report = [this, &bar](smg::Report& report)
    {
      bar.reset();
      this->writeReport(report.json());
      this->tell(report);
    };
    if (const int status = distributedEngine().solve(task); status != 0)
    {
      std::exit(status);
    }
  }

  /** Reports foreseeable failures. */
  void checkDistributed()
  {
    if (this->Solve.inCore || !this->checkpoint.empty() || this->isDryRun() ||
        this->Solve.operators != "extended")
    {
      throw smg::Error("--engine hypre has no --in-core, --checkpoint, --dry-run or --operators: "
                       "leave them out.");
    }
    if (smg::kindOfInput(this->In) != smg::MeshFileKind::Vsm)
    {
      throw smg::Error(this->In.string() +
                       ": --engine hypre needs a .vsm file, of which each process reads a piece: "
                       "convert the mesh first (smg convert).");
    }
    if (!isInPieces(this->Out))
    {
      this->checkFiles();
      return;
    }
    smg::checkOutputPlace(this->Out);
    this->checkReport({ this->In, this->Out, this->File });
    this->readTask();
  }

  /** The mesh with the columns of the problem. */
  std::unique_ptr<smg::MeshSource> sourceOf(const smg::VsmReader& mesh) const
  {
    return mesh.source(this->Problem->vertexColumns(), this->Problem->cellColumns());
  }

  smg::ProblemDescription Description; ///< from the problem file
  std::unique_ptr<smg::DescribedProblem> Problem;
  smg::SolveOptions Solve;
  std::string Engine = "streaming";
  CLI::Option* MaxCycles = nullptr;
  smg::Solution* Whole = nullptr; ///< of the other engine
};

} // namespace

void addSolveCommand(CLI::App& program, Action& action)
{
  auto solve = std::make_shared<SolveCommand>();
  CLI::App* command = program.add_subcommand("solve", "Solve a Poisson problem on a mesh");
  solve->addOptions(*command);
  command->callback([solve, &action] { action = [solve] { solve->run(); }; });
}
