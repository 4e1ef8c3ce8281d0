// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/BlendJob.h"

namespace
{

class BlendCommand : public SolvingCommand
{
public:
  BlendCommand()
    : SolvingCommand("blending")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The mesh with the blended columns: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " in stream order; of a mesh file IN, " +
        smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded; "
        "and of other formats, if they have places for the columns");
    command.footer("Steps of the columns between patches are removed; inside the patches their "
                   "gradients are kept. docs/blend.md explains it");
  }

  void checkUsage() const override { this->Job.check(); }

protected:
  smg::BlendJob& job() override { return this->Job; }

private:
  smg::BlendJob Job;
};

} // namespace

void addBlendCommand(CLI::App& program, Action& action)
{
  addJobCommand<BlendCommand>(program, action, "blend");
}
