// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Engine.h"

#include <tbb/info.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>
#include <numeric>
#include <string>

namespace smg
{

/** "1.23e-07" */
inline std::string scientific(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2e", value);
  return text;
}

template <OperatorSet Operators>
Engine<Operators>::Engine(MeshSource& mesh, Problem& problem, const SolveOptions& options)
  : Columns(problem.columns())
  , Options(options)
  , Progress(options.progress, options.tolerance, options.maxCycles)
  , Memory(options.memoryLimit)
  , Parts(problem.columns(), &this->Memory)
  , FirstCore(this->firstCoreLevel(mesh.info().vertices))
  , Threads(std::min({ options.threads, ParallelStages, tbb::info::default_concurrency() }))
{
  const Timer wall;
  const double cpu = processSeconds();
  if (const std::int64_t need = estimateMemory(mesh.info(), problem, options);
      need > options.memoryLimit)
  {
    throw Error(memoryLimitSentence(need, options.memoryLimit));
  }
  if (!options.inCore)
  {
    this->Scratch.emplace(options.scratch);
    this->Labels.useScratch(this->Scratch->path(), this->Traffic);
  }
  this->Hierarchy.finest =
    std::make_unique<FineLevel>(this->Memory, this->Resident, 0, this->Columns, options.sweeps);
  if (this->Scratch)
  {
    this->Hierarchy.finest->window().useScratch(this->Scratch->path(), this->Traffic);
  }
  for (int l = 1; l <= this->FirstCore; ++l)
  {
    this->addCoarseLevel(l, l == this->FirstCore);
  }

  this->firstPass(mesh, problem);
  this->Result.seconds.build = wall.seconds();
  const Timer solving;
  this->iterate();
  this->fixMeans();
  this->Result.seconds.solve = solving.seconds();
  this->fillReport(wall.seconds(), processSeconds() - cpu);
  this->Core = {};
  this->Hierarchy.coarse.clear();
  this->Hierarchy.finest->window().keepSolution();
  this->Progress.finish();
}

/** The finest level that lives in memory, by the sizes that levels usually have. */
template <OperatorSet Operators>
int Engine<Operators>::firstCoreLevel(std::int64_t vertices) const
{
  // Lifted share of the nodes, from above: 0.26 to 0.34 on the finest level, 0.15 to 0.25 beyond.
  constexpr double FirstShare = 0.34, FurtherShare = 0.25;
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
void Engine<Operators>::startPass()
{
  const bool first = this->Result.passes == 0;
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
  const std::vector<double>& squares = this->Hierarchy.finest->squares();
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0));
}

template <OperatorSet Operators>
void Engine<Operators>::firstPass(MeshSource& mesh, Problem& problem)
{
  FineLevel& finest = *this->Hierarchy.finest;
  HierarchyBuilder<Operators> builder(
    this->Memory, Operators::forCells(mesh.info().cellType), this->Hierarchy, this->FirstCore);
  Assembly assembly(this->Memory, mesh.info(), problem, builder.finestRows(), finest.window(),
    this->Parts, this->Labels);
  this->startPass();
  MeshBlock block;
  std::int64_t open = 0;
  const auto expected = static_cast<double>(std::max<std::int64_t>(1, mesh.info().vertices));
  while (mesh.next(block))
  {
    assembly.add(block);
    builder.advance();
    finest.advanceDown();
    finest.settle();
    this->Resident.add(assembly.openVertices() - open);
    open = assembly.openVertices();
    this->Progress.update(0, static_cast<double>(assembly.vertices()) / expected);
  }
  if (assembly.vertices() == 0)
  {
    throw Error("the mesh has no vertices");
  }
  assembly.finish();
  this->Labels.finish();
  this->Resident.add(-open);
  builder.advance();
  finest.advanceDown();
  finest.settle();
  const int coarsest = builder.finish([this](int l) { this->addCoarseLevel(l, true); });
  this->endPass();
  if (coarsest < this->FirstCore)
  {
    this->FirstCore = coarsest;
    this->Hierarchy.coarse.resize(static_cast<std::size_t>(coarsest));
    this->Hierarchy.coarse.back()->setCore();
    this->Hierarchy.coarse.back()->window().moveToMemory();
  }

  const Timer factorizing;
  std::vector<CoarseLevel*> core;
  for (std::size_t l = static_cast<std::size_t>(this->FirstCore);
       l <= this->Hierarchy.coarse.size(); ++l)
  {
    core.push_back(this->Hierarchy.coarse[l - 1].get());
  }
  this->Core.setLevels(std::move(core));
  this->Result.seconds.coarse = factorizing.seconds();

  this->Result.vertices = assembly.vertices();
  this->Result.cells = assembly.cells();
  this->Result.prescribed = assembly.prescribed();
  this->Result.held = assembly.held();
  this->Result.degenerate_cells = assembly.degenerateCells();
  this->Result.clamped_weights = assembly.clampedWeights();
  this->Result.components = this->Parts.components();
  this->Result.free_components = this->Parts.freeComponents();
  // Below this the residual is the rounding of its own terms.
  constexpr double Rounding = 4e-16;
  this->RoundingNorm = Rounding * std::sqrt(assembly.termSquares());
  this->InitialNorm =
    std::sqrt(std::max(0.0, assembly.initialSquares() - this->Parts.incompatibleSquares()));
  if (!std::isfinite(assembly.termSquares()))
  {
    throw Error(
      "the squares of the values overflow: scale the mesh, the prescribed values or the sources");
  }
  this->projectRightSide();
}

template <OperatorSet Operators>
void Engine<Operators>::laterPass(double norm)
{
  FineLevel& finest = *this->Hierarchy.finest;
  this->startPass();
  const std::int64_t nodes = finest.window().nodes();
  const double typical = norm / std::sqrt(static_cast<double>(nodes));
  finest.setScale(typical > DBL_MIN ? std::exp2(-std::ilogb(typical)) : 1.0);
  for (std::int64_t begin = 0; begin < nodes; begin += this->Options.blockNodes)
  {
    const std::int64_t last = std::min(nodes, begin + this->Options.blockNodes) - 1;
    finest.load(last);
    // The way down works on what the way up left behind a step ago: no node is touched by both.
    finest.showProgress();
    runBoth(
      this->Threads, [&] { finest.pull(last); }, [&] { finest.advanceDown(); });
    finest.settle();
    this->Progress.update(
      this->Result.cycles + 1, static_cast<double>(last) / static_cast<double>(nodes));
  }
  finest.showProgress();
  finest.advanceDown();
  finest.settle();
  this->endPass();
}

template <OperatorSet Operators>
void Engine<Operators>::iterate()
{
  // A residual that is this much larger than it was at first will not recover.
  constexpr double Diverged = 1e4;
  // A residual that has not lost this share in so many V-cycles will not do much better; where it
  // is of the size of its terms' rounding, fewer tell.
  constexpr double Stagnating = 0.9;
  constexpr int Patience = 6, RoundingPatience = 2;
  constexpr double NearRounding = 10.0;
  // Initial values that solve the problem up to rounding cannot be improved by a tolerance.
  const bool exact = this->InitialNorm <= this->RoundingNorm;
  const double reference = exact ? this->RoundingNorm : this->InitialNorm;
  const double goal = exact ? reference : this->Options.tolerance * reference;
  Report& r = this->Result;
  double norm = this->residualNorm();
  const double firstNorm = std::max(reference, norm);
  r.converged = norm <= goal && this->Parts.incompatibleSquares() == 0.0;
  while (!r.converged && r.cycles < this->Options.maxCycles)
  {
    const Timer coarse;
    this->Core.run();
    r.seconds.coarse += coarse.seconds();
    this->laterPass(norm);
    ++r.cycles;
    norm = this->residualNorm();
    const double relative = reference > 0.0 ? norm / reference : 0.0;
    r.residuals.push_back(relative);
    this->Progress.endCycle(r.cycles, relative);
    r.converged = norm <= goal;
    if (!std::isfinite(norm) || (norm > Diverged * firstNorm && !r.converged))
    {
      throw Error("the solve diverges (relative residual " + scientific(relative) + " after " +
                  std::to_string(r.cycles) +
                  " V-cycles): the mesh has very bad cells; use uniform weights or more sweeps");
    }
    const bool rounding = norm <= NearRounding * this->RoundingNorm;
    const int patience = rounding ? RoundingPatience : Patience;
    const double before = r.cycles > patience
                            ? r.residuals[static_cast<std::size_t>(r.cycles - patience - 1)]
                            : firstNorm / reference;
    if (!r.converged && r.cycles >= patience && relative > Stagnating * before)
    {
      r.converged = rounding;
      r.notes.push_back(
        rounding
          ? "converged as far as the rounding of the numbers allows: the relative residual is " +
              scientific(relative)
          : "not converged: the relative residual stagnates at " + scientific(relative));
      return;
    }
  }
  if (!r.converged)
  {
    r.notes.push_back("not converged: the relative residual is " + scientific(r.residuals.back()) +
                      " after " + std::to_string(r.cycles) + " V-cycles, the most allowed");
  }
}

/**
 * A component without constraint has a solution only if its right-hand side sums to zero: takes the
 * mean from it where it does not.
 */
template <OperatorSet Operators>
void Engine<Operators>::projectRightSide()
{
  if (this->Parts.incompatibleSquares() == 0.0)
  {
    return;
  }
  const std::vector<double> shifts = this->Parts.rightSideShifts();
  this->Hierarchy.finest->window().rewriteB(
    [&](std::int64_t block, std::span<double> b)
    {
      const auto labels = this->Labels.block(block);
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        const std::int64_t root = labels[i] < 0 ? -1 : this->Parts.root(labels[i]);
        if (root >= 0 && this->Parts.isFree(static_cast<std::int32_t>(root)))
        {
          for (int k = 0; k < this->Columns; ++k)
          {
            b[i * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)] -=
              shifts[static_cast<std::size_t>(root * this->Columns + k)];
          }
        }
      }
    });
  this->Result.notes.push_back(
    "the right-hand side of a component without prescribed value does not "
    "sum to zero: its mean was taken from it");
}

/** Gives the components without constraint the mean of their initial values. */
template <OperatorSet Operators>
void Engine<Operators>::fixMeans()
{
  if (this->Result.free_components == 0)
  {
    return;
  }
  std::vector<double> sums(static_cast<std::size_t>(this->Parts.labels() * this->Columns));
  std::vector<double> values(ComponentLabels::Block * static_cast<std::size_t>(this->Columns));
  for (std::int64_t first = 0; first < this->Result.vertices;
       first += static_cast<std::int64_t>(ComponentLabels::Block))
  {
    const auto labels =
      this->Labels.block(first / static_cast<std::int64_t>(ComponentLabels::Block));
    this->Hierarchy.finest->window().readX(
      first, static_cast<std::int64_t>(labels.size()), values.data());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const std::int64_t root = labels[i] < 0 ? -1 : this->Parts.root(labels[i]);
      for (int k = 0; root >= 0 && k < this->Columns; ++k)
      {
        sums[static_cast<std::size_t>(root * this->Columns + k)] +=
          values[i * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)];
      }
    }
  }
  this->MeanShifts = this->Parts.meanShifts(sums);
  this->Result.notes.push_back(
    std::to_string(this->Result.free_components) + " of " +
    std::to_string(this->Result.components) +
    " components have no prescribed value: they keep the mean of their initial values");
}

template <OperatorSet Operators>
void Engine<Operators>::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  if (first < 0 || count < 0 || first > this->Result.vertices - count ||
      values.size() < static_cast<std::size_t>(count * this->Columns))
  {
    throw Error(std::to_string(count) + " vertices from " + std::to_string(first) +
                " on were asked of a solution of " + std::to_string(this->Result.vertices) +
                ", or there is no room for their values");
  }
  this->Hierarchy.finest->window().readX(first, count, values.data());
  if (this->MeanShifts.empty())
  {
    return;
  }
  constexpr auto Block = static_cast<std::int64_t>(ComponentLabels::Block);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int32_t label =
      this->Labels.block((first + i) / Block)[static_cast<std::size_t>((first + i) % Block)];
    const std::int64_t root = label < 0 ? -1 : this->Parts.root(label);
    for (int k = 0; root >= 0 && k < this->Columns; ++k)
    {
      values[static_cast<std::size_t>(i * this->Columns + k)] -=
        this->MeanShifts[static_cast<std::size_t>(root * this->Columns + k)];
    }
  }
}

template <OperatorSet Operators>
void Engine<Operators>::fillReport(double wallSeconds, double cpuSeconds)
{
  Report& r = this->Result;
  if (r.clamped_weights > 0)
  {
    r.notes.push_back(std::to_string(r.clamped_weights) +
                      " cotangent weights were below the floor and were raised to it: there the "
                      "operator is not that "
                      "of finite elements");
  }
  r.levels = this->Hierarchy.sizes;
  r.levels.front().nodes -= r.prescribed + r.held;
  r.levels.front().nonzeros -= r.prescribed + r.held;
  r.peak_nodes = this->Resident.peak;
  r.pool_bytes_peak = this->Memory.peak();
  r.rss_bytes_peak = peakResidentBytes();
  r.bytes_read = this->Traffic.bytesRead;
  r.bytes_written = this->Traffic.bytesWritten;
  r.seconds.io_wait = 1e-9 * static_cast<double>(this->Traffic.waitNanoseconds);
  r.seconds.total = wallSeconds;
  r.cpu_seconds = cpuSeconds;
  r.threads = this->Threads.max_concurrency();
}

} // namespace smg
