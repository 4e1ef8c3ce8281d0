// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/SolveJob.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

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
      this->Job.solving);
    command
      .add_option_function<std::string>(
        "--tolerance",
        [this](const std::string& given)
        {
          this->Job.solving.tolerance =
            given == Automatic ? smg::SolveOptions::AutomaticTolerance : std::stod(given);
        },
        "Relative residual to stop at, between 0 and 1; auto: until the algebraic error is below a "
        "tenth of the estimated discretisation error")
      ->check([](const std::string& given)
        { return given == Automatic ? std::string() : checkTolerance(given); })
      ->type_name("FLOAT|auto")
      ->default_str(CLI::detail::to_string(this->Job.solving.tolerance));
    this->addCheckpointTo(command);
    command
      .add_option_function<std::string>(
        "--acceleration",
        [this](const std::string& name)
        {
          const auto place = std::find(Accelerations.begin(), Accelerations.end(), name);
          this->Job.solving.acceleration =
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
    smg::checkOptions(this->Job.solving);
    smg::checkOperators(this->Job.solving);
  }

protected:
  void computeOn(const DistributedEngine& engine, const DistributedJob& job) override
  {
    if (this->Job.solving.tolerance == smg::SolveOptions::AutomaticTolerance)
    {
      throw smg::Error("--tolerance auto is for --engine streaming: give a number");
    }
    DistributedSolve solve;
    solve.read = [this]
    {
      this->readTask();
      return this->Job.description;
    };
    solve.tolerance = this->Job.solving.tolerance;
    return engine.solve(job, solve);
  }

  smg::SolveJob& job() override { return this->Job; }

  void readTask() override
  {
    this->Job.description = smg::readProblemText(this->readText(), this->File.string());
    this->Job.check();
    this->announceCheckpoint("pass");
  }

private:
  smg::SolveJob Job;
};

} // namespace

void addSolveCommand(CLI::App& program, Action& action)
{
  addCommand<SolveCommand>(program, action, "solve", "Solve a Poisson problem on a mesh");
}
