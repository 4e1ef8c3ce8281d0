// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/DeformJob.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/MovedResult.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/DescribedHandles.h"
#include "smg/Error.h"

namespace smg
{
namespace
{

/** In the order of Weights. */
constexpr const char* WeightsNames[] = { "uniform", "cotangent", "clamped" };

template <class Value, auto Member>
constexpr OptionMember<Value> DeformMember =
  memberOf<Value, DeformJob, &DeformJob::deforming, Member>;

/** A number of V-cycles counts instead of a tolerance. */
constexpr OptionMember<double> DeformTolerance{ solverMember<double, &SolveOptions::tolerance>.get,
  [](Job& job, double tolerance)
  {
    DeformOptions& options = static_cast<DeformJob&>(job).deforming;
    options.tolerance = tolerance;
    options.cycles = 0;
  } };

constexpr OptionMember<std::int64_t> DeformCycles{ [](const Job& job)
  {
    const int cycles = static_cast<const DeformJob&>(job).deforming.cycles;
    return cycles > 0 ? std::optional<std::int64_t>(cycles) : std::nullopt;
  },
  DeformMember<std::int64_t, &DeformOptions::cycles>.set };

constexpr auto DeformTable = joined(
  std::array{
    JobOption{ .key = "handles",
      .kind = DescriptionOption{ [](const JsonNode& node, Job& job)
        {
          auto& deform = static_cast<DeformJob&>(job);
          deform.description = parseDeformation(node);
          deform.description.applyTo(deform.deforming);
          deform.text = node.value().dump();
        } },
      .help = "The handles, in a JSON file",
      .isRequired = true },
    JobOption{ .key = "weights",
      .kind = ChoiceOption{ DeformMember<std::size_t, &DeformOptions::weights>, WeightsNames,
        "raw-cotangent", static_cast<std::size_t>(Weights::Cotangent) },
      .help = "Weights of the edges, instead of those of the handle file: clamped, cotangent "
              "(finite elements) or uniform",
      .property = "" },
    JobOption{ .key = "tolerance",
      .kind = NumberOption{ DeformTolerance, { 0.0, 1.0, true } },
      .help = "Relative residual at which each of the two steps stops, instead of that which the "
              "handle file may name" },
    JobOption{ .key = "cycles",
      .kind = CountOption{ DeformCycles, 1, 1000000 },
      .help = "V-cycles of each of the two steps, instead of a tolerance",
      .isAdvanced = true,
      .excludes = { "tolerance" } },
  },
  NormalsOption<DeformJob>, excluding(SolverOptions, "max_cycles", "cycles"), LimitOptions,
  ScratchLimitOption, CheckpointOption);

} // namespace

std::span<const JobOption> DeformJob::table() const
{
  return DeformTable;
}

void DeformJob::check() const
{
  if (this->deforming.cycles > 0 && this->deforming.maxCycles != DeformOptions().maxCycles)
  {
    throw Error(
      "max_cycles: does not go with cycles, which " + this->name + " may state: leave one out.");
  }
}

std::string DeformJob::resultHelp() const
{
  return "The deformed mesh: " + suffixList(FormatUse::Write, "or") +
         " in stream order; of a mesh file IN, " + suffixList(FormatUse::Restore, "and") +
         " in the order of IN, unless that has a column OriginalId or points are welded. From "
         ".vsm, and from a streaming format to a streaming format, the order is kept";
}

std::vector<ColumnSpec> DeformJob::solutionColumns(const StreamInfo& /*info*/) const
{
  return { PositionSpec };
}

bool DeformJob::keeps(const ColumnSpec& column, const StreamInfo& info) const
{
  return keepsMoved(column, this->normals, info.cellType);
}

void DeformJob::checkOn(const StreamInfo& info) const
{
  const DescribedHandles handles(this->description, info, this->name);
}

Costs DeformJob::costsOn(const StreamInfo& info) const
{
  return deformCosts(info, this->deforming);
}

std::unique_ptr<Solution> DeformJob::solveOn(
  const StoredMesh& mesh, const ProgressFunction& progress)
{
  DescribedHandles handles(this->description, mesh.info(), this->name);
  const auto source = [&] { return mesh.source(handles.vertexColumns(), handles.cellColumns()); };
  handles.prepare(*source(), this->deforming.scratch, this->deforming.memoryLimit);
  this->complete(mesh, progress);
  auto positions = deform(*source(), handles, this->deforming);
  this->Notes = handles.notes();
  return positions;
}

void DeformJob::passResult(const StoredMesh& mesh, Solution& positions, const Reader& read,
  Report& report, const ProgressFunction& progress) const
{
  const MovedMesh moved(
    mesh, positions, this->normals, normalsOptions(*this, partOf(progress, 0.0, NormalsShare)));
  read(*moved.source(&report), partOf(progress, NormalsShare, 1.0));
  report.notes.insert(report.notes.end(), this->Notes.begin(), this->Notes.end());
}

} // namespace smg
