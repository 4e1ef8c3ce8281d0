// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/SmoothJob.h"

namespace
{

class SmoothCommand : public SolvingCommand
{
public:
  SmoothCommand()
    : SolvingCommand("smoothing")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The smoothed mesh: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " with all columns of IN; or, of smoothed positions, any other format that is written. The "
        "order of IN is kept wherever the format can have it");
  }

  void checkUsage() const override { this->Job.check(); }

protected:
  smg::SmoothJob& job() override { return this->Job; }

private:
  smg::SmoothJob Job;
};

} // namespace

void addSmoothCommand(CLI::App& program, Action& action)
{
  addJobCommand<SmoothCommand>(program, action, "smooth");
}
