// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/BlendJob.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"

namespace
{

class BlendCommand : public SolvingCommand
{
public:
  BlendCommand()
    : SolvingCommand("blending")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The mesh with the blended columns: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " in stream order; of a mesh file IN, " +
        smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded; "
        "and .obj and .off, for Colors alone",
      this->Job.solving);
    addTolerance(command, this->Job.solving.tolerance)->capture_default_str();
    command
      .add_option("--patch", this->Job.description.patch,
        "Column of one component with the patch of each vertex, or of each cell")
      ->required()
      ->type_name("COLUMN");
    command
      .add_option_function<std::vector<std::string>>(
        "--columns", [this](const std::vector<std::string>& lists) { this->readColumns(lists); },
        "Columns of the vertices to blend, separated by commas")
      ->required()
      ->allow_extra_args(false)
      ->type_name("COLUMN,...");
    this->Hold.addTo(command, "A part of the mesh that keeps its values");
    command
      .add_option("--anchor", this->Job.description.anchor,
        "How strongly all values are pulled towards the original ones: corrections over less than "
        "1 / sqrt(anchor) diagonals of the bounding box are hardly pulled; 0: not at all")
      ->check(numberFromZero)
      ->capture_default_str();
    command
      .add_option_function<std::string>(
        "--seam",
        [this](const std::string& name)
        {
          this->Job.description.seam =
            name == "average" ? smg::SeamGradient::Average : smg::SeamGradient::Zero;
        },
        "Gradients between patches: zero, or the average of those on both sides")
      ->check(oneOf({ "zero", "average" }))
      ->default_str("zero");
    command.footer("Steps of the columns between patches are removed; inside the patches their "
                   "gradients are kept. docs/blend.md explains it");
  }

  void checkUsage() const override { smg::checkOptions(this->Job.solving); }

protected:
  smg::BlendJob& job() override { return this->Job; }

  smg::UsedFiles files() const override
  {
    smg::UsedFiles files = this->SolvingCommand::files();
    this->Hold.addFiles(files);
    return files;
  }

  void readTask() override { this->Job.description.hold = this->Hold.places(); }

private:
  void readColumns(const std::vector<std::string>& lists)
  {
    for (const std::string& list : lists)
    {
      for (const std::string& name : splitAtCommas(list))
      {
        if (name.empty())
        {
          throw CLI::ValidationError(
            "--columns", '\'' + list + "' has an empty name: give names with a comma between them");
        }
        this->Job.description.columns.push_back(name);
      }
    }
  }

  PlacesOption Hold{ "--hold" };
  smg::BlendJob Job;
};

} // namespace

void addBlendCommand(CLI::App& program, Action& action)
{
  addCommand<BlendCommand>(
    program, action, "blend", "Remove the steps of columns between patches of a mesh");
}
