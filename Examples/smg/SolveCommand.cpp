// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Conversion/AddedColumn.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Output/WriteMesh.h"
#include "IO/Problem/RegionProblem.h"
#include "Solver/Core/Error.h"

#include <algorithm>

namespace
{

constexpr const char* SolutionName = "Solution";

/** In the order of smg::AccelerationKind. */
const std::vector<std::string> Accelerations{ "automatic", "none", "chebyshev", "cg" };

std::vector<std::string> namesWithoutSolution(const std::vector<smg::ColumnSpec>& specs)
{
  std::vector<std::string> names;
  for (const smg::ColumnSpec& spec : specs)
  {
    if (spec.name != SolutionName)
    {
      names.push_back(spec.name);
    }
  }
  return names;
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
    this->addSolverOptions(command, "The mesh with its solution: .vsm, .ply, .vtp or .vtu",
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
        "How V-cycles converge faster: automatic, none, chebyshev or cg")
      ->check(oneOf(Accelerations))
      ->default_str(Accelerations.front());
    command.add_option("--problem", this->File, "The problem, a JSON file")
      ->required()
      ->type_name("FILE");
  }

protected:
  void checkOutputName() const override
  {
    if (smg::kindOfOutput(this->Out) == smg::MeshFileKind::Stream)
    {
      throw smg::Error(this->Out.string() +
                       ": this format has no room for a solution: write it as .vsm, .ply, .vtp or "
                       ".vtu.");
    }
    smg::checkOutput(this->Out);
  }

  void readTask() override
  {
    smg::checkOptions(this->Solve);
    smg::checkOperators(this->Solve);
    this->Data = smg::readProblemFileData(this->File);
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    smg::checkOutput(this->Out, mesh.info().cellType);
    smg::RegionProblem problem(std::move(this->Data), mesh.info(), this->File.string());
    problem.check(*mesh.source(problem.vertexColumns(), {}));
    this->applyTo(this->Solve, std::move(progress));
    return smg::solve(
      *mesh.source(problem.vertexColumns(), problem.cellColumns()), problem, this->Solve);
  }

  std::vector<std::string> write(const smg::VsmReader& mesh, smg::Solution& solution,
    const smg::ProgressFunction& progress) const override
  {
    const smg::ColumnSpec spec{ SolutionName, smg::ScalarType::Float64, solution.columns() };
    smg::AddedColumn source(mesh.source(namesWithoutSolution(mesh.info().vertexColumns),
                              namesWithoutSolution(mesh.info().cellColumns)),
      smg::AddedColumn::Vertices, spec,
      [&solution](const smg::MeshBlock& block, smg::Column& column)
      { solution.read(block.firstVertex, block.vertices(), column.as<double>()); });
    smg::WriteMeshOptions options;
    options.scratch = this->scratch;
    options.isolatedFrom = mesh.path();
    options.progress = progress;
    return smg::writeMesh(source, this->Out, options);
  }

  const smg::SolveOptions& solveOptions() const override { return this->Solve; }

private:
  smg::RegionProblemData Data; ///< what the file says
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
