// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/Formats/FormatTable.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Blend.h"
#include "smg/SolvedMesh.h"

#include <algorithm>

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
      this->Solve);
    addTolerance(command, this->Solve.tolerance)->capture_default_str();
    command
      .add_option("--patch", this->Description.patch,
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
      .add_option("--anchor", this->Description.anchor,
        "How strongly all values are pulled towards the original ones: corrections over less than "
        "1 / sqrt(anchor) diagonals of the bounding box are hardly pulled; 0: not at all")
      ->check(numberFromZero)
      ->capture_default_str();
    command
      .add_option_function<std::string>(
        "--seam",
        [this](const std::string& name)
        {
          this->Description.seam =
            name == "average" ? smg::SeamGradient::Average : smg::SeamGradient::Zero;
        },
        "Gradients between patches: zero, or the average of those on both sides")
      ->check(oneOf({ "zero", "average" }))
      ->default_str("zero");
    command.footer("Steps of the columns between patches are removed; inside the patches their "
                   "gradients are kept. docs/blend.md explains it");
  }

  void checkUsage() const override { smg::checkOptions(this->Solve); }

protected:
  std::string resultColumns() const override { return "these columns of vertices"; }

  std::vector<std::string> changedColumns() const override { return this->Description.columns; }

  void readTask() override { this->Description.hold = this->Hold.places(); }

  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    // The columns of a mesh file that is not a .vsm are not known before it is read.
    constexpr int Usual = 3;
    int components = 0;
    for (const std::string& name : this->Description.columns)
    {
      components += smg::expectedComponents(info, name, Usual);
    }
    return smg::blendCosts(info, components, this->Description.seam, this->withCommon(this->Solve));
  }

  smg::AddedValues addedTo(const smg::StreamInfo& info) const override
  {
    return replacedIn(info, this->Description.columns);
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    this->applyTo(this->Solve, std::move(progress));
    return smg::blend(mesh, this->Description, this->Solve);
  }

  void writeResult(const smg::VsmReader& mesh, smg::Solution& solution, const Writer& write,
    smg::Report& /*report*/, const smg::ProgressFunction& progress) const override
  {
    smg::ReplacedColumns source(
      mesh, solution, smg::blendedColumns(mesh.info(), this->Description));
    write(source, progress);
  }

  std::string fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const override
  {
    return vertices == 1 ? "keeps its values." : "keep their values.";
  }

  const smg::SolveOptions& solveOptions() const override { return this->Solve; }

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
        this->Description.columns.push_back(name);
      }
    }
  }

  smg::BlendDescription Description;
  PlacesOption Hold{ "--hold" };
  smg::SolveOptions Solve;
};

} // namespace

void addBlendCommand(CLI::App& program, Action& action)
{
  addCommand<BlendCommand>(
    program, action, "blend", "Remove the steps of columns between patches of a mesh");
}
