// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "IO/Jobs/DeformJob.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include <cstdio>

namespace
{

class DeformCommand : public EngineCommand
{
public:
  using EngineCommand::EngineCommand;

  void addOptions(CLI::App& command) override
  {
    this->EngineCommand::addOptions(command);
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
      this->asked().description.weights = this->asked().deforming.weights;
      this->asked().description.tolerance = this->asked().deforming.tolerance;
      return this->asked().description;
    };
    deformation.normals = this->asked().normals;
    return engine.deform(job, deformation);
  }

  void checkForProcesses() const override
  {
    if (this->asked().deforming.cycles > 0)
    {
      throw smg::Error("--engine hypre has no V-cycles to count: give a tolerance, in " +
                       this->File.string() + " or by --tolerance, instead of cycles.");
    }
  }

  smg::DeformJob& asked() { return static_cast<smg::DeformJob&>(this->job()); }
  const smg::DeformJob& asked() const { return static_cast<const smg::DeformJob&>(this->job()); }

  void readTask() override
  {
    this->asked().description = smg::readHandleText(this->readText(), this->File.string());
    this->asked().description.applyTo(this->asked().deforming);
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
    return this->asked().deforming.cycles > 0 ? 0.0 : this->asked().deforming.tolerance;
  }
};

} // namespace

void addDeformCommand(CLI::App& program, Action& action, const smg::JobKind& kind)
{
  addCommand<DeformCommand>(program, action, kind.name, kind.help, kind);
}
