// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/SmoothJob.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/MovedResult.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Error.h"
#include "smg/Smooth.h"
#include "smg/SolvedMesh.h"

#include <algorithm>

namespace smg
{
namespace
{

/** In the order of SmoothedBoundary. */
constexpr const char* BoundaryNames[] = { "smooth", "fixed", "free" };

template <class Value, auto Member>
constexpr OptionMember<Value> SmoothMember =
  memberOf<Value, SmoothJob, &SmoothJob::smoothing, Member>;

constexpr auto SmoothTable = joined(
  std::array{
    JobOption{ .key = "size",
      .kind = SizeOption{ SmoothMember<SmoothingSize, &Smoothing::size> },
      .help = "Size of the details that are halved: in the unit of the mesh, in % of the diagonal "
              "of its bounds, or in mean edges, as 6edges" },
    JobOption{ .key = "steps",
      .kind = CountOption{ SmoothMember<std::int64_t, &Smoothing::steps>, 1, 1000 },
      .help = "Implicit steps" },
    JobOption{ .key = "keep_edges",
      .kind = NumberOption{ SmoothMember<double, &Smoothing::keepEdges>, { 0.0, 180.0, true },
        "degrees" },
      .help = "Keep edges at which the surface turns by more than this angle, about 30 for "
              "machined parts; with about 5 steps",
      .property = "" },
    JobOption{ .key = "keep_volume",
      .kind = FlagOption{ SmoothMember<bool, &Smoothing::keepVolume> },
      .help = "Move the surface along its normals so that it keeps its volume" },
    JobOption{ .key = "orient",
      .kind = FlagOption{ SmoothMember<bool, &Smoothing::orient> },
      .help = "Turn triangles of the result so that those of a body are wound alike, and outwards "
              "if it is closed",
      .property = "" },
    JobOption{ .key = "hold",
      .kind = WhereOption{ SmoothMember<std::vector<Where>, &Smoothing::hold> },
      .help = "Parts of the mesh that do not move" },
    JobOption{ .key = "boundary",
      .kind = ChoiceOption{ SmoothMember<std::size_t, &Smoothing::boundary>, BoundaryNames },
      .help = "Boundary of a surface: smooth, as curves (default of positions), fixed, or free "
              "(default of a column)" },
    JobOption{ .key = "column",
      .kind = ColumnOption{ SmoothMember<std::string, &Smoothing::column> },
      .help = "Smooth this column of the vertices instead of their positions",
      .excludes = { "keep_edges", "keep_volume", "orient" },
      .property = "Array" },
  },
  excluding(NormalsOption<SmoothJob>, "normals", "column"), ToleranceOptions, SolverOptions,
  LimitOptions, ScratchLimitOption);

} // namespace

std::span<const JobOption> SmoothJob::table() const
{
  return SmoothTable;
}

std::string SmoothJob::resultHelp() const
{
  return "The smoothed mesh: " + suffixList(FormatUse::WriteColumns, "or") +
         " with all columns of IN; or, of smoothed positions, any other format that is written. "
         "The order of IN is kept wherever the format can have it";
}

std::string SmoothJob::resultColumns() const
{
  return this->smoothing.column.empty() ? std::string() : "the column " + this->smoothing.column;
}

std::vector<std::string> SmoothJob::changedColumns() const
{
  return this->smoothing.column.empty() ? std::vector<std::string>{}
                                        : std::vector{ this->smoothing.column };
}

std::vector<ColumnSpec> SmoothJob::solutionColumns(const StreamInfo& info) const
{
  if (this->smoothing.column.empty())
  {
    return { PositionSpec };
  }
  const auto found =
    std::ranges::find(info.vertexColumns, this->smoothing.column, &ColumnSpec::name);
  if (found == info.vertexColumns.end())
  {
    throw Error("'" + this->smoothing.column + "': the vertices have no column of this name");
  }
  return { *found };
}

bool SmoothJob::keeps(const ColumnSpec& column, const StreamInfo& info) const
{
  return !this->smoothing.column.empty() || keepsMoved(column, this->normals, info.cellType);
}

void SmoothJob::checkOn(const StreamInfo& info) const
{
  this->MeshJob::checkOn(info);
  if (this->smoothing.column.empty() && info.cellType == CellType::Tetrahedron)
  {
    throw Error("the positions of tetrahedra cannot be smoothed, only those of triangles: name a "
                "column.");
  }
}

Costs SmoothJob::costsOn(const StreamInfo& info) const
{
  constexpr int OfPoints = 3;
  return smoothCosts(
    info, expectedComponents(info, this->smoothing.column, OfPoints), this->smoothing);
}

AddedValues SmoothJob::addedTo(const StreamInfo& info) const
{
  AddedValues added = replacedIn(info, this->changedColumns());
  added.movesVertices = this->smoothing.column.empty();
  return added;
}

std::unique_ptr<Solution> SmoothJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  return smooth(mesh, this->smoothing, this->smoothing);
}

void SmoothJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  if (!this->smoothing.column.empty())
  {
    ReplacedColumns smoothed(mesh, solution, this->solutionColumns(mesh.info()));
    read(smoothed, progress);
    return;
  }
  const MovedMesh moved(
    mesh, solution, this->normals, normalsOptions(*this, partOf(progress, 0.0, NormalsShare)));
  read(*moved.source(), partOf(progress, NormalsShare, 1.0));
}

} // namespace smg
