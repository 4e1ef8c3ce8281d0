// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Engine.h"

#include <tbb/info.h>

#include <algorithm>
#include <cfloat>
#include <numeric>
#include <string>
#include <utility>

namespace smg
{

/** Compute threads where `wanted` are asked for; 0: one a core. */
inline int computeThreads(int wanted)
{
  // Of the first pass: the assembly, the coarsening of two levels (the others are small), the way
  // down. Of later passes: the way up, the way down, reading and writing.
  constexpr int ParallelStages = 4;
  const int most = std::min(ParallelStages, tbb::info::default_concurrency());
  return wanted > 0 ? std::min(wanted, most) : most;
}

template <OperatorSet Operators>
Engine<Operators>::Engine(Operators operators, int columns, const SolveOptions& options)
  : Set(std::move(operators))
  , Columns(columns)
  , Options(options)
  , Progress(options.progress)
  , Memory(options.memoryLimit)
  , Parts(columns, &this->Memory)
  , Labels(this->Parts)
  , Free(this->Parts, this->Labels, columns)
  , Threads(computeThreads(options.threads))
{
  if (!options.inCore)
  {
    this->Scratch.emplace(options.scratch);
  }
}

template <OperatorSet Operators>
void Engine<Operators>::solve(MeshSource& mesh, Problem& problem)
{
  this->beginReport();
  const Stopping stopping{ this->Options.tolerance, this->Options.maxCycles };
  this->Progress.begin(stopping, 0.0, 1.0, true);
  this->build(mesh, problem);
  const Timer solving;
  Convergence convergence(stopping, this->InitialNorm, this->RoundingNorm);
  convergence.begin(this->residualNorm(), this->Parts.incompatibility() == 0.0);
  this->iterate(convergence, false);
  this->Result.cycles = convergence.cycles();
  this->Result.residuals = convergence.residuals();
  this->Result.converged = convergence.converged();
  convergence.addNotes(this->Result.notes, "");
  this->Free.fixMeans(this->Hierarchy.finest->window(), this->Result.notes);
  this->Result.seconds.solve = solving.seconds();
  this->finishReport();
  this->keepSolution();
}

template <OperatorSet Operators>
void Engine<Operators>::build(
  MeshSource& mesh, Problem& problem, RowListener* listener, std::int64_t furtherCoreBytes)
{
  const Timer building;
  if (const std::int64_t need =
        estimateMemory(mesh.info(), problem, this->Options, furtherCoreBytes);
      need > this->Options.memoryLimit)
  {
    throw Error(memoryLimitSentence(need, this->Options.memoryLimit));
  }
  if (!this->Options.inCore)
  {
    this->Labels.useScratch(this->Scratch->path(), this->Traffic.add("labels"));
  }
  this->addLevels(mesh.info().vertices);
  this->firstPass(mesh, problem, listener);
  this->Free.projectRightSide(this->Hierarchy.finest->window(), this->Result);
  this->Result.seconds.build = building.seconds();
  this->Result.seconds.build_io_wait = this->Traffic.waitSeconds();
}

template <OperatorSet Operators>
void Engine<Operators>::keepSolution()
{
  this->Core = {};
  this->Hierarchy.coarse.clear();
  this->Hierarchy.finest->window().keepSolution();
  this->Progress.finish();
}

template <OperatorSet Operators>
void Engine<Operators>::addLevels(std::int64_t vertices)
{
  this->FirstCore = this->firstCoreLevel(vertices);
  this->Hierarchy.finest = std::make_unique<FineLevel>(
    this->Memory, this->Resident, 0, this->Columns, this->Options.sweeps);
  if (this->Scratch)
  {
    this->Hierarchy.finest->window().useScratch(this->Scratch->path(), this->Traffic);
  }
  for (int l = 1; l <= this->FirstCore; ++l)
  {
    this->addCoarseLevel(l, l == this->FirstCore);
  }
}

/** The finest level that lives in memory, by the sizes that levels usually have. */
template <OperatorSet Operators>
int Engine<Operators>::firstCoreLevel(std::int64_t vertices) const
{
  // Lifted share of the nodes, from above: 0.24 to 0.43 on the finest level, 0.14 to 0.31 beyond.
  constexpr double FirstShare = 0.43, FurtherShare = 0.31;
  constexpr std::int64_t BytesPerCoreNode = 400;
  constexpr int UnknownSize = 4;
  if (vertices <= 0)
  {
    return UnknownSize;
  }
  const auto most = static_cast<double>(
    std::min(this->Options.coreNodes, this->Options.memoryLimit / 4 / BytesPerCoreNode));
  double nodes = FirstShare * static_cast<double>(vertices);
  int l = 1;
  for (; nodes > most && nodes > HierarchyBuilder<Operators>::CoarsestNodes; ++l)
  {
    nodes *= FurtherShare;
  }
  return l;
}

template <OperatorSet Operators>
void Engine<Operators>::addCoarseLevel(int l, bool core)
{
  auto level = std::make_unique<CoarseLevel>(
    this->Memory, this->Resident, l, this->Columns, this->Options.sweeps);
  if (core)
  {
    level->setCore();
  }
  else if (this->Scratch)
  {
    level->window().useScratch(this->Scratch->path(), this->Traffic);
  }
  if (l == 1)
  {
    level->setFine(&this->Hierarchy.finest->cursors());
    this->Hierarchy.finest->setCoarse(level.get());
  }
  else
  {
    CoarseLevel& fine = *this->Hierarchy.coarse.back();
    level->setFine(&fine.cursors());
    fine.setCoarse(level.get());
  }
  this->Hierarchy.coarse.push_back(std::move(level));
}

template <OperatorSet Operators>
void Engine<Operators>::startPass(bool first)
{
  this->Hierarchy.finest->startPass(first);
  for (auto& level : this->Hierarchy.coarse)
  {
    level->startPass(first);
  }
}

template <OperatorSet Operators>
void Engine<Operators>::endPass()
{
  if (!this->Hierarchy.finest->finished())
  {
    throw Error("a pass ended before all nodes were done: this is a fault of the program");
  }
  this->Hierarchy.finest->endPass();
  for (auto& level : this->Hierarchy.coarse)
  {
    level->endPass();
  }
  ++this->Result.passes;
}

template <OperatorSet Operators>
double Engine<Operators>::residualNorm() const
{
  const auto squares = this->Hierarchy.finest->squares();
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0));
}

template <OperatorSet Operators>
double Engine<Operators>::roundingNorm() const
{
  const auto squares = this->Hierarchy.finest->termSquares();
  return roundingOf(std::accumulate(squares.begin(), squares.end(), 0.0));
}

template <OperatorSet Operators>
void Engine<Operators>::firstPass(MeshSource& mesh, Problem& problem, RowListener* listener)
{
  const CellType type = mesh.info().cellType;
  AssembledRows rows;
  HierarchyBuilder<Operators> builder(this->Memory, this->Set, this->Hierarchy, this->FirstCore,
    Assembly::stiffRows(type, problem.weights(), rows));
  Assembly assembly(this->Memory, mesh.info(), problem, rows, this->Parts, this->Labels, listener);
  this->startPass(true);
  this->readStream(mesh, assembly, rows, builder);
  const int coarsest = builder.finish([this](int l) { this->addCoarseLevel(l, true); });
  this->endPass();
  if (coarsest < this->FirstCore)
  {
    this->FirstCore = coarsest;
    this->Hierarchy.coarse.resize(static_cast<std::size_t>(coarsest));
    this->Hierarchy.coarse.back()->setCore();
    this->Hierarchy.coarse.back()->window().moveToMemory();
  }
  this->factorize();
  this->noteAssembly(assembly);
  constexpr std::int64_t StiffShare = 512;
  this->SlowestAreAtSlivers = assembly.stiffRows() > assembly.vertices() / StiffShare;
}

/**
 * The first pass. In each step the next block of the mesh is assembled, every streamed level is
 * coarsened, and the way down advances, all at the same time, each on what the steps before have
 * handed over.
 */
template <OperatorSet Operators>
void Engine<Operators>::readStream(
  MeshSource& mesh, Assembly& assembly, AssembledRows& rows, HierarchyBuilder<Operators>& builder)
{
  FineLevel& finest = *this->Hierarchy.finest;
  MeshBlock block;
  bool more = true;
  std::int64_t open = 0;
  const auto expected = static_cast<double>(std::max<std::int64_t>(1, mesh.info().vertices));
  const auto assemble = [&]
  {
    if (more)
    {
      more = mesh.next(block);
      more ? assembly.add(block) : assembly.finish();
    }
  };
  while (!builder.complete())
  {
    runAll(this->Threads, 2 + this->FirstCore,
      [&](int task)
      {
        // The mesh and the problem are asked on the caller's thread; of the other tasks those that
        // take longest come first.
        task == 0   ? assemble()
        : task == 1 ? builder.advance(0)
        : task == 2 ? finest.advanceDown()
                    : builder.advance(task - 2);
      });
    finest.settle();
    rows.moveTo(builder.finestRows(), finest.window(), this->Columns);
    builder.finestRows().Ended = !more;
    builder.handOver();
    this->Resident.add(assembly.openVertices() - open);
    open = assembly.openVertices();
    this->Progress.updateFirst(static_cast<double>(assembly.vertices()) / expected);
  }
  finest.advanceDown();
  finest.settle();
  if (assembly.vertices() == 0)
  {
    throw Error("the mesh has no vertices");
  }
  this->Labels.finish();
}

template <OperatorSet Operators>
void Engine<Operators>::factorize()
{
  const Timer factorizing;
  std::vector<CoarseLevel*> core;
  for (std::size_t l = static_cast<std::size_t>(this->FirstCore);
       l <= this->Hierarchy.coarse.size(); ++l)
  {
    core.push_back(this->Hierarchy.coarse[l - 1].get());
  }
  this->Core.setLevels(std::move(core));
  this->Result.seconds.coarse += factorizing.seconds();
}

template <OperatorSet Operators>
void Engine<Operators>::noteAssembly(const Assembly& assembly)
{
  reportAssembly(assembly, this->Parts, this->Result);
  this->RoundingNorm = roundingOf(assembly.residual().termSquares());
  const double whole = assembly.residual().squares();
  const double shifted = std::max(0.0, whole + this->Parts.shiftedSquares());
  // Where the sources are all mean, what is left of them is the rounding of this difference of
  // squares, and no measure of the residual: then it is that of the sources themselves.
  constexpr double LeastShare = 1e-14;
  this->InitialNorm = std::sqrt(shifted < LeastShare * whole ? whole : shifted);
}

template <OperatorSet Operators>
template <class Loaded, class BeforeDown>
void Engine<Operators>::pass(
  double scale, Loaded&& loaded, BeforeDown&& beforeDown, IterateHistory* history)
{
  FineLevel& finest = *this->Hierarchy.finest;
  this->startPass(false);
  finest.setHistory(history);
  const std::int64_t nodes = finest.window().nodes();
  const double typical = scale / std::sqrt(static_cast<double>(nodes));
  finest.setScale(typical > DBL_MIN && typical < DBL_MAX ? std::exp2(-std::ilogb(typical)) : 1.0);
  const auto down = [&]
  {
    beforeDown();
    finest.advanceDown();
  };
  for (std::int64_t begin = 0; begin < nodes; begin += this->Options.blockNodes)
  {
    const std::int64_t last = std::min(nodes, begin + this->Options.blockNodes) - 1;
    finest.load(last);
    loaded();
    // The way down works on what the way up left behind a step ago, and what is written the way
    // down has left behind: no node is touched by two of them.
    finest.showProgress();
    runAll(this->Threads, 4,
      [&](int task)
      {
        task == 0   ? finest.pull(last)
        : task == 1 ? down()
        : task == 2 ? finest.readAhead()
                    : finest.write();
      });
    finest.release();
    this->Progress.update(static_cast<double>(last) / static_cast<double>(nodes));
  }
  finest.showProgress();
  down();
  finest.settle();
  this->endPass();
}

template <OperatorSet Operators>
void Engine<Operators>::runCore()
{
  const Timer coarse;
  this->Core.run();
  this->Result.seconds.coarse += coarse.seconds();
}

template <OperatorSet Operators>
void Engine<Operators>::checkRange(std::int64_t first, std::int64_t count, std::size_t room) const
{
  checkVertexRange(first, count, room, this->Result.vertices);
}

template <OperatorSet Operators>
void Engine<Operators>::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  this->checkRange(first, count, values.size() / static_cast<std::size_t>(this->Columns));
  this->Hierarchy.finest->window().readX(first, count, values.data());
  this->Free.shift(first, count, values);
}

template <OperatorSet Operators>
void Engine<Operators>::beginReport()
{
  this->Wall = {};
  this->CpuAtStart = processSeconds();
}

template <OperatorSet Operators>
void Engine<Operators>::finishReport()
{
  Report& r = this->Result;
  addAssemblyNotes(r);
  r.levels = this->Hierarchy.sizes;
  r.levels.front().nodes -= r.prescribed + r.held;
  r.levels.front().nonzeros -= r.prescribed + r.held;
  r.peak_nodes = this->Resident.peak;
  r.pool_bytes_peak = this->Memory.peak();
  r.rss_bytes_peak = peakResidentBytes();
  r.bytes_read = r.bytes_written = 0;
  r.bytes_by_kind.clear();
  for (const auto& [name, level, statistics] : this->Traffic.kinds())
  {
    r.bytes_by_kind.push_back({ name, level, statistics.bytesRead, statistics.bytesWritten });
    r.bytes_read += statistics.bytesRead;
    r.bytes_written += statistics.bytesWritten;
  }
  r.seconds.io_wait = this->Traffic.waitSeconds();
  r.seconds.total = this->Wall.seconds();
  r.cpu_seconds = processSeconds() - this->CpuAtStart;
  r.threads = this->Threads.max_concurrency();
}

} // namespace smg

#include "Solver/Engine/Iteration.txx"
