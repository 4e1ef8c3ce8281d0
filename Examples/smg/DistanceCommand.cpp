// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCommand.h"

#include "IO/Formats/MeshFile.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Results/PathFile.h"
#include "Solver/Files/FileDescriptor.h"

#include <cstdio>

namespace
{

class DistanceCommand : public MeshCommand
{
public:
  using MeshCommand::MeshCommand;

  void addOptions(CLI::App& command) override
  {
    this->MeshCommand::addOptions(command);
    command.add_option("--path", this->PathFile,
      "Write the shortest paths to the vertices of --to as polylines: .vtp or .obj");
  }

  void checkUsage() const override
  {
    if (!this->isGiven("from") &&
        !static_cast<const smg::DistanceJob&>(this->job()).description.wall)
    {
      throw CLI::RequiredError("--from or --wall");
    }
    if (!this->PathFile.empty() && !this->isGiven("to"))
    {
      throw CLI::RequiresError("--path", "--to");
    }
  }

protected:
  smg::UsedFiles files() const override
  {
    smg::UsedFiles files = this->MeshCommand::files();
    files.write(this->PathFile, "file of paths");
    return files;
  }

  void readTask() override
  {
    if (!this->PathFile.empty())
    {
      smg::checkPathFile(this->PathFile);
      smg::FileDescriptor::createBeside(this->PathFile); // removed at once: it can be written
    }
  }

  void writeMore(const smg::Report& report) const override
  {
    if (!this->PathFile.empty())
    {
      smg::writePaths(this->PathFile, report.distance->paths);
    }
  }

  void warn(const smg::Report& report) const override
  {
    this->MeshCommand::warn(report);
    if (!report.converged)
    {
      std::fprintf(stderr,
        "smg: warning: not settled: after %d passes some distances are too large; raise "
        "--max-passes\n",
        report.passes);
    }
  }

private:
  std::string PathFile;
};

} // namespace

void addDistanceCommand(CLI::App& program, Action& action, const smg::JobKind& kind)
{
  addCommand<DistanceCommand>(program, action, kind.name, kind.help, kind);
}
