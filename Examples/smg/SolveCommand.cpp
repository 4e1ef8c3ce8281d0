// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

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
  using EngineCommand::EngineCommand;

  void addOptions(CLI::App& command) override
  {
    this->EngineCommand::addOptions(command);
    this->addCheckpointTo(command);
    this->addEngineTo(command);
    command.add_option("--problem", this->File, "The problem, a JSON file")
      ->required()
      ->type_name("FILE");
    command.footer(problemHelp());
  }

  void checkUsage() const override
  {
    smg::checkOptions(this->asked().solving);
    smg::checkOperators(this->asked().solving);
  }

protected:
  void computeOn(const DistributedEngine& engine, const DistributedJob& job) override
  {
    if (this->asked().solving.tolerance == smg::SolveOptions::AutomaticTolerance)
    {
      throw smg::Error("--tolerance auto is for --engine streaming: give a number");
    }
    DistributedSolve solve;
    solve.read = [this]
    {
      this->readJob();
      return this->asked().description;
    };
    solve.tolerance = this->asked().solving.tolerance;
    return engine.solve(job, solve);
  }

  smg::SolveJob& asked() { return static_cast<smg::SolveJob&>(this->job()); }
  const smg::SolveJob& asked() const { return static_cast<const smg::SolveJob&>(this->job()); }

  void readTask() override
  {
    this->asked().description = smg::readProblemText(this->readText(), this->File.string());
    this->announceCheckpoint("pass");
  }
};

} // namespace

void addSolveCommand(CLI::App& program, Action& action, const smg::JobKind& kind)
{
  addCommand<SolveCommand>(program, action, kind.name, kind.help, kind);
}
