// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Results/PathFile.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include <cstdio>
#include <ranges>

namespace
{

class DistanceCommand : public MeshCommand
{
public:
  DistanceCommand()
    : MeshCommand("measuring")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addFiles(command,
      "The mesh with its distances: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " in stream order; of a mesh file IN, " +
        smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded");
    this->addJobOptions(command);
    command.add_option("--path", this->PathFile,
      "Write the shortest paths to the vertices of --to as polylines: .vtp or .obj");
    this->addInputAndCommon(command);
    command.footer(
      "WHERE is one of {\"vertices\": [numbers]}, {\"nearest\": [[x, y, z], ...]}, "
      "{\"boundary\": true}, {\"sphere\": [x, y, z, r]}, {\"box\": [x0, y0, z0, x1, y1, z1]}, "
      "{\"halfspace\": [nx, ny, nz, d]}, {\"tag\": [\"column\", value]}, {\"mask\": \"column\"}");
  }

  void checkUsage() const override
  {
    if (!this->isGiven("from") && !this->Job.description.wall)
    {
      throw CLI::RequiredError("--from or --wall");
    }
    if (!this->PathFile.empty() && !this->isGiven("to"))
    {
      throw CLI::RequiresError("--path", "--to");
    }
  }

protected:
  smg::DistanceJob& job() override { return this->Job; }

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

  void print(const smg::Report& report) const override
  {
    const smg::Report::Distance& found = *report.distance;
    const std::string sources = this->Job.description.wall ? "wall face" : "source";
    std::printf("%lld vertices, %s, %lld %s, %d pass%s (the mesh read %.2f times)\n",
      static_cast<long long>(report.vertices), smg::counted(report.cells, "cell", "cells").c_str(),
      static_cast<long long>(found.sources), (found.sources == 1 ? sources : sources + "s").c_str(),
      report.passes, report.passes == 1 ? "" : "es", found.mesh_readings);
    std::printf("  %s distance: maximum %.6g, mean %.6g", found.exact ? "exact" : "approximate",
      found.maximum, found.mean);
    if (found.unreached > 0)
    {
      std::printf(", %s not reached", smg::counted(found.unreached, "vertex", "vertices").c_str());
    }
    std::printf("\n");
    constexpr std::size_t Shown = 10;
    for (const smg::Report::Path& path : found.paths | std::views::take(Shown))
    {
      const std::string end = "  path to vertex " + std::to_string(path.to);
      path.points.empty() ? std::printf("%s: none\n", end.c_str())
                          : std::printf("%s: from %lld, length %.6g, %s\n", end.c_str(),
                              static_cast<long long>(path.from), path.length,
                              smg::counted(std::ssize(path.points), "point", "points").c_str());
    }
    if (found.paths.size() > Shown)
    {
      std::printf("  and %zu more paths\n", found.paths.size() - Shown);
    }
  }

private:
  std::string PathFile;
  smg::DistanceJob Job;
};

} // namespace

void addDistanceCommand(CLI::App& program, Action& action)
{
  addJobCommand<DistanceCommand>(program, action, "distance");
}
