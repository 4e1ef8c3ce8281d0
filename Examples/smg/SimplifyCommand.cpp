// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"
#include "DrawMesh.h"
#include "JobOptions.h"
#include "ProgressBar.h"

#include "IO/Conversion/JobEstimate.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/SimplifyJob.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Timer.h"
#include "smg/Error.h"
#include "smg/Simplify.h"

#include <cmath>
#include <cstdio>

namespace
{

class SimplifyCommand : public CommonOptions
{
public:
  void addOptions(CLI::App& command);
  void checkUsage() const;
  int run();

private:
  smg::JobEstimate estimate() const;
  smg::SimplifyReport simplified();
  void print(const smg::SimplifyReport& report) const;

  std::filesystem::path In, Out;
  smg::SimplifyJob Job;
  JobOptions Options;
  bool DryRun = false;
};

smg::JobEstimate SimplifyCommand::estimate() const
{
  smg::ConversionOptions conversion = this->inputOptions();
  conversion.scratch = this->scratchPlace();
  smg::SimplifyOptions options = this->Job.options;
  options.memoryLimit = this->memoryBytes(options.memoryLimit);
  options.text = this->writesText;
  return smg::simplifyEstimate(
    { this->In, conversion }, this->Job.target, this->Out, options, conversion);
}

/** The times are those of the conversion, too. */
smg::SimplifyReport SimplifyCommand::simplified()
{
  const smg::Timer timer;
  const double cpu = smg::processSeconds();
  this->announceCheckpoint("part");
  try
  {
    ProgressBar bar("simplifying", this->quiet);
    const std::unique_ptr<smg::OpenedMesh> mesh =
      this->openInput(this->In, smg::partOf(bar.function(), 0.0, 0.5));
    this->Job.options.memoryLimit = this->memoryBytes(this->Job.options.memoryLimit);
    this->Job.options.threads = this->threads;
    this->Job.options.text = this->writesText;
    this->Job.options.scratch = this->scratch;
    this->Job.options.checkpoint = this->checkpoint;
    this->Job.options.progress = smg::partOf(bar.function(), mesh->conversion() ? 0.5 : 0.0, 1.0);
    smg::SimplifyReport report =
      smg::simplify(mesh->reader(), this->Job.target, this->Out, this->Job.options);
    addNotes(*mesh, report.notes);
    report.seconds = timer.seconds();
    report.cpu_seconds = smg::processSeconds() - cpu;
    return report;
  }
  catch (const smg::Cancelled&)
  {
    this->endCancelled();
  }
}

void SimplifyCommand::print(const smg::SimplifyReport& report) const
{
  std::printf("%s and %s of %lld and %lld, ",
    smg::counted(report.vertices, "vertex", "vertices").c_str(),
    smg::counted(report.cells, "triangle", "triangles").c_str(),
    static_cast<long long>(report.vertices_before), static_cast<long long>(report.cells_before));
  if (!std::isnan(report.error))
  {
    std::printf(
      "error %.3g%s, ", report.error, report.dropped_bodies > 0 ? " of what is left" : "");
  }
  std::printf("%.2f s\n", report.seconds);
  for (const std::string& note : report.notes)
  {
    std::printf("  %s\n", smg::oneLine(note).c_str());
  }
}

int SimplifyCommand::run()
{
  requireOneProcess();
  smg::checkSimplifiedPath(this->Out);
  smg::checkForm(this->Out, this->writesText);
  smg::UsedFiles files;
  files.readMesh(this->In);
  files.writeMesh(this->Out);
  this->Options.addFiles(files);
  this->checkFiles(std::move(files));
  this->checkCheckpoint({ this->Out, this->report });
  this->Options.apply(this->Job);
  if (this->DryRun)
  {
    const smg::JobEstimate costs = this->estimate();
    this->writeReport(costs.json(), { this->In });
    this->printEstimate(costs);
    return 0;
  }
  const smg::SimplifyReport report = this->simplified();
  html::PageFacts facts{ this->In, this->Job.options.memoryLimit };
  if (this->reportsPage())
  {
    facts.surface = surfaceOf(this->Out, *this);
  }
  this->writeReport(report.json(), facts);
  if (!this->quiet)
  {
    this->print(report);
  }
  return 0;
}

void SimplifyCommand::addOptions(CLI::App& command)
{
  command.add_option("IN", this->In, "The mesh")->required();
  command
    .add_option("OUT", this->Out,
      "The simplified surface: " +
        smg::suffixList(smg::FormatUse::WriteColumns, smg::CellType::Triangle, "or") +
        " with the columns of IN, and with OriginalId, the number that each vertex "
        "has in IN; or any other format of surfaces that is written")
    ->required();
  this->Options.addTo(command, this->Job);
  command.add_flag("--dry-run", this->DryRun, "Only estimate the size of the mesh and the costs");
  this->addTextTo(command);
  this->addInputTo(command);
  this->addTo(command);
  this->addThreadsTo(command);
  this->addCheckpointTo(command);
}

void SimplifyCommand::checkUsage() const
{
  if (this->Job.target.vertices == 0 && this->Job.target.error == 0.0)
  {
    throw CLI::RequiredError("--vertices, --error or both");
  }
}

} // namespace

void addSimplifyCommand(CLI::App& program, Action& action, const smg::JobKind& kind)
{
  addCommand<SimplifyCommand>(program, action, kind.name, kind.help);
}
