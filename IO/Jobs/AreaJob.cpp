// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/MeshJob.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Area.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <iomanip>
#include <ranges>
#include <sstream>

namespace smg
{
namespace
{

/** Sums up areas or volumes: of each vertex, by tags, in all. */
class AreaJob : public SolvingJob
{
public:
  AreaJob() { this->name = "area"; }

  AreaDescription description;
  SolveOptions running; ///< without what solves

  using SolvingJob::options;
  SolveOptions& options() override { return this->running; }
  std::span<const JobOption> table() const override;
  void check() const override {}
  std::string resultHelp() const override
  {
    return meshWith("the share of each vertex, the column Area or Volume");
  }
  std::string resultColumns() const override { return "an area"; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string found(const Report& report) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;
};

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

std::string AreaJob::found(const Report& report) const
{
  constexpr std::size_t Shown = 20;
  const Report::Areas& areas = *report.areas;
  std::ostringstream text;
  text << std::setprecision(9) << report.vertices << " vertices, "
       << counted(areas.cells, "cell", "cells");
  for (const Report::Area& part : areas.by_tag | std::views::take(Shown))
  {
    text << "\n  tag " << shortest(part.tag) << ": " << counted(part.cells, "cell", "cells") << ", "
         << (areas.isVolume ? "volume " : "area ") << part.area;
  }
  if (areas.by_tag.size() > Shown)
  {
    text << "\n  and " << areas.by_tag.size() - Shown << " more tags, which the report has";
  }
  return text.str();
}

std::string AreaJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "has no area." : "have no area.";
}

} // namespace

std::unique_ptr<Job> makeAreaJob()
{
  return std::make_unique<AreaJob>();
}

} // namespace smg
