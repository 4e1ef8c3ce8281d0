// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Hierarchy.h"

#include "Solver/Core/Timer.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

// Which levels are streamed is decided before the first row exists, from upper bounds of the shares
// of C-points. If the hierarchy turns out to end earlier, close() moves the coarsest streamed level
// to memory; if a core level is larger than expected, it only takes more memory. The decision
// depends on the options, the limit of memory and the number of vertices only, not on whether the
// solve is in core, so that both compute the same.

namespace smg
{

void Hierarchy::open(std::int64_t vertices)
{
  this->FirstCore = this->Context.memory.firstCoreLevel(vertices, CoarsestNodes);
  this->addFinestLevel();
  for (int l = 1; l <= this->FirstCore; ++l)
  {
    this->addCoarseLevel(l, l == this->FirstCore);
  }
}

void Hierarchy::addFinestLevel()
{
  this->Storage.finest = std::make_unique<FineLevel>(this->Context.pool, this->Context.resident, 0,
    this->Columns, this->Context.options.sweeps, this->Relaxation);
  this->finest().setEnergy(this->Context.energy ? &*this->Context.energy : nullptr);
  if (this->Context.scratch)
  {
    this->window().useScratch(*this->Context.scratch, this->Context.traffic);
  }
}

void Hierarchy::measureFlow()
{
  this->finest().setFlow(&this->Context.flow.emplace(this->Columns));
}

void Hierarchy::addCoarseLevel(int l, bool core)
{
  auto level = std::make_unique<CoarseLevel>(this->Context.pool, this->Context.resident, l,
    this->Columns, this->Context.options.sweeps, this->Relaxation);
  if (core)
  {
    this->setCore(*level);
  }
  else if (this->Context.scratch)
  {
    level->window().useScratch(*this->Context.scratch, this->Context.traffic);
  }
  if (l == 1)
  {
    level->setFine(&this->finest().cursors());
    this->finest().setCoarse(level.get());
  }
  else
  {
    CoarseLevel& fine = *this->Storage.coarse.back();
    level->setFine(&fine.cursors());
    fine.setCoarse(level.get());
  }
  this->Storage.coarse.push_back(std::move(level));
}

void Hierarchy::setCore(CoarseLevel& level)
{
  level.setCore();
  if (this->Context.checkpoint)
  {
    level.window().keepRows(*this->Context.scratch, this->Context.traffic);
  }
}

void Hierarchy::close(int coarsest)
{
  // The hierarchy is shorter than expected: its coarsest level was streamed.
  if (coarsest < this->FirstCore)
  {
    this->FirstCore = coarsest;
    this->Storage.coarse.resize(static_cast<std::size_t>(coarsest));
    this->Storage.coarse.back()->window().moveToMemory();
    this->setCore(*this->Storage.coarse.back());
  }
  this->factorize();
}

void Hierarchy::factorize()
{
  const Timer factorizing;
  std::vector<CoarseLevel*> core;
  for (std::size_t l = static_cast<std::size_t>(this->FirstCore); l <= this->Storage.coarse.size();
       ++l)
  {
    core.push_back(this->Storage.coarse[l - 1].get());
  }
  this->Core.setLevels(std::move(core), this->window().nodes());
  this->Context.report.seconds.coarse += factorizing.seconds();
}

void Hierarchy::startPass(bool first)
{
  this->finest().startPass(first);
  for (auto& level : this->Storage.coarse)
  {
    level->startPass(first);
  }
}

void Hierarchy::endPass()
{
  if (!this->finest().finished())
  {
    throw Error("a pass ended before all nodes were done: this is a fault of the program");
  }
  this->finest().endPass();
  for (auto& level : this->Storage.coarse)
  {
    level->endPass();
  }
  ++this->Context.report.passes;
}

void Hierarchy::runCore()
{
  const Timer coarse;
  this->Core.run();
  this->Context.report.seconds.coarse += coarse.seconds();
}

void Hierarchy::runSymmetric(double typical)
{
  // The one of the last pass may be gone.
  this->finest().setHistory(nullptr);
  // Twice, since prolongation divides by the scale before the present one.
  this->finest().setScale(scaleFor(typical));
  this->finest().setScale(scaleFor(typical));
  this->Core.symmetric(this->finest());
}

/** For the first V-cycle of a further problem in core, which restricts onto them. */
void Hierarchy::zeroCoarse()
{
  for (auto& level : this->Storage.coarse)
  {
    level->window().zeroB(0, level->window().nodes());
  }
}

void Hierarchy::renew(int columns)
{
  // Only the finest level has two states in that pass: on coarse levels the downward part starts
  // from zero in any case.
  this->window().renew(columns, true);
  for (auto& level : this->Storage.coarse)
  {
    level->window().renew(columns, false);
  }
}

void Hierarchy::abandon()
{
  this->window().abandon();
  for (auto& level : this->Storage.coarse)
  {
    level->window().abandon();
  }
}

void Hierarchy::save(StateWriter& state)
{
  state.part("hierarchy");
  const auto levels = static_cast<std::int32_t>(this->Storage.coarse.size());
  const bool measuresFlow = this->Context.flow.has_value();
  state(levels, this->FirstCore, this->SlowestAtSlivers, *this->Storage.finest, measuresFlow);
  if (measuresFlow)
  {
    state(*this->Context.flow);
  }
  for (auto& level : this->Storage.coarse)
  {
    state(*level);
  }
}

void Hierarchy::load(StateReader& state)
{
  // A check of the file, far beyond any hierarchy.
  constexpr std::int32_t MaxLevels = 64;
  state.part("hierarchy");
  std::int32_t levels = 0;
  state(levels, this->FirstCore, this->SlowestAtSlivers);
  state.require(this->FirstCore >= 1 && this->FirstCore <= levels && levels <= MaxLevels);
  this->addFinestLevel();
  bool measuresFlow = false;
  state(this->finest(), measuresFlow);
  if (measuresFlow)
  {
    this->measureFlow();
    state(*this->Context.flow);
  }
  const std::int64_t vertices = this->Context.report.vertices;
  // The report comes first in a state; it has the finest level and at most these, see
  // noteWindows().
  const auto reported = static_cast<std::int64_t>(this->Context.report.levels.size());
  state.require(reported >= 1 && reported <= levels + 1);
  state.require(this->window().nodes() == vertices && this->Context.labels.vertices() == vertices);
  for (int l = 1; l <= levels; ++l)
  {
    this->addCoarseLevel(l, l >= this->FirstCore);
    state(*this->Storage.coarse.back());
  }
  // The factor is not in the checkpoint: it is made again, with the same bits.
  this->factorize();
}

void Hierarchy::noteWindows()
{
  // The window of the mesh has prescribed vertices, too, which the report does not count as nodes.
  const auto note = [](Report::Level& level, auto& window)
  { level.window = std::min(level.nodes, window.x().capacity()); };
  std::vector<Report::Level>& levels = this->Context.report.levels;
  note(levels.front(), this->window());
  for (std::size_t l = 1; l < levels.size(); ++l)
  {
    note(levels[l], this->Storage.coarse[l - 1]->window());
  }
}

double Hierarchy::residualNorm() const
{
  return std::sqrt(this->Context.scales.sum(this->Storage.finest->squares()));
}

double Hierarchy::roundingNorm() const
{
  return roundingOf(this->Context.scales.sum(this->Storage.finest->termSquares()));
}

LevelWindow<double> Hierarchy::takeWindow()
{
  this->Core = {};
  this->Storage.coarse.clear();
  this->window().keepSolution();
  LevelWindow<double> window = std::move(this->window());
  this->Storage.finest.reset();
  return window;
}

} // namespace smg
