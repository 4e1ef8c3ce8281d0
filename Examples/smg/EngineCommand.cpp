// SPDX-License-Identifier: BSD-3-Clause
#include "EngineCommand.h"

#include "ProgressBar.h"

#include "IO/Files/TextOutput.h"
#include "IO/Formats/MeshFile.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <cstdio>

#include <dlfcn.h>

namespace
{

/** A solution that another object owns. */
class BorrowedSolution final : public smg::Solution
{
public:
  explicit BorrowedSolution(smg::Solution& solution)
    : Lent(solution)
  {
  }
  std::int64_t vertices() const override { return this->Lent.vertices(); }
  int columns() const override { return this->Lent.columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->Lent.read(first, count, values);
  }
  const smg::Report& report() const override { return this->Lent.report(); }

private:
  smg::Solution& Lent;
};

/** Loads the engine. Throws smg::Error if this build or this system does not have it. */
const DistributedEngine& distributedEngine()
{
#ifdef SMG_HYPRE_ENGINE
  // Found by the RUNPATH of the program. The components that OpenMPI loads look for its symbols
  // among the global ones.
  void* const handle = ::dlopen(SMG_HYPRE_ENGINE, RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = handle ? ::dlsym(handle, "smgDistributedEngine") : nullptr;
  if (!symbol)
  {
    const char* const reason = ::dlerror();
    throw smg::Error(std::string("--engine hypre: the library ") + SMG_HYPRE_ENGINE +
                     " cannot be loaded (" + (reason ? reason : "unknown error") +
                     "): install it with MPI and hypre, or use --engine streaming.");
  }
  return *reinterpret_cast<decltype(&smgDistributedEngine)>(symbol)();
#else
  throw smg::Error("--engine hypre: this smg was built without MPI and hypre (SMG_USE_HYPRE): use "
                   "--engine streaming.");
#endif
}

} // namespace

void EngineCommand::addEngineTo(CLI::App& command)
{
  command
    .add_option("--engine", this->Engine,
      "streaming, or hypre: BoomerAMG on the processes that mpiexec starts; IN is a .vsm file, "
      "OUT may be .pvtu or .pvtp, with a piece of each process")
    ->check(oneOf({ "streaming", "hypre" }))
    ->capture_default_str();
  this->MaxCycles = command.get_option("--max-cycles");
  // Nothing is solved, or nothing printed.
  CLI::Option* const dryRun = command.get_option("--dry-run");
  command
    .add_flag("--explain", this->Explain,
      "Print the levels with their windows in memory, and the stages of the passes with their "
      "times")
    ->excludes(dryRun, command.get_option("--quiet"));
  command
    .add_option("--trace", this->Trace,
      "Write a table (CSV) of how the passes move over the levels: the nodes that each stage "
      "passes in each step, and those in memory")
    ->type_name("FILE")
    ->excludes(dryRun);
}

void EngineCommand::print(const smg::Report& report) const
{
  this->MeshCommand::print(report);
  if (!this->Explain || report.stages.empty())
  {
    return;
  }
  std::printf("\n%5s %12s %12s\n", "level", "nodes", "in memory");
  for (std::size_t l = 0; l < report.levels.size(); ++l)
  {
    const smg::Report::Level& level = report.levels[l];
    std::printf("%5zu %12s %12s\n", l, smg::groupedDigits(level.nodes).c_str(),
      level.window > 0 ? smg::groupedDigits(level.window).c_str() : "");
  }
  double total = 0.0;
  for (const smg::Report::Stage& stage : report.stages)
  {
    total += stage.seconds;
  }
  std::printf("\n%-13s %5s  %-26s %9s %6s\n", "pass", "level", "stage", "seconds", "share");
  for (const smg::Report::Stage& stage : report.stages)
  {
    std::printf("%-13s %5d  %-26s %9.3f %5.1f%%\n", stage.first ? "first" : "later ones",
      stage.level, stage.name.c_str(), stage.seconds, 100.0 * stage.seconds / total);
  }
}

std::unique_ptr<smg::Solution> EngineCommand::solveOn(
  const smg::StoredMesh& mesh, const smg::ProgressFunction& progress)
{
  if (!this->Whole)
  {
    return this->MeshCommand::solveOn(mesh, progress);
  }
  this->job().prepareOn(mesh);
  return std::make_unique<BorrowedSolution>(*this->Whole);
}

/** With hypre, the first process writes and reports as ever, or reports on the pieces of all. */
void EngineCommand::compute()
{
  if (!this->isForProcesses())
  {
    this->computeTraced();
    return;
  }
  constexpr int MaxIterations = 200;
  auto bar = std::make_unique<ProgressBar>(this->title(), this->quiet);
  DistributedJob job;
  job.in = this->In;
  job.out = this->Out;
  job.task = this->File.string();
  job.text = &this->text();
  job.scratch = this->scratch;
  job.maxIterations =
    this->MaxCycles->count() > 0 ? this->solving()->options().maxCycles : MaxIterations;
  job.memoryLimit = this->memoryBytes(INT64_MAX);
  job.progress = bar->function();
  job.check = [this] { this->checkDistributed(); };
  job.use = [this, &bar](smg::Solution& solution)
  {
    bar.reset();
    this->Whole = &solution;
    this->MeshCommand::compute();
  };
  job.report = [this, &bar](smg::Report& report)
  {
    bar.reset();
    this->writeReport(report.json(), this->pageFacts());
    this->tell(report);
  };
  this->computeOn(distributedEngine(), job);
}

/** On this process, with a trace if one is requested. */
void EngineCommand::computeTraced()
{
  if (this->Trace.empty())
  {
    this->MeshCommand::compute();
    return;
  }
  this->checkFiles(this->files());
  smg::TextOutput table(this->Trace);
  table << "pass,step,level,stage,first,end\n";
  this->solving()->options().trace = [&table](const smg::TraceEntry& entry)
  {
    table << entry.pass << ',' << entry.step << ',' << entry.level << ",\"" << entry.stage << "\","
          << entry.first << ',' << entry.end << '\n';
  };
  this->MeshCommand::compute();
  this->solving()->options().trace = nullptr;
  table.finish();
}

/** Reports foreseeable failures. */
void EngineCommand::checkDistributed()
{
  const smg::SolveOptions& options = this->solving()->options();
  if (options.inCore || !this->checkpoint.empty() || this->isDryRun() || !this->Trace.empty() ||
      this->Explain || options.operators != "extended" || this->isGiven("acceleration") ||
      this->isGiven("sweeps"))
  {
    throw smg::Error("--engine hypre has no --acceleration, --sweeps, --in-core, --checkpoint, "
                     "--dry-run, --explain, --trace or --operators: leave them out.");
  }
  if (smg::kindOfInput(this->In) != smg::MeshFileKind::Vsm)
  {
    throw smg::Error(this->In.string() +
                     ": --engine hypre needs a .vsm file, of which each process reads a piece: "
                     "convert the mesh first (smg convert).");
  }
  if (isInPieces(this->Out))
  {
    smg::checkOutputPlace(this->Out);
    this->checkFiles(this->files());
    this->readJob();
  }
  else
  {
    this->prepareFiles();
  }
  this->checkForProcesses();
}
