// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/DeformJob.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include <cstdio>

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
        "and from a streaming format to a streaming format, the order is kept");
    this->addEngineTo(command);
    command.add_option("--handles", this->File, "The handles, a JSON file")
      ->required()
      ->type_name("FILE");
    this->addCheckpointTo(command);
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
      this->readJob();
      this->Job.description.weights = this->Job.deforming.weights;
      this->Job.description.tolerance = this->Job.deforming.tolerance;
      return this->Job.description;
    };
    deformation.normals = this->Job.normals;
    return engine.deform(job, deformation);
  }

  void checkForProcesses() const override
  {
    if (this->Job.deforming.cycles > 0)
    {
      throw smg::Error("--engine hypre has no V-cycles to count: give a tolerance, in " +
                       this->File.string() + " or by --tolerance, instead of cycles.");
    }
  }

  smg::DeformJob& job() override { return this->Job; }

  void readTask() override
  {
    this->Job.description = smg::readHandleText(this->readText(), this->File.string());
    this->Job.description.applyTo(this->Job.deforming);
    this->announceCheckpoint("pass");
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

  double tolerance() const override
  {
    return this->Job.deforming.cycles > 0 ? 0.0 : this->Job.deforming.tolerance;
  }

private:
  smg::DeformJob Job;
};

} // namespace

void addDeformCommand(CLI::App& program, Action& action)
{
  addJobCommand<DeformCommand>(program, action, "deform");
}
