// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Problem/WeightsName.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescriptionFiles.h"
#include "smg/MovedMesh.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <optional>

namespace
{

class DeformCommand : public SolvingCommand
{
public:
  DeformCommand()
    : SolvingCommand("deforming")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The deformed mesh: " + smg::suffixList(smg::FormatUse::WriteColumns, "or") +
        " with all columns of IN; or .sma, .smb, .sva, .svb. The order of IN is kept from .vsm to "
        "any of these, from a streaming format to a "
        "streaming format, and from PLY to PLY; otherwise the vertices are in stream order",
      this->Deform);
    command.get_option("--max-cycles")
      ->description("Maximum number of V-cycles of each of the two steps");
    command.add_option("--handles", this->File, "The handles, a JSON file")
      ->required()
      ->type_name("FILE");
    command
      .add_option("--weights", this->Weights,
        "Weights of the edges, instead of those of the file: clamped, cotangent (finite elements) "
        "or uniform")
      ->check(oneOf({ "clamped", "cotangent", "uniform" }));
    CLI::Option* tolerance = addTolerance(command, this->Tolerance);
    command
      .add_option(
        "--cycles", this->Cycles, "V-cycles of each of the two steps, instead of a tolerance")
      ->check(CLI::Range(1, 1000000))
      ->excludes(tolerance);
    command
      .add_option(
        "--normals", this->Normals, "Columns Normals of IN: recompute (tetrahedra: drop) or drop")
      ->check(oneOf({ "recompute", "drop" }))
      ->capture_default_str();
    command.footer(
      "Keys of a handle file: handles [region {sphere | box | halfspace | vertices | tag "
      "| mask | nearest}, fixed | translate, rotate {axis, degrees, center}, scale, "
      "center | target, rotation, logScale], weights, cycles | tolerance");
  }

protected:
  void checkOutputName() const override { smg::checkOutput(this->Out); }

  void readTask() override { this->Description = smg::readHandleFile(this->File); }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    smg::checkOutput(this->Out, mesh.info().cellType);
    smg::DescribedHandles handles(this->Description, mesh.info(), this->File.string());
    const auto source = [&] { return mesh.source(handles.vertexColumns(), handles.cellColumns()); };
    handles.prepare(*source(), this->scratch);
    this->applyTo(this->Deform, std::move(progress));
    this->Description.applyTo(this->Deform);
    this->applyCommandLine();
    auto positions = smg::deform(*source(), handles, this->Deform);
    this->Notes = handles.notes();
    return positions;
  }

  /** Of merged points only one moves, so that IN cannot be rewritten. */
  bool rewritesInput() const override
  {
    return !this->Input.welds() && smg::canRewrite(this->In, this->Out);
  }

  std::vector<std::string> write(const smg::VsmReader& mesh, smg::Solution& positions,
    smg::Report& /*report*/, const smg::ProgressFunction& progress) const override
  {
    smg::NormalsOptions normals;
    normals.scratch = this->scratch;
    normals.memory = this->writerMemory();
    normals.progress = smg::partOf(progress, 0.0, 0.3);
    const smg::MovedMesh moved(mesh, positions,
      this->Normals == "drop" ? smg::MovedNormals::Drop : smg::MovedNormals::Recompute, normals);
    const std::unique_ptr<smg::MeshSource> source = moved.source();
    // Keeps the order of the input file.
    if (this->rewritesInput())
    {
      smg::RewriteOptions options;
      options.scratch = this->scratch;
      options.memory = this->writerMemory();
      options.progress = smg::partOf(progress, 0.3, 1.0);
      smg::rewriteMesh(this->In, this->Out, *source, options);
      return this->Notes;
    }
    smg::WriteMeshOptions options;
    options.scratch = this->scratch;
    options.isolatedFrom = mesh.path();
    options.progress = smg::partOf(progress, 0.3, 1.0);
    std::vector<std::string> notes = this->Notes;
    const std::vector<std::string> more = smg::writeMesh(*source, this->Out, options);
    notes.insert(notes.end(), more.begin(), more.end());
    return notes;
  }

  const smg::SolveOptions& solveOptions() const override { return this->Deform; }

private:
  /** The command line takes precedence over the file. */
  void applyCommandLine()
  {
    if (!this->Weights.empty())
    {
      this->Deform.weights = *smg::weightsOfName(this->Weights);
    }
    if (this->Cycles)
    {
      this->Deform.cycles = *this->Cycles;
    }
    if (this->Tolerance)
    {
      this->Deform.cycles = 0;
      this->Deform.tolerance = *this->Tolerance;
    }
  }

  /** Bytes for the buffers of the writer. */
  std::int64_t writerMemory() const
  {
    return std::min(this->Deform.memoryLimit / 4, smg::NormalsOptions().memory);
  }

  smg::DeformationDescription Description; ///< from the handle file
  std::string Weights;                     ///< empty: those of the file
  std::optional<int> Cycles;
  std::optional<double> Tolerance;
  std::string Normals = "recompute";
  std::vector<std::string> Notes; ///< on the handles
  smg::DeformOptions Deform;
};

} // namespace

void addDeformCommand(CLI::App& program, Action& action)
{
  auto deform = std::make_shared<DeformCommand>();
  CLI::App* command =
    program.add_subcommand("deform", "Deform a mesh by handles, keeping its details");
  deform->addOptions(*command);
  command->callback([deform, &action] { action = [deform] { deform->run(); }; });
}
