// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/DistanceJob.h"

#include "IO/Jobs/JobOption.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <iomanip>
#include <ranges>
#include <sstream>

namespace smg
{
namespace
{

/** In the order of PathAccuracy. */
constexpr const char* AccuracyNames[] = { "auto", "exact", "approximate" };

template <class Value, auto Member>
constexpr OptionMember<Value> DistanceMember =
  memberOf<Value, DistanceJob, &DistanceJob::description, Member>;

constexpr auto DistanceTable = joined(
  std::array{
    JobOption{ .key = "from",
      .kind = WhereOption{ DistanceMember<std::vector<Where>, &DistanceDescription::from> },
      .help = "The sources, where the distance is 0; of distances to a wall the wall, which is the "
              "whole boundary by default" },
    JobOption{ .key = "wall",
      .kind = FlagOption{ DistanceMember<bool, &DistanceDescription::wall> },
      .help = "Of tetrahedra: the Euclidean distance to the boundary instead of that along paths" },
    JobOption{ .key = "source",
      .kind = FlagOption{ DistanceMember<bool, &DistanceDescription::source> },
      .help =
        "Add the column DistanceSource (int64): the number of the nearest source in the file, of "
        "distances to a wall of a corner of the nearest wall face; -1 where none is reached" },
    JobOption{ .key = "group",
      .kind = FlagOption{ DistanceMember<bool, &DistanceDescription::group> },
      .help =
        "Add the column DistanceGroup (int32): which of the sources, as they are listed, the "
        "nearest one is of, from 0; of what several select the first; -1 where none is reached" },
    JobOption{ .key = "direction",
      .kind = FlagOption{ DistanceMember<bool, &DistanceDescription::direction> },
      .help = "Add the column DistanceDirection (3 x float64): the unit gradient of the distance" },
    JobOption{ .key = "to",
      .kind = WhereOption{ DistanceMember<std::vector<Where>, &DistanceDescription::to> },
      .help = "Of exact distances on a surface: vertices whose shortest paths are wanted, at most "
              "1,000",
      .excludes = { "wall" } },
    JobOption{ .key = "accuracy",
      .kind =
        ChoiceOption{ DistanceMember<std::size_t, &DistanceDescription::accuracy>, AccuracyNames },
      .help = "Of paths on a surface: exact (10 to 50 us a vertex of a scan, more on smooth ones), "
              "approximate (about 1 us, too long on long thin triangles), or auto: exact up to "
              "1,000,000 vertices",
      .excludes = { "wall" } },
    JobOption{ .key = "within",
      .kind = NumberOption{ DistanceMember<double, &DistanceDescription::within>,
        { .least = 0.0, .isOpen = true }, "the unit of the mesh" },
      .help = "Of paths: vertices farther than this are not reached",
      .excludes = { "wall" } },
    JobOption{ .key = "max_passes",
      .kind =
        CountOption{
          memberOf<std::int64_t, DistanceJob, &DistanceJob::options, &DistanceOptions::maxPasses>,
          1, 1000000 },
      .help = "Maximum number of passes over the mesh",
      .isAdvanced = true,
      .excludes = { "wall" },
      .property = "MaximumPasses" },
  },
  LimitOptions, ScratchLimitOption);

} // namespace

std::span<const JobOption> DistanceJob::table() const
{
  return DistanceTable;
}

void DistanceJob::check() const
{
  if (this->description.from.empty() && !this->description.wall)
  {
    throw Error(this->name + ": needs \"from\", or \"wall\".");
  }
}

void DistanceJob::setLimits(const JobLimits& limits)
{
  this->options.memoryLimit = limits.memory > 0 ? limits.memory : this->options.memoryLimit;
  this->options.threads = limits.threads;
  this->options.scratch = limits.scratch;
  this->options.scratchLimit = limits.scratchLimit;
}

std::vector<ColumnSpec> DistanceJob::solutionColumns(const StreamInfo& /*info*/) const
{
  return distanceColumns(this->description);
}

void DistanceJob::checkOn(const StreamInfo& info) const
{
  this->MeshJob::checkOn(info);
  if (this->description.wall && info.cellType == CellType::Triangle)
  {
    throw Error(
      "wall: the distance to walls is that of a tetrahedral mesh, but this one has triangles.");
  }
  if (!this->description.to.empty() && !isExactDistance(info, this->description))
  {
    throw Error("to: shortest paths are those of exact distances on a surface.");
  }
}

Costs DistanceJob::costsOn(const StreamInfo& info) const
{
  return distanceCosts(info, this->description);
}

AddedValues DistanceJob::addedTo(const StreamInfo& /*info*/) const
{
  return { distanceColumns(this->description), {} };
}

std::unique_ptr<Solution> DistanceJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->options.progress = progress;
  return distance(mesh, this->description, this->options, this->name);
}

void DistanceJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  // Sources and directions of other distances would be taken for those of these.
  ReplacedColumns result(mesh, solution, distanceColumns(this->description),
    { DistanceSourceName, DistanceGroupName, DistanceDirectionName });
  read(result, progress);
}

bool DistanceJob::keeps(const ColumnSpec& column, const StreamInfo& /*info*/) const
{
  return column.name != DistanceSourceName && column.name != DistanceGroupName &&
         column.name != DistanceDirectionName;
}

std::string DistanceJob::found(const Report& report) const
{
  constexpr std::size_t Shown = 10;
  const Report::Distance& found = *report.distance;
  const std::string source = this->description.wall ? "wall face" : "source";
  std::ostringstream text;
  text << report.vertices << " vertices, " << counted(report.cells, "cell", "cells") << ", "
       << counted(found.sources, source, source + 's') << ", "
       << counted(report.passes, "pass", "passes") << " (the mesh read " << std::fixed
       << std::setprecision(2) << found.mesh_readings << " times)\n  " << std::defaultfloat
       << std::setprecision(6) << (found.exact ? "exact" : "approximate") << " distance: maximum "
       << found.maximum << ", mean " << found.mean;
  if (found.unreached > 0)
  {
    text << ", " << counted(found.unreached, "vertex", "vertices") << " not reached";
  }
  for (const Report::Path& path : found.paths | std::views::take(Shown))
  {
    text << "\n  path to vertex " << path.to << ": ";
    if (path.points.empty())
    {
      text << "none";
      continue;
    }
    text << "from " << path.from << ", length " << path.length << ", "
         << counted(std::ssize(path.points), "point", "points");
  }
  if (found.paths.size() > Shown)
  {
    text << "\n  and " << found.paths.size() - Shown << " more paths";
  }
  return text.str();
}

std::string DistanceJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "is not reached." : "are not reached.";
}

} // namespace smg
