// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCommand.h"

#include "DrawMesh.h"
#include "ProgressBar.h"
#include "SolveText.h"

#include "IO/Description/JsonNode.h"
#include "IO/External/Workspace.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/MeshFile.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/ScratchAccount.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

namespace
{

/** Prints time and memory, and the notes that are no warnings. */
void printCosts(const smg::Report& report)
{
  std::printf(
    "%.2f s (%.2f s of CPU), %.1f MiB of accounted memory, %.1f MiB resident, %.1f MiB of "
    "scratch files\n",
    report.seconds.total, report.cpu_seconds, inMebibytes(report.pool_bytes_peak),
    inMebibytes(report.rss_bytes_peak), inMebibytes(report.scratch_bytes_peak));
  const std::set<std::string> warnings(report.warnings.begin(), report.warnings.end());
  for (const std::string& note : report.notes)
  {
    if (!warnings.contains(note))
    {
      std::printf("%s\n", smg::oneLine(note).c_str());
    }
  }
}

} // namespace

MeshCommand::MeshCommand(const smg::JobKind& kind)
  : Kind(kind)
  , Job(smg::makeMeshJob(kind.name))
{
  const auto solves = [this]
  {
    return std::ranges::count(this->Job->table(), std::string_view("sweeps"), &smg::JobOption::key);
  };
  this->Solving = solves() ? dynamic_cast<smg::SolvingJob*>(this->Job.get()) : nullptr;
}

void MeshCommand::addOptions(CLI::App& command)
{
  command.add_option("IN", this->In, "The mesh, preferably a .vsm file")->required();
  command.add_option("OUT", this->Out, this->job().resultHelp())->required();
  this->Options.addTo(command, this->job());
  if (this->solving())
  {
    smg::SolveOptions& options = this->solving()->options();
    // checkOperators() says where shi2006, which there was, is found.
    command.add_option("--operators", options.operators, "Operator set")
      ->check([](const std::string& name)
        { return name == "shi2006" ? std::string() : oneOf({ "extended" })(name); })
      ->capture_default_str();
    // For experiments and tests: they affect the speed, not the result.
    command.add_option("--block-nodes", options.blockNodes)->group("");
    command.add_option("--core-nodes", options.coreNodes)->group("");
  }
  this->addTextTo(command);
  this->addInputTo(command);
  this->addTo(command, std::to_string(this->job().memoryLimit() >> 20),
    "; without it, 256 MiB to convert IN");
  this->addThreadsTo(command);
  command.add_flag("--dry-run", this->DryRun, "Only estimate the cost; IN is not read");
  if (std::ranges::any_of(this->job().table(), smg::isKind<smg::WhereOption>))
  {
    command.footer(
      "WHERE is one of {\"vertices\": [numbers]}, {\"nearest\": [[x, y, z], ...]}, "
      "{\"boundary\": true}, {\"sphere\": [x, y, z, r]}, {\"box\": [x0, y0, z0, x1, y1, z1]}, "
      "{\"halfspace\": [nx, ny, nz, d]}, {\"tag\": [\"column\", value]}, {\"mask\": \"column\"}, "
      "{\"group\": \"name\"}, {\"all\": [WHERE, ...]}, {\"any\": [WHERE, ...]}, {\"not\": WHERE}. "
      "docs/" +
      std::string(this->Kind.name) + ".md explains all");
  }
}

const std::string& MeshCommand::readText()
{
  this->Text = smg::jsonFileText(this->File.string());
  this->job().name = this->File.string();
  this->solving()->text = this->Text;
  this->solving()->options().checkpoint.folder = this->checkpoint;
  return this->Text;
}

smg::JobEstimate MeshCommand::estimate(const smg::ResultFile& out) const
{
  smg::ConversionOptions conversion = this->inputOptions();
  conversion.scratch = this->scratchPlace();
  const smg::EstimatedInput in(this->In, conversion);
  // What computes has sentences of its own.
  if (this->DryRun && smg::kindOfInput(this->In) == smg::MeshFileKind::Vsm)
  {
    this->job().checkOn(in.info);
  }
  smg::JobEstimate estimate(in,
    { this->Out, this->job().addedTo(in.info), out.expectedOrder(in.info),
      this->job().writerMemory(), this->writesText },
    this->costsOn(in.info), conversion);
  estimate.memory_limit = this->job().memoryLimit();
  return estimate;
}

/** Rejects what certainly does not fit on the disks, if IN says its counts. */
void MeshCommand::checkRoom(const smg::ResultFile& out) const
{
  if (smg::kindOfInput(this->In) == smg::MeshFileKind::Unknown)
  {
    return;
  }
  if (const smg::JobEstimate estimate = this->estimate(out); estimate.counted)
  {
    estimate.checkRoom(this->Out, this->scratchPlace(), this->checkpointBytes());
  }
}

int MeshCommand::run()
{
  if (!this->isForProcesses())
  {
    requireOneProcess();
  }
  try
  {
    this->compute();
  }
  catch (const smg::Cancelled&)
  {
    this->endCancelled();
  }
  return this->Converged ? 0 : NotConverged;
}

smg::UsedFiles MeshCommand::files() const
{
  smg::UsedFiles files;
  files.readMesh(this->In);
  files.read(this->File, "the file that says what to do");
  files.writeMesh(this->Out);
  this->Options.addFiles(files);
  return files;
}

void MeshCommand::readJob()
{
  this->readTask();
  this->Options.apply(this->job());
  this->job().check();
}

smg::ResultFile MeshCommand::prepareFiles()
{
  smg::ResultFile out(this->job(), { .in = this->In,
                                     .out = this->Out,
                                     .scratch = this->scratch,
                                     .welds = this->input.weld.has_value(),
                                     .threads = this->threads,
                                     .text = this->writesText });
  this->checkFiles(this->files());
  this->checkCheckpoint({ this->Out, this->report });
  this->readJob();
  this->job().setLimits({ this->memoryBytes(0), this->threads, this->scratch });
  return out;
}

void MeshCommand::warn(const smg::Report& report) const
{
  for (const std::string& warning : report.warnings)
  {
    std::fprintf(stderr, "smg: warning: %s\n", smg::oneLine(warning).c_str());
  }
  if (this->solving())
  {
    warnOfSolve(report, this->solving()->options());
  }
}

void MeshCommand::print(const smg::Report& report) const
{
  const std::string found = this->job().found(report);
  found.empty() ? printSolve(report) : void(std::puts(found.c_str()));
}

void MeshCommand::tell(const smg::Report& report)
{
  this->Converged = report.converged;
  this->warn(report);
  if (!this->quiet)
  {
    this->print(report);
    printCosts(report);
  }
}

void MeshCommand::compute()
{
  const auto secondsSince = [](std::chrono::steady_clock::time_point then)
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count(); };
  smg::ResultFile out = this->prepareFiles();
  if (this->DryRun)
  {
    const smg::JobEstimate estimate = this->estimate(out);
    this->writeReport(estimate.json(), this->pageFacts());
    this->printEstimate(estimate);
    return;
  }
  this->checkRoom(out);
  smg::Report report;
  std::optional<html::ResultSurface> drawn;
  {
    ProgressBar bar(this->title(), this->quiet);
    const std::unique_ptr<smg::OpenedMesh> mesh = this->openInput(this->In,
      smg::partOf(bar.function(), 0.0, 0.2), smg::StreamOrder::BreadthFirst, this->job().coupled());
    if (mesh->conversion())
    {
      this->Conversion = *mesh->conversion();
    }
    const double convertSeconds = this->Conversion ? secondsSince(this->Start) : 0.0;
    const double begin = this->Conversion ? 0.2 : 0.0;
    out.chooseOrder(*mesh, mesh->conversion(), smg::partOf(bar.function(), begin, begin));
    const double end = this->reportsPage() ? 0.95 : 1.0;
    report = this->solveAndWrite(*mesh, out, smg::partOf(bar.function(), begin, end));
    if (this->reportsPage())
    {
      drawn = this->draw(*mesh, report, smg::partOf(bar.function(), end, 1.0));
    }
    if (this->Conversion)
    {
      for (const std::vector<std::string>& more :
        { this->Conversion->changes(), out.notesOn(*this->Conversion, this->job()) })
      {
        report.notes.insert(report.notes.end(), more.begin(), more.end());
      }
    }
    report.seconds.convert = convertSeconds;
    report.seconds.total = secondsSince(this->Start);
    report.scratch_bytes_peak = smg::ScratchAccount::process().peak();
  }
  html::PageFacts facts = this->pageFacts();
  facts.surface = std::move(drawn);
  this->writeReport(report.json(), facts);
  this->Solution->removeCheckpoint();
  this->Solution.reset();
  this->tell(report);
}

std::unique_ptr<smg::Solution> MeshCommand::solveOn(
  const smg::StoredMesh& mesh, const smg::ProgressFunction& progress)
{
  this->job().prepareOn(mesh);
  return this->job().solveOn(mesh, progress);
}

smg::Report MeshCommand::solveAndWrite(
  const smg::StoredMesh& mesh, const smg::ResultFile& out, const smg::ProgressFunction& progress)
{
  this->Solution = this->solveOn(mesh, smg::partOf(progress, 0.0, 0.9));
  smg::Report report = this->Solution->report();
  std::vector<std::string> notes;
  this->job().passResult(
    mesh, *this->Solution,
    [&](smg::MeshSource& result, const smg::ProgressFunction& writing)
    { notes = out.write(mesh, result, this->job().writerMemory(), writing); },
    report, smg::partOf(progress, 0.9, 1.0));
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
  this->writeMore(report);
  return report;
}

html::PageFacts MeshCommand::pageFacts() const
{
  return { this->In, this->job().memoryLimit(), this->tolerance(), this->text(), this->File };
}

html::ResultSurface MeshCommand::draw(
  const smg::StoredMesh& mesh, const smg::Report& report, const smg::ProgressFunction& progress)
{
  std::vector<std::string> names;
  for (const smg::ColumnSpec& column : this->job().addedTo(mesh.info()).ofVertices)
  {
    names.push_back(column.name);
  }
  const std::int64_t memory = std::max(this->job().memoryLimit(), smg::Workspace::MinMemory);
  return drawnBy(this->Out,
    [&]
    {
      html::ResultSurface drawn;
      // What the stream adds to the report is there already.
      smg::Report again = report;
      this->job().passResult(
        mesh, *this->Solution,
        [&](smg::MeshSource& result, const smg::ProgressFunction& reading)
        { drawn = html::resultSurface(result, names, memory, reading); },
        again, progress);
      return drawn;
    });
}

void addJobCommand(CLI::App& program, Action& action, const smg::JobKind& kind)
{
  addCommand<MeshCommand>(program, action, kind.name, kind.help, kind);
}
