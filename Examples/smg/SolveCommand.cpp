// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/AnyFormat/WriteRestored.h"
#include "IO/External/Workspace.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Problem/ProblemKeys.h"
#include "Solver/Description/ComposeDescriptions.h"
#include "Solver/Engine/CheckOptions.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <limits>

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
        ". Of these .ply, .vtp and .vtu have the order of IN, "
        "unless that has a column OriginalId or points are welded: then the vertices are in stream "
        "order",
      this->Solve, { "extended", "shi2006" });
    command.get_option("--operators")
      ->description("Operator set; shi2006: the paper's printed equations, biased, --in-core only");
    addTolerance(command, this->Solve.tolerance)->capture_default_str();
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
    command.add_option("--problem", this->File, "The problem, a JSON file")
      ->required()
      ->type_name("FILE");
    command.footer(problemHelp());
  }

protected:
  void checkOutputName() const override
  {
    if (smg::kindOfOutput(this->Out) == smg::MeshFileKind::Stream)
    {
      throw smg::Error(this->Out.string() + ": this format cannot hold a solution: write it as " +
                       smg::suffixList(smg::FormatUse::WriteColumns, "or") + '.');
    }
    smg::checkOutput(this->Out);
  }

  void readTask() override
  {
    smg::checkOptions(this->Solve);
    smg::checkOperators(this->Solve);
    this->Description = smg::readProblemFile(this->File);
    if (!smg::isPosed(this->Description))
    {
      throw smg::Error(this->File.string() +
                       ": says nothing to solve for: give it dirichlet, source, flux, robin, soft, "
                       "field or initial.");
    }
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    smg::checkOutput(this->Out, mesh.info().cellType);
    this->Problem =
      std::make_unique<smg::DescribedProblem>(this->Description, mesh.info(), this->File.string());
    this->Problem->prepare(*this->sourceOf(mesh), this->scratch);
    this->applyTo(this->Solve, std::move(progress));
    return smg::solve(*this->sourceOf(mesh), *this->Problem, this->Solve);
  }

  std::vector<std::string> write(const smg::VsmReader& mesh, smg::Solution& solution,
    smg::Report& report, const smg::ProgressFunction& progress) const override
  {
    smg::ResultOptions results;
    results.gradient = this->Description.gradientOutput;
    results.flux = this->Description.fluxOutput;
    results.memoryLimit = this->Solve.memoryLimit;
    smg::SolvedMesh source(mesh, *this->Problem, solution, results);
    return this->keepsOrder() ? this->writeInOrder(mesh, source, report, progress)
                              : this->writeStream(mesh, source, report, progress);
  }

  bool keepsOrder() const override
  {
    const bool canKeep = smg::suffixFor(smg::FormatUse::Write, this->Out) &&
                         smg::suffixFor(smg::FormatUse::Restore, this->Out);
    return canKeep && this->Conversion &&
           smg::kindOfInput(this->In) == smg::MeshFileKind::Indexed &&
           !this->Conversion->keeps_numbers && !this->Input.welds();
  }

  std::string fateOfIsolated(std::int64_t vertices) const override
  {
    return this->keepsOrder() ? vertices == 1 ? "has the Solution 0." : "have the Solution 0."
                              : this->SolvingCommand::fateOfIsolated(vertices);
  }

  const smg::SolveOptions& solveOptions() const override { return this->Solve; }

private:
  std::vector<std::string> writeStream(const smg::VsmReader& mesh, smg::SolvedMesh& source,
    smg::Report& report, const smg::ProgressFunction& progress) const
  {
    smg::WriteMeshOptions options;
    options.scratch = this->scratch;
    options.isolatedFrom = mesh.path();
    options.progress = progress;
    std::vector<std::string> notes = smg::writeMesh(source, this->Out, options);
    source.finish(report);
    return notes;
  }

  /** Writes vertices and cells in the order of IN, by sorting a temporary .vsm file. */
  std::vector<std::string> writeInOrder(const smg::VsmReader& mesh, smg::SolvedMesh& source,
    smg::Report& report, const smg::ProgressFunction& progress) const
  {
    // The solver still holds its memory.
    constexpr std::int64_t MostMemory = std::int64_t(64) << 20;
    smg::Workspace space(this->scratch,
      std::clamp(this->Solve.memoryLimit / 4, smg::Workspace::LeastMemory, MostMemory),
      smg::partOf(progress, 0.4, 1.0));
    smg::WriteMeshOptions options;
    options.codec = smg::Codec::Lz4;
    options.isolatedFrom = mesh.path();
    options.progress = smg::partOf(progress, 0.0, 0.4);
    const std::filesystem::path solved = space.folder() / "solved.vsm";
    smg::writeMesh(source, solved, options);
    source.finish(report);
    space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
    return smg::writeRestored(solved, this->Out, space);
  }

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
  auto solve = std::make_shared<SolveCommand>();
  CLI::App* command = program.add_subcommand("solve", "Solve a Poisson problem on a mesh");
  solve->addOptions(*command);
  command->callback([solve, &action] { action = [solve] { solve->run(); }; });
}
