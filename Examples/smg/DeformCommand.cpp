// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Description/ParseWhere.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"
#include "smg/MovedMesh.h"

#include <cstdio>
#include <optional>

namespace
{

class DeformCommand : public EngineCommand
{
public:
  DeformCommand()
    : EngineCommand("deforming")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addSolverOptions(command,
      "The deformed mesh: " + smg::suffixList(smg::FormatUse::Write, "or") +
        " in stream order; of a mesh file IN, " + smg::suffixList(smg::FormatUse::Restore, "and") +
        " in the order of IN, unless that has a column OriginalId or points are welded. From .vsm, "
        "and from a streaming format to a streaming format, the order is kept",
      this->Deform);
    command.get_option("--max-cycles")
      ->description("Maximum number of V-cycles of each of the two steps");
    this->addEngineTo(command);
    command.add_option("--handles", this->File, "The handles, a JSON file")
      ->required()
      ->type_name("FILE");
    command
      .add_option("--weights", this->Weights,
        "Weights of the edges, instead of those of the file: clamped, cotangent (finite elements) "
        "or uniform")
      ->check(oneOf({ "clamped", "cotangent", "uniform" }));
    CLI::Option* tolerance = addTolerance(command, this->Tolerance);
    this->addCheckpointTo(command);
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
      "| mask | nearest | boundary}, fixed | translate, rotate {axis, degrees, center}, scale, "
      "center | target, rotation, logScale], weights, cycles | tolerance");
  }

protected:
  void computeOn(const DistributedEngine& engine, const DistributedJob& job) override
  {
    DistributedDeformation deformation;
    deformation.read = [this]
    {
      this->readTask();
      this->Description.weights = this->Deform.weights;
      this->Description.tolerance = this->Deform.tolerance;
      return this->Description;
    };
    deformation.normals = this->movedNormals();
    return engine.deform(job, deformation);
  }

  void checkForProcesses() const override
  {
    if (this->Deform.cycles > 0)
    {
      throw smg::Error("--engine hypre has no V-cycles to count: give a tolerance, in " +
                       this->File.string() + " or by --tolerance, instead of cycles.");
    }
  }

  std::string resultColumns() const override { return {}; }

  void readTask() override
  {
    this->Description = smg::readHandleText(this->readText(), this->File.string());
    this->Description.applyTo(this->Deform);
    this->applyCommandLine();
    this->announceCheckpoint("pass");
  }

  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    // Those of the other engine are past when this one's result is written.
    return this->hasWholeSolution() ? smg::Costs{}
                                    : smg::deformCosts(info, this->withCommon(this->Deform));
  }

  smg::AddedValues addedTo(const smg::StreamInfo& /*info*/) const override
  {
    return { {}, {}, true };
  }

  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) override
  {
    if (auto whole = this->wholeSolution())
    {
      return whole;
    }
    smg::DescribedHandles handles(this->Description, mesh.info(), this->File.string());
    const auto source = [&] { return mesh.source(handles.vertexColumns(), handles.cellColumns()); };
    handles.prepare(*source(), this->scratch, this->withCommon(this->Deform).memoryLimit);
    this->applyTo(this->Deform, std::move(progress));
    this->applyCheckpoint(this->Deform, mesh);
    auto positions = smg::deform(*source(), handles, this->Deform);
    this->Notes = handles.notes();
    return positions;
  }

  void writeResult(const smg::VsmReader& mesh, smg::Solution& positions, const Writer& write,
    smg::Report& report, const smg::ProgressFunction& progress) const override
  {
    smg::NormalsOptions normals;
    normals.scratch = this->scratch;
    normals.memory = this->writerMemory();
    normals.progress = smg::partOf(progress, 0.0, 0.3);
    const smg::MovedMesh moved(mesh, positions, this->movedNormals(), normals);
    write(*moved.source(&report), smg::partOf(progress, 0.3, 1.0));
    report.notes.insert(report.notes.end(), this->Notes.begin(), this->Notes.end());
  }

  void warn(const smg::Report& report) const override
  {
    this->EngineCommand::warn(report);
    if (report.inverted && report.inverted->cells > 0)
    {
      std::fprintf(stderr,
        "smg: warning: %lld of %lld cells are inverted or collapsed, the worst is cell %lld: see "
        "the notes of the report\n",
        static_cast<long long>(report.inverted->cells), static_cast<long long>(report.cells),
        static_cast<long long>(report.inverted->worst));
    }
  }

  const smg::SolveOptions& solveOptions() const override { return this->Deform; }
  double tolerance() const override
  {
    return this->Deform.cycles > 0 ? 0.0 : this->Deform.tolerance;
  }

private:
  smg::MovedNormals movedNormals() const
  {
    return this->Normals == "drop" ? smg::MovedNormals::Drop : smg::MovedNormals::Recompute;
  }

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
  addCommand<DeformCommand>(
    program, action, "deform", "Deform a mesh by handles, keeping its details");
}
