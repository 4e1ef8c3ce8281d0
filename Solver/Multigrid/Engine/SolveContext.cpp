// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/SolveContext.h"

#include "Solver/Assembly/VertexTies.h"
#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/ReportFields.h"
#include "Solver/Files/Checksum.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Multigrid/Engine/AssemblyReport.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

// What surrounds a solve: memory, scratch files, threads, the report, and checkpoints. A checkpoint
// has what later passes need and the options on which the result may depend; threads and folders
// are not among these, so a solve may continue with others.

namespace smg
{
SolveContext::SolveContext(int columns, const SolveOptions& solveOptions)
  : options(solveOptions)
  , progress(solveOptions.progress)
  , pool(solveOptions.memoryLimit)
  , memory(this->pool, this->options)
  , components(columns, &this->pool)
  , labels(this->components)
  , free(this->components, this->labels, columns)
  , threads(solveOptions.threads)
{
  if (!solveOptions.checkpoint.folder.empty())
  {
    this->scratch.emplace(KeptFolder{ solveOptions.checkpoint.folder }, solveOptions.scratchLimit);
  }
  else if (!solveOptions.inCore)
  {
    this->scratch.emplace(solveOptions.scratch, solveOptions.scratchLimit);
  }
}

double SolveContext::flowNorm() const
{
  return this->flow->norm([this](std::size_t column) { return this->scales[column]; });
}

double SolveContext::shareOfTolerance(double reference) const
{
  const double flow = this->flow ? IterateFlow::Judged * this->flowNorm() : 0.0;
  return flow > 0.0 && reference > 0.0 ? std::min(1.0, flow / reference) : 1.0;
}

void SolveContext::beginReport()
{
  this->Wall = {};
  this->CpuAtStart = processSeconds();
}

/** What the assembly has found out about the mesh and the operator stays. */
void SolveContext::beginAgain()
{
  this->report = this->BuildReport;
  this->report.passes = 0;
  this->report.seconds = {};
  this->report.stages.clear();
  this->traffic.restart();
  this->beginReport();
}

void SolveContext::note(const Schedule& schedule, bool isFirstPass)
{
  std::vector<Report::Stage>& all = this->report.stages;
  for (std::size_t s = 0; s < schedule.stages().size(); ++s)
  {
    // The sweeps of a level are one entry.
    const Stage& stage = schedule.stages()[s];
    auto noted = std::ranges::find_if(all,
      [&](const Report::Stage& other) {
        return other.first == isFirstPass && other.level == stage.level && other.name == stage.name;
      });
    if (noted == all.end())
    {
      noted = all.insert(all.end(), { stage.name, stage.level, isFirstPass, 0.0 });
    }
    noted->seconds += schedule.seconds(s);
  }
}

void SolveContext::finishReport()
{
  Report& r = this->report;
  addAssemblyNotes(r, this->free.undetermined());
  r.peak_nodes = this->resident.peak;
  r.pool_bytes_peak = this->pool.peak();
  // The larger one: the passes so far may have been those of an earlier program, which this one
  // continues.
  r.rss_bytes_peak = std::max(r.rss_bytes_peak, peakResidentBytes());
  r.scratch_bytes_peak = this->scratch ? this->scratch->account().peak() : 0;
  r.bytes_read = this->traffic.bytesRead();
  r.bytes_written = this->traffic.bytesWritten();
  r.bytes_by_kind.clear();
  for (const auto& [name, level, statistics] : this->traffic.kinds())
  {
    r.bytes_by_kind.push_back({ name, level, statistics.bytesRead, statistics.bytesWritten });
  }
  r.seconds.io_wait = this->traffic.waitSeconds();
  r.seconds.total = this->seconds();
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
  r.threads = this->threads.workers.threads();
}

namespace
{

/** 17 significant digits determine a double: two options are equal if and only if their texts
 * are. */
std::string exact(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

std::string hashOf(const std::string& text)
{
  return std::to_string(checksum(std::as_bytes(std::span(text))));
}

/** The options on which the result may depend. The memory limit and the size of core levels are
 * among them: they decide which levels are streamed and how V-cycles are accelerated. */
std::vector<Checkpoint::Item> itemsOf(const SolveOptions& options)
{
  return { { "mesh", hashOf(options.checkpoint.mesh) },
    { "problem", hashOf(options.checkpoint.problem) }, { "operator set", options.operators },
    { "number of sweeps", std::to_string(options.sweeps) },
    { "tolerance", exact(options.tolerance) },
    { "largest number of V-cycles", std::to_string(options.maxCycles) },
    { "acceleration", std::to_string(static_cast<int>(options.acceleration)) },
    { "memory limit", std::to_string(options.memoryLimit) },
    { "size of core levels", std::to_string(options.coreNodes) } };
}

} // namespace

bool SolveContext::resume(std::vector<Checkpoint::Item> subject, Parts kept)
{
  if (this->options.checkpoint.folder.empty())
  {
    return false;
  }
  std::vector<Checkpoint::Item> items = itemsOf(this->options);
  std::move(subject.begin(), subject.end(), std::back_inserter(items));
  this->checkpoint.emplace(*this->scratch, std::move(items));
  this->Kept = std::move(kept);
  std::optional<StateReader> state = this->checkpoint->open(this->pool);
  if (!state)
  {
    return false;
  }
  this->load(*state);
  const int passes = this->report.passes;
  this->report.resumed_passes = passes;
  this->report.notes.push_back(
    "continued after pass " + std::to_string(passes) + ", the last one that the checkpoint has");
  return true;
}

void SolveContext::endPass(double residual)
{
  Report::Pass pass{ residual, this->seconds(), this->traffic.bytesRead(),
    this->traffic.bytesWritten(), this->pool.peak() };
  // The counters run over the whole solve: what earlier passes had is subtracted.
  for (const Report::Pass& before : this->report.by_pass)
  {
    pass.seconds -= before.seconds;
    pass.read -= before.read;
    pass.written -= before.written;
  }
  this->report.by_pass.push_back(pass);
  // After the pass is in the report, which is part of the state.
  if (this->checkpoint)
  {
    this->checkpoint->save(this->report.passes, [this](StateWriter& state) { this->save(state); });
  }
}

void SolveContext::readCompleted(
  LevelWindow<double>& window, std::int64_t first, std::int64_t count, std::span<double> values)
{
  const auto read = [&](std::int64_t begin, std::span<double> of)
  {
    const std::int64_t vertices =
      static_cast<std::int64_t>(of.size()) / static_cast<std::int64_t>(window.columns());
    window.readX(begin, vertices, of.data());
    this->free.complete(begin, vertices, of);
  };
  read(first, values.first(static_cast<std::size_t>(count * window.columns())));
  if (this->couplings)
  {
    completeTied(*this->couplings, this->corrected ? TiedDifference::None : TiedDifference::Jump,
      first, static_cast<std::size_t>(window.columns()), values, read);
  }
}

/** Times and memory so far go into the report first, so that the program which continues adds
 * its own to them. */
void SolveContext::save(StateWriter& state)
{
  Report& r = this->report;
  r.seconds.total = this->seconds();
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
  r.rss_bytes_peak = std::max(r.rss_bytes_peak, peakResidentBytes());
  FieldsState<Report> reported{ r };
  const std::int64_t peak = this->pool.peak();
  state.part("run");
  state(reported, peak, this->memory, this->components, this->labels);
  this->Kept.save(state);
  state.part("counts");
  const std::uint64_t kinds = this->traffic.kinds().size();
  state(this->resident, kinds);
  for (const auto& [name, level, statistics] : this->traffic.kinds())
  {
    const std::array<std::int64_t, 3> counts{ statistics.bytesRead, statistics.bytesWritten,
      statistics.waitNanoseconds };
    state(name, level, counts);
  }
}

void SolveContext::load(StateReader& state)
{
  FieldsState<Report> reported{ this->report };
  std::int64_t peak = 0;
  // Files must exist before their places are restored.
  this->labels.useScratch(*this->scratch, this->traffic.add("labels"));
  state.part("run");
  state(reported, peak, this->memory, this->components, this->labels);
  this->pool.raisePeak(peak);
  this->SecondsBefore = this->report.seconds.total;
  // As if this program had started earlier by the time that the others took.
  this->CpuAtStart -= this->report.cpu_seconds;
  this->Kept.load(state);
  // Last, since restoring the other parts has counted nodes and added files.
  state.part("counts");
  std::uint64_t kinds = 0;
  state(this->resident, kinds);
  for (; kinds > 0; --kinds)
  {
    std::string name;
    int level = 0;
    std::array<std::int64_t, 3> counts{};
    state(name, level, counts);
    IoStatistics& statistics = this->traffic.of(name, level);
    statistics.bytesRead += counts[0];
    statistics.bytesWritten += counts[1];
    statistics.waitNanoseconds += counts[2];
  }
  state.finish();
}

} // namespace smg
