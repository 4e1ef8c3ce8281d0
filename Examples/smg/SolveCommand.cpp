// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/SolveJob.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

namespace
{

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
        " in the order of IN, unless that has a column OriginalId or points are welded");
    this->addCheckpointTo(command);
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
      this->readJob();
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
  addJobCommand<SolveCommand>(program, action, "solve");
}
