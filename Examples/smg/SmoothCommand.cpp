// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/MovedMesh.h"
#include "smg/Smooth.h"
#include "smg/SolvedMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace
{

/** In the order of smg::SmoothedBoundary. */
const std::vector<std::string> Boundaries{ "smooth", "fixed", "free" };

/** Reads a size: a number, in the unit of the mesh or followed by a unit. Returns whether it is
 * one. */
bool readSize(const std::string& text, smg::SmoothingSize& size)
{
  char* end = nullptr;
  size.value = std::strtod(text.c_str(), &end);
  std::string unit = end;
  unit.erase(0, unit.find_first_not_of(' '));
  size.unit = unit == "edges" || unit == "edge" ? smg::SmoothingSize::MeanEdges
              : unit == "%"                     ? smg::SmoothingSize::Diagonal
                                                : smg::SmoothingSize::Mesh;
  size.value /= unit == "%" ? 100.0 : 1.0;
  return end != text.c_str() && std::isfinite(size.value) && size.value > 0.0 &&
         (unit.empty() || size.unit != smg::SmoothingSize::Mesh);
}

class SmoothCommand : public SolvingCommand
{
public:
  SmoothCommand()
    : SolvingCommand("smoothing")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The smoothed mesh: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " with all columns of IN; or, of smoothed positions, any other format that is written. The "
        "order of IN is kept wherever the format can have it",
      this->Smooth);
    command.get_option("--max-cycles")->description("Maximum number of V-cycles of each step");
    this->addSmoothing(command);
    addTolerance(command, this->Smooth.tolerance)->capture_default_str();
    command
      .add_option(
        "--normals", this->Normals, "Columns Normals of IN: recompute (tetrahedra: drop) or drop")
      ->check(oneOf({ "recompute", "drop" }))
      ->capture_default_str();
  }

  void checkUsage() const override { smg::checkOptions(this->Smooth); }

protected:
  std::string resultColumns() const override
  {
    return this->Smooth.column.empty() ? std::string() : "the column " + this->Smooth.column;
  }

  std::vector<std::string> changedColumns() const override
  {
    return this->Smooth.column.empty() ? std::vector<std::string>{}
                                       : std::vector{ this->Smooth.column };
  }

  void readTask() override { this->Smooth.hold = this->Hold.places(); }

  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    constexpr int OfPoints = 3;
    return smg::smoothCosts(info, smg::expectedComponents(info, this->Smooth.column, OfPoints),
      this->withCommon(this->Smooth));
  }

  smg::AddedValues addedTo(const smg::StreamInfo& info) const override
  {
    smg::AddedValues added = replacedIn(info, this->changedColumns());
    added.movesVertices = this->Smooth.column.empty();
    return added;
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    this->applyTo(this->Smooth, std::move(progress));
    return smg::smooth(mesh, this->Smooth, this->Smooth);
  }

  void writeResult(const smg::VsmReader& mesh, smg::Solution& solution, const Writer& write,
    smg::Report& /*report*/, const smg::ProgressFunction& progress) const override
  {
    if (!this->Smooth.column.empty())
    {
      const std::vector<smg::ColumnSpec>& specs = mesh.info().vertexColumns;
      const auto column = std::ranges::find(specs, this->Smooth.column, &smg::ColumnSpec::name);
      smg::ReplacedColumns smoothed(mesh, solution, { *column });
      write(smoothed, progress);
      return;
    }
    smg::NormalsOptions normals;
    normals.scratch = this->scratch;
    normals.memory = this->writerMemory();
    normals.progress = smg::partOf(progress, 0.0, 0.3);
    const smg::MovedMesh moved(mesh, solution,
      this->Normals == "drop" ? smg::MovedNormals::Drop : smg::MovedNormals::Recompute, normals);
    write(*moved.source(), smg::partOf(progress, 0.3, 1.0));
  }

  const smg::SolveOptions& solveOptions() const override { return this->Smooth; }

private:
  void addSmoothing(CLI::App& command)
  {
    command
      .add_option_function<std::string>(
        "--size",
        [this](const std::string& text)
        {
          if (!readSize(text, this->Smooth.size))
          {
            throw CLI::ValidationError("--size",
              '\'' + text + "' is not a size: give a number above 0, as 2.5, 1% or 6edges");
          }
        },
        "Size of the details that are halved: in the unit of the mesh, in % of the diagonal of its "
        "bounds, or in mean edges, as 6edges")
      ->default_str("4edges");
    command.add_option("--steps", this->Smooth.steps, "Implicit steps")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
    command
      .add_option("--keep-edges", this->Smooth.keepEdges,
        "Keep edges at which the surface turns by more than this angle in degrees, about 30 for "
        "machined parts; with about 5 steps")
      ->type_name("DEGREES");
    command.add_flag("--keep-volume,!--no-keep-volume", this->Smooth.keepVolume,
      "Move the surface along its normals so that it keeps its volume (default), or do not");
    this->Hold.addTo(command, "A part of the mesh that does not move");
    command
      .add_option_function<std::string>(
        "--boundary",
        [this](const std::string& name)
        {
          const auto place = std::ranges::find(Boundaries, name);
          this->Smooth.boundary = static_cast<smg::SmoothedBoundary>(place - Boundaries.begin());
        },
        "Boundary of a surface: smooth, as curves (default of positions), fixed, or free (default "
        "of a column)")
      ->check(oneOf(Boundaries));
    command.add_option("--column", this->Smooth.column,
      "Smooth this column of the vertices instead of their positions");
  }

  PlacesOption Hold{ "--hold" };
  std::string Normals = "recompute";
  smg::Smoothing Smooth;
};

} // namespace

void addSmoothCommand(CLI::App& program, Action& action)
{
  addCommand<SmoothCommand>(
    program, action, "smooth", "Smooth a surface, or a column of the vertices of any mesh");
}
