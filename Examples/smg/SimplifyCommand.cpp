// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"
#include "OneProcess.h"
#include "OpenInput.h"
#include "ProgressBar.h"

#include "IO/Conversion/JobEstimate.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "Solver/Core/Timer.h"
#include "smg/Error.h"
#include "smg/Simplify.h"

#include <cmath>
#include <cstdio>
#include <optional>

namespace
{

struct SimplifyCommand : CommonOptions
{
  std::filesystem::path in, out;
  InputOptions input;
  smg::SimplifyTarget target;
  smg::SimplifyOptions simplify;
  bool dryRun = false;

  void run();

private:
  smg::JobEstimate estimate() const;
  smg::SimplifyReport simplified();
};

smg::JobEstimate SimplifyCommand::estimate() const
{
  smg::ConversionOptions conversion = inputOptions(*this, this->input);
  conversion.scratch = this->scratchPlace();
  smg::SimplifyOptions options = this->simplify;
  options.memoryLimit = this->memoryBytes(options.memoryLimit);
  return smg::simplifyEstimate(
    { this->in, conversion }, this->target, this->out, options, conversion);
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
    const std::unique_ptr<smg::OpenedMesh> mesh = openInput(this->in, *this,
      smg::partOf(bar.function(), 0.0, 0.5), smg::StreamOrder::BreadthFirst, this->input);
    this->simplify.memoryLimit = this->memoryBytes(this->simplify.memoryLimit);
    this->simplify.threads = this->threads;
    this->simplify.scratch = this->scratch;
    this->simplify.checkpoint = this->checkpoint;
    this->simplify.progress = smg::partOf(bar.function(), mesh->conversion() ? 0.5 : 0.0, 1.0);
    smg::SimplifyReport report =
      smg::simplify(mesh->reader(), this->target, this->out, this->simplify);
    report.seconds = timer.seconds();
    report.cpu_seconds = smg::processSeconds() - cpu;
    return report;
  }
  catch (const smg::Cancelled&)
  {
    this->endCancelled();
  }
}

void SimplifyCommand::run()
{
  requireOneProcess();
  smg::checkSimplifiedPath(this->out);
  smg::checkIsNotInput(this->in, this->out);
  this->checkReport({ this->in, this->out });
  this->checkCheckpoint({ this->out, this->report });
  if (this->dryRun)
  {
    const smg::JobEstimate costs = this->estimate();
    this->writeReport(costs.json(), { this->in });
    printEstimate(costs);
    return;
  }
  const smg::SimplifyReport report = this->simplified();
  html::PageFacts facts{ this->in, this->simplify.memoryLimit };
  if (this->reportsPage())
  {
    facts.surface = surfaceOf(this->out, *this);
  }
  this->writeReport(report.json(), facts);
  if (!this->quiet)
  {
    std::printf("%lld vertices and %lld triangles of %lld and %lld, ",
      static_cast<long long>(report.vertices), static_cast<long long>(report.cells),
      static_cast<long long>(report.vertices_before), static_cast<long long>(report.cells_before));
    if (!std::isnan(report.error))
    {
      std::printf(
        "error %.3g%s, ", report.error, report.dropped_bodies > 0 ? " of what is left" : "");
    }
    std::printf("%.2f s\n", report.seconds);
    for (const std::string& note : report.notes)
    {
      std::printf("  %s\n", note.c_str());
    }
  }
}

} // namespace

void addSimplifyCommand(CLI::App& program, Action& action)
{
  auto options = std::make_shared<SimplifyCommand>();
  CLI::App* command = program.add_subcommand(
    "simplify", "Simplify a surface, or that of a solid, by collapsing edges");
  command->add_option("IN", options->in, "The mesh")->required();
  command
    ->add_option("OUT", options->out,
      "The simplified surface: " +
        smg::suffixList(smg::FormatUse::WriteColumns, smg::CellType::Triangle, "or") +
        " with the columns of the vertices of IN, and with OriginalId, the number that each vertex "
        "has in IN; or any other format of surfaces that is written")
    ->required();
  command->add_option("--vertices", options->target.vertices, "Maximum number of vertices")
    ->check(CLI::Range(std::int64_t(4), std::int64_t(1) << 40))
    ->type_name("N");
  command->add_option("--error", options->target.error, "Largest error, in the unit of the mesh")
    ->check(
      [](const std::string& given)
      {
        const std::optional<double> length = numberOf(given);
        return length && *length > 0.0 ? std::string() : '\'' + given + "' is not a number above 0";
      })
    ->type_name("LENGTH");
  command->add_flag(
    "--dry-run", options->dryRun, "Only estimate the size of the mesh and the costs");
  options->input.addTo(*command);
  options->addTo(*command);
  options->addThreadsTo(*command);
  options->addCheckpointTo(*command);
  command->callback(
    [options, &action]
    {
      if (options->target.vertices == 0 && options->target.error == 0.0)
      {
        throw CLI::RequiredError("--vertices, --error or both");
      }
      action = [options] { return options->run(), 0; };
    });
}
