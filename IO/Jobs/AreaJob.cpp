// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/AreaJob.h"

#include "IO/Jobs/JobOption.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

namespace smg
{
namespace
{

/** In the order of AreaShare. */
constexpr const char* ShareNames[] = { "equal", "voronoi" };

template <class Value, auto Member>
constexpr OptionMember<Value> AreaMember = memberOf<Value, AreaJob, &AreaJob::description, Member>;

constexpr auto AreaTable = joined(
  std::array{
    JobOption{ .key = "tag",
      .kind = ColumnOption{ AreaMember<std::string, &AreaDescription::tag> },
      .help = "Column of the cells of one component by whose values areas are summed, at most "
              "65,536" },
    JobOption{ .key = "of",
      .kind = WhereOption{ AreaMember<std::vector<Where>, &AreaDescription::of> },
      .help =
        "Parts of the mesh: a cell counts if all of its corners lie in one of them; a column of "
        "the cells selects cells; without it all cells count" },
    JobOption{ .key = "share",
      .kind = ChoiceOption{ AreaMember<std::size_t, &AreaDescription::share>, ShareNames },
      .help = "What a vertex has of its cells: equal shares, or of triangles voronoi, what is "
              "nearest to it" },
    JobOption{ .key = "scale",
      .kind = NumberOption{ AreaMember<double, &AreaDescription::scale>,
        { .least = 0.0, .isOpen = true } },
      .help = "By which lengths are multiplied: 0.001 for a mesh in millimetres and areas in "
              "square metres" },
  },
  LimitOptions, ScratchLimitOption);

} // namespace

std::span<const JobOption> AreaJob::table() const
{
  return AreaTable;
}

std::vector<ColumnSpec> AreaJob::solutionColumns(const StreamInfo& info) const
{
  return { areaColumn(info) };
}

void AreaJob::checkOn(const StreamInfo& info) const
{
  this->MeshJob::checkOn(info);
  if (this->description.share == AreaShare::Voronoi && info.cellType == CellType::Tetrahedron)
  {
    throw Error("share: voronoi is for triangles: share tetrahedra equally.");
  }
}

/** Points and shares of open vertices; a reading takes what it does in other jobs. */
Costs AreaJob::costsOn(const StreamInfo& info) const
{
  constexpr std::int64_t Least = std::int64_t(1) << 20, OfOpenVertex = 72;
  constexpr double CellSeconds = 0.04e-6;
  const std::int64_t values = static_cast<std::int64_t>(sizeof(double)) * info.vertices;
  Costs costs;
  costs.memory = Least + OfOpenVertex * info.span;
  costs.scratch = costs.kept = values;
  costs.passes = this->description.of.empty() ? 1 : 2;
  costs.seconds = costs.passes * CellSeconds * static_cast<double>(info.cells);
  return costs;
}

AddedValues AreaJob::addedTo(const StreamInfo& info) const
{
  return { { areaColumn(info) }, {} };
}

std::unique_ptr<Solution> AreaJob::solveOn(const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  return area(mesh, this->description, this->running, this->name);
}

void AreaJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  ReplacedColumns result(mesh, solution, { areaColumn(mesh.info()) }, {});
  read(result, progress);
}

std::string AreaJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "has no area." : "have no area.";
}

} // namespace smg
