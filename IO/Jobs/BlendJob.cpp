// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/MeshJob.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Blend.h"
#include "smg/SolvedMesh.h"

namespace smg
{
namespace
{

/** Blends columns of the vertices between patches. */
class BlendJob : public SolvingJob
{
public:
  BlendDescription description;
  SolveOptions solving;

  using SolvingJob::options;
  SolveOptions& options() override { return this->solving; }
  std::span<const JobOption> table() const override;
  void check() const override;
  std::string resultHelp() const override
  {
    return meshWith("the blended columns") +
           "; and of other formats, if they have places for the columns";
  }
  std::string resultColumns() const override { return "these columns of vertices"; }
  std::vector<std::string> changedColumns() const override { return this->description.columns; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;
};

/** In the order of SeamGradient. */
constexpr const char* SeamNames[] = { "zero", "average" };

template <class Value, auto Member>
constexpr OptionMember<Value> BlendMember =
  memberOf<Value, BlendJob, &BlendJob::description, Member>;

constexpr auto BlendTable = joined(
  std::array{
    JobOption{ .key = "patch",
      .kind = ColumnOption{ BlendMember<std::string, &BlendDescription::patch> },
      .help = "Column of one component with the patch of each vertex, or of each cell; any numbers "
              "name patches",
      .isRequired = true },
    JobOption{ .key = "columns",
      .kind = ColumnsOption{ BlendMember<std::vector<std::string>, &BlendDescription::columns> },
      .help = "Columns of the vertices to blend, of any numeric type, with at most 64 components "
              "together",
      .isRequired = true,
      .property = "Arrays" },
    JobOption{ .key = "hold",
      .kind = WhereOption{ BlendMember<std::vector<Where>, &BlendDescription::hold> },
      .help = "Parts of the mesh that keep their values" },
    JobOption{ .key = "anchor",
      .kind = NumberOption{ BlendMember<double, &BlendDescription::anchor>, { 0.0 } },
      .help = "How strongly all values are pulled towards the original ones: corrections over less "
              "than 1 / sqrt(anchor) diagonals of the bounding box are hardly pulled; 0: not at "
              "all" },
    JobOption{ .key = "seam",
      .kind = ChoiceOption{ BlendMember<std::size_t, &BlendDescription::seam>, SeamNames },
      .help = "Gradients between patches: zero, or the average of those on both sides",
      .property = "SeamGradient" },
  },
  ToleranceOptions, SolverOptions, LimitOptions, ScratchLimitOption);

std::span<const JobOption> BlendJob::table() const
{
  return BlendTable;
}

void BlendJob::check() const
{
  checkOptions(this->solving);
  refuseAutomaticTolerance(this->solving, "a blend");
}

std::vector<ColumnSpec> BlendJob::solutionColumns(const StreamInfo& info) const
{
  return blendedColumns(info, this->description);
}

Costs BlendJob::costsOn(const StreamInfo& info) const
{
  // The columns of a mesh file that is not a .vsm are not known before it is read.
  constexpr int Usual = 3;
  int components = 0;
  for (const std::string& column : this->description.columns)
  {
    components += expectedComponents(info, column, Usual);
  }
  return blendCosts(info, components, this->description.seam, this->solving);
}

AddedValues BlendJob::addedTo(const StreamInfo& info) const
{
  return replacedIn(info, this->description.columns);
}

std::unique_ptr<Solution> BlendJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  this->complete(mesh, progress);
  return blend(mesh, this->description, this->solving);
}

void BlendJob::passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
  Report& /*report*/, const ProgressFunction& progress) const
{
  ReplacedColumns source(mesh, solution, this->solutionColumns(mesh.info()));
  read(source, progress);
}

std::string BlendJob::fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
{
  return vertices == 1 ? "keeps its values." : "keep their values.";
}

} // namespace

std::unique_ptr<Job> makeBlendJob()
{
  return std::make_unique<BlendJob>();
}

} // namespace smg
