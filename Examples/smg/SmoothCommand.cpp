// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Description/Sizes.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/SmoothJob.h"

#include <algorithm>
#include <optional>

namespace
{

/** In the order of smg::SmoothedBoundary. */
const std::vector<std::string> Boundaries{ "smooth", "fixed", "free" };

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
      this->Job.smoothing);
    command.get_option("--max-cycles")->description("Maximum number of V-cycles of each step");
    this->addSmoothing(command);
    addTolerance(command, this->Job.smoothing.tolerance)->capture_default_str();
    command
      .add_option(
        "--normals", this->Normals, "Columns Normals of IN: recompute (tetrahedra: drop) or drop")
      ->check(oneOf({ "recompute", "drop" }))
      ->capture_default_str();
  }

  void checkUsage() const override { this->Job.check(); }

protected:
  smg::SmoothJob& job() override { return this->Job; }

  smg::UsedFiles files() const override
  {
    smg::UsedFiles files = this->SolvingCommand::files();
    this->Hold.addFiles(files);
    return files;
  }

  void readTask() override
  {
    this->Job.smoothing.hold = this->Hold.places();
    this->Job.normals =
      this->Normals == "drop" ? smg::MovedNormals::Drop : smg::MovedNormals::Recompute;
  }

private:
  void addSmoothing(CLI::App& command)
  {
    command
      .add_option_function<std::string>(
        "--size",
        [this](const std::string& text)
        {
          const std::optional<smg::SmoothingSize> size = smg::smoothingSizeOf(text);
          if (!size)
          {
            throw CLI::ValidationError("--size",
              '\'' + text + "' is not a size: give a number above 0, as 2.5, 1% or 6edges");
          }
          this->Job.smoothing.size = *size;
        },
        "Size of the details that are halved: in the unit of the mesh, in % of the diagonal of its "
        "bounds, or in mean edges, as 6edges")
      ->default_str("4edges");
    command.add_option("--steps", this->Job.smoothing.steps, "Implicit steps")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
    command
      .add_option("--keep-edges", this->Job.smoothing.keepEdges,
        "Keep edges at which the surface turns by more than this angle in degrees, about 30 for "
        "machined parts; with about 5 steps")
      ->type_name("DEGREES");
    command.add_flag("--keep-volume,!--no-keep-volume", this->Job.smoothing.keepVolume,
      "Move the surface along its normals so that it keeps its volume (default), or do not");
    command.add_flag("--orient", this->Job.smoothing.orient,
      "Turn triangles of OUT so that those of a body are wound alike, and outwards if it is "
      "closed");
    this->Hold.addTo(command, "A part of the mesh that does not move");
    command
      .add_option_function<std::string>(
        "--boundary",
        [this](const std::string& name)
        {
          const auto place = std::ranges::find(Boundaries, name);
          this->Job.smoothing.boundary =
            static_cast<smg::SmoothedBoundary>(place - Boundaries.begin());
        },
        "Boundary of a surface: smooth, as curves (default of positions), fixed, or free (default "
        "of a column)")
      ->check(oneOf(Boundaries));
    command.add_option("--column", this->Job.smoothing.column,
      "Smooth this column of the vertices instead of their positions");
  }

  PlacesOption Hold{ "--hold" };
  std::string Normals = "recompute";
  smg::SmoothJob Job;
};

} // namespace

void addSmoothCommand(CLI::App& program, Action& action)
{
  addCommand<SmoothCommand>(
    program, action, "smooth", "Smooth a surface, or a column of the vertices of any mesh");
}
