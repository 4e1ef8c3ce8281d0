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
    this->From.addTo(
      command, "The sources, or with --wall the wall, which is the whole boundary by default");
    command.add_flag("--wall", this->Job.description.wall,
      "Of tetrahedra: the Euclidean distance to the boundary instead of that along paths");
    command.add_flag("--source", this->Job.description.source,
      "Add the column DistanceSource: the number of the nearest source vertex");
    command.add_flag("--group", this->Job.description.group,
      "Add the column DistanceGroup: which WHERE the nearest source is of, from 0");
    command.add_flag("--direction", this->Job.description.direction,
      "Add the column DistanceDirection: the unit gradient of the distance");
    this->To.addTo(command,
      "Of exact distances on a surface: vertices whose shortest paths are wanted, in the report");
    command.add_option("--path", this->PathFile,
      "Write the shortest paths to the vertices of --to as polylines: .vtp or .obj");
    command
      .add_option_function<std::string>(
        "--accuracy",
        [this](const std::string& name)
        {
          this->Job.description.accuracy = name == "exact"         ? smg::PathAccuracy::Exact
                                           : name == "approximate" ? smg::PathAccuracy::Approximate
                                                                   : smg::PathAccuracy::Automatic;
        },
        "Of paths on a surface: exact (10 to 50 us a vertex of a scan, more on smooth ones), "
        "approximate (about 1 us, too long on "
        "long thin triangles), or auto: exact up to 1,000,000 vertices")
      ->check(oneOf({ "auto", "exact", "approximate" }))
      ->default_str("auto");
    command
      .add_option("--within", this->Job.description.within,
        "Of paths, in the unit of the mesh: vertices farther than this are not reached")
      ->check(CLI::Validator(
        [](const std::string& text)
        {
          double length = 0.0;
          const bool isLength = CLI::detail::lexical_cast(text, length) && length > 0.0;
          return isLength ? std::string() : '\'' + text + "' is no length above 0";
        },
        ""));
    command
      .add_option(
        "--max-passes", this->Job.options.maxPasses, "Maximum number of passes over the mesh")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
    this->addInputAndCommon(command, this->Job.options.memoryLimit);
    command.footer(
      "WHERE is one of {\"vertices\": [numbers]}, {\"nearest\": [[x, y, z], ...]}, "
      "{\"boundary\": true}, {\"sphere\": [x, y, z, r]}, {\"box\": [x0, y0, z0, x1, y1, z1]}, "
      "{\"halfspace\": [nx, ny, nz, d]}, {\"tag\": [\"column\", value]}, {\"mask\": \"column\"}");
  }

  void checkUsage() const override
  {
    if (!this->From.isGiven() && !this->Job.description.wall)
    {
      throw CLI::RequiredError("--from or --wall");
    }
    if (!this->PathFile.empty() && !this->To.isGiven())
    {
      throw CLI::RequiresError("--path", "--to");
    }
  }

protected:
  smg::DistanceJob& job() override { return this->Job; }

  smg::UsedFiles files() const override
  {
    smg::UsedFiles files = this->MeshCommand::files();
    this->From.addFiles(files);
    this->To.addFiles(files);
    files.write(this->PathFile, "file of paths");
    return files;
  }

  void readTask() override
  {
    this->Job.description.from = this->From.places();
    this->Job.description.to = this->To.places();
    this->Job.name = "distance";
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
  PlacesOption From{ "--from" }, To{ "--to" };
  std::string PathFile;
  smg::DistanceJob Job;
};

} // namespace

void addDistanceCommand(CLI::App& program, Action& action)
{
  addCommand<DistanceCommand>(
    program, action, "distance", "Measure the distance of all vertices from some of them");
}
