// SPDX-License-Identifier: BSD-3-Clause
#include "SolvingCommand.h"

#include "OpenInput.h"
#include "ProgressBar.h"

#include "IO/AnyFormat/MeshFile.h"
#include "IO/External/Workspace.h"
#include "IO/Files/PartialProgress.h"
#include "Solver/Stream/OriginalNumbers.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

std::string SolvingCommand::checkTolerance(const std::string& text)
{
  char* end = nullptr;
  const double tolerance = std::strtod(text.c_str(), &end);
  const bool isNumber = !text.empty() && *end == '\0';
  return isNumber && tolerance > 0.0 && tolerance < 1.0
           ? std::string()
           : '\'' + text + "' is no number between 0 and 1, both excluded";
}

void SolvingCommand::addSolverOptions(CLI::App& command, const std::string& result,
  smg::SolveOptions& options, std::vector<std::string> operators)
{
  command.add_option("IN", this->In, "The mesh, preferably a .vsm file")->required();
  command.add_option("OUT", this->Out, result)->required();
  command.add_option("--operators", options.operators, "Operator set")
    ->check(oneOf(std::move(operators)))
    ->capture_default_str();
  command
    .add_option(
      "--sweeps", options.sweeps, "Gauss-Seidel sweeps before and after a coarse-grid correction")
    ->check(CLI::Range(1, 20))
    ->capture_default_str();
  command.add_option("--max-cycles", options.maxCycles, "Maximum number of V-cycles")
    ->check(CLI::Range(1, 1000000))
    ->capture_default_str();
  command.add_flag(
    "--in-core", options.inCore, "Keep everything in memory and use no scratch files");
  // For experiments and tests: they affect the speed, not the result.
  command.add_option("--block-nodes", options.blockNodes)->group("");
  command.add_option("--core-nodes", options.coreNodes)->group("");
  this->Input.addTo(command);
  this->addTo(command, std::to_string(options.memoryLimit >> 20));
  command.get_option("--memory")
    ->description("Memory limit in MiB; without it, 256 MiB to convert IN");
  this->addThreadsTo(command);
}

void SolvingCommand::applyTo(smg::SolveOptions& options, smg::ProgressFunction progress) const
{
  options.memoryLimit = this->memoryBytes(options.memoryLimit);
  options.threads = this->threads;
  options.scratch = this->scratch;
  options.progress = std::move(progress);
}

void SolvingCommand::run()
{
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point then)
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count(); };
  ResultFile out(
    { this->In, this->Out, this->scratch, this->Input.welds(), this->resultColumns() });
  smg::checkIsNotInput(this->In, this->Out);
  smg::checkIsNotInput(this->File, this->Out, "the file that says what to do");
  this->checkReport({ this->In, this->Out, this->File });
  this->readTask();
  smg::Report report;
  {
    ProgressBar bar(this->Title, this->quiet);
    const std::unique_ptr<smg::OpenedMesh> mesh = openInput(this->In, *this,
      smg::partOf(bar.function(), 0.0, 0.2), smg::StreamOrder::BreadthFirst, this->Input);
    if (mesh->conversion())
    {
      this->Conversion = *mesh->conversion();
    }
    const double convertSeconds = this->Conversion ? secondsSince(start) : 0.0;
    const double begin = this->Conversion ? 0.2 : 0.0;
    out.chooseOrder(mesh->reader(), mesh->conversion());
    report = this->solveAndWrite(mesh->reader(), out, smg::partOf(bar.function(), begin, 1.0));
    if (this->Conversion)
    {
      const std::vector<std::string> more = this->notesOn(*this->Conversion, out);
      report.notes.insert(report.notes.end(), more.begin(), more.end());
    }
    report.seconds.convert = convertSeconds;
    report.seconds.total = secondsSince(start);
  }
  this->writeReport(report.json());
  this->warn(report);
  if (!this->quiet)
  {
    this->print(report);
  }
}

smg::Report SolvingCommand::solveAndWrite(
  const smg::VsmReader& mesh, const ResultFile& out, const smg::ProgressFunction& progress)
{
  const std::unique_ptr<smg::Solution> solution =
    this->solveOn(mesh, smg::partOf(progress, 0.0, 0.9));
  smg::Report report = solution->report();
  std::vector<std::string> notes;
  this->writeResult(
    mesh, *solution,
    [&](smg::MeshSource& result, const smg::ProgressFunction& writing)
    { notes = out.write(mesh, result, this->writerMemory(), writing); },
    report, smg::partOf(progress, 0.9, 1.0));
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
  return report;
}

std::int64_t SolvingCommand::writerMemory() const
{
  constexpr std::int64_t MostMemory = std::int64_t(64) << 20;
  return std::clamp(this->solveOptions().memoryLimit / 4, smg::Workspace::LeastMemory, MostMemory);
}

std::vector<std::string> SolvingCommand::notesOn(
  const smg::ConversionReport& conversion, const ResultFile& out) const
{
  const bool ordered = out.keepsOrder();
  const bool whole = ordered || smg::kindOfOutput(this->Out) == smg::MeshFileKind::Vsm;
  std::vector<std::string> notes;
  if (const std::int64_t isolated = conversion.isolated_vertices; isolated > 0)
  {
    notes.push_back(
      std::to_string(isolated) +
      (isolated == 1 ? " vertex belongs to no cell: it " : " vertices belong to no cell: they ") +
      (whole            ? this->fateOfIsolated(isolated, ordered)
        : isolated == 1 ? "is left out."
                        : "are left out."));
  }
  if (!out.rewritesInput())
  {
    notes.insert(notes.end(), conversion.notes.begin(), conversion.notes.end());
  }
  if (!ordered && smg::kindOfInput(this->In) == smg::MeshFileKind::Indexed)
  {
    const bool hasIds =
      smg::kindOfOutput(this->Out) != smg::MeshFileKind::Stream && !conversion.keeps_numbers;
    notes.push_back(hasIds
                      ? std::string("The vertices are in stream order; ") + smg::OriginalIdName +
                          " names their places in " + this->In.string() + '.'
                      : "The vertices are in stream order.");
  }
  return notes;
}

void SolvingCommand::warn(const smg::Report& report) const
{
  const auto warning = [this](const std::string& what, double residual, int cycles)
  {
    std::fprintf(stderr,
      "smg: warning: %snot converged: the relative residual is %.3g after %d V-cycles, the "
      "tolerance %.3g\n",
      what.c_str(), residual, cycles, this->solveOptions().tolerance);
  };
  for (const smg::Report::Step& step : report.steps)
  {
    if (!step.converged)
    {
      warning(step.name + ": ", step.residual, step.cycles);
    }
  }
  if (report.steps.empty() && !report.converged)
  {
    warning("", report.residual(), report.cycles);
  }
}

namespace
{

/** For example " 1.5 2", one number per column. */
std::string listOf(const std::vector<double>& numbers)
{
  std::string list;
  for (const double number : numbers)
  {
    char text[32];
    std::snprintf(text, sizeof text, " %.6g", number);
    list += text;
  }
  return list;
}

/** For example "vertices 7, area 1.5, "; Dirichlet vertices need not span a facet. */
std::string extentOf(const smg::Report::Condition& condition)
{
  std::string extent;
  if (condition.vertices > 0)
  {
    extent = "vertices " + std::to_string(condition.vertices) + ", ";
  }
  if (condition.area > 0.0 || extent.empty())
  {
    extent += "area" + listOf({ condition.area }) + ", ";
  }
  return extent;
}

} // namespace

void SolvingCommand::print(const smg::Report& report) const
{
  std::printf("%lld vertices, %lld cells, %zu levels, %d V-cycles in %d passes, relative residual "
              "%.3g\n",
    static_cast<long long>(report.vertices), static_cast<long long>(report.cells),
    report.levels.size(), report.cycles, report.passes, report.residual());
  for (const smg::Report::Step& step : report.steps)
  {
    std::printf(
      "  %s: %d V-cycles, relative residual %.3g\n", step.name.c_str(), step.cycles, step.residual);
  }
  for (const smg::Report::Condition& condition : report.conditions)
  {
    std::printf("  %s: %smean%s, flux into the body%s\n", condition.name.c_str(),
      extentOf(condition).c_str(), listOf(condition.mean).c_str(), listOf(condition.flux).c_str());
  }
  for (const smg::Report::Seam& seam : report.seams)
  {
    std::printf("  %s: the largest step between patches was %.3g and is %.3g\n",
      seam.column.c_str(), seam.before, seam.after);
  }
  std::printf("%.2f s (%.2f s of CPU), %.1f MiB of accounted memory, %.1f MiB resident\n",
    report.seconds.total, report.cpu_seconds,
    static_cast<double>(report.pool_bytes_peak) / (1 << 20),
    static_cast<double>(report.rss_bytes_peak) / (1 << 20));
  for (const std::string& note : report.notes)
  {
    std::printf("%s\n", note.c_str());
  }
}
