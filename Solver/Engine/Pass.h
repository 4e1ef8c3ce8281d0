// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/IterateHistory.h"
#include "Solver/Cycle/Pipeline.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/SolveRun.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace smg
{

/** The bytes of the pool that a pass out of core needs on one thread, given those of the first pass
 * and the sparseness of its history, if any: measured up to 0.86 as many without, 1.09 with steps
 * alone (sparseness 0; small meshes), 1.02 with a sample of the residuals (surface of 177 million
 * vertices), 1.22 (dragon) to 1.3 (torus of 50 thousand) with all of them. */
inline std::int64_t passBytes(std::int64_t firstPassPeak, std::optional<std::int64_t> sparseness)
{
  const std::int64_t history = !sparseness        ? 0
                               : *sparseness == 0 ? firstPassPeak / 16
                                                  : firstPassPeak * 2 / 7 / *sparseness;
  return firstPassPeak + firstPassPeak / 16 + history;
}

/** A pass over the levels that finishes a V-cycle and begins the next one. */
template <class Relaxation>
class Pass
{
public:
  /** Optional further actions of a pass. */
  struct Further
  {
    /** Called after loading the finest level. */
    std::function<void()> loaded;
    /** A stage between the upward and the downward part of the finest level. */
    Pipeline::Advance beforeDown;
    /** Accelerates. */
    IterateHistory* history = nullptr;
  };

  Pass(SolveRun& run, Hierarchy<Relaxation>& hierarchy)
    : Run(run)
    , Levels(hierarchy)
  {
  }

  /** Performs a pass, after the part of the core levels; `scale` is the approximate size of its
   * residuals. */
  void operator()(double scale, const Further& further = {});

  /** In core: begins the first V-cycle of a problem whose right-hand side and initial values are in
   * the finest window. */
  void begin();

private:
  void setScale(double typical);
  void stream(const Further& further);
  Pipeline stages(const Further& further, int chains);
  struct Schedule
  {
    std::int64_t step; ///< nodes of the finest level
    int chains;
  };
  Schedule schedule(const IterateHistory* history) const;
  std::int64_t chainsFor(std::int64_t step, std::optional<std::int64_t> sparseness) const;

  SolveRun& Run;
  Hierarchy<Relaxation>& Levels;
};

template <class Relaxation>
void Pass<Relaxation>::operator()(double scale, const Further& further)
{
  try
  {
    this->Levels.runCore();
    this->Levels.startPass(false);
    this->Levels.finest().setHistory(further.history);
    this->setScale(scale / std::sqrt(static_cast<double>(this->Levels.window().nodes())));
    this->stream(further);
  }
  catch (const MemoryLimitError& error)
  {
    throw this->Run.explained(error);
  }
  this->Levels.endPass();
}

/** Restriction scales numbers of this size to about 1. */
template <class Relaxation>
void Pass<Relaxation>::setScale(double typical)
{
  this->Levels.finest().setScale(
    typical > DBL_MIN && typical < DBL_MAX ? std::exp2(-std::ilogb(typical)) : 1.0);
}

template <class Relaxation>
void Pass<Relaxation>::stream(const Further& further)
{
  auto& finest = this->Levels.finest();
  const Schedule schedule = this->schedule(further.history);
  const std::int64_t step = schedule.step;
  const Pipeline stages = this->stages(further, schedule.chains);
  std::vector<std::function<void()>> files;
  finest.addReaders(files);
  finest.addWriters(files);
  const std::int64_t nodes = finest.window().nodes();
  const int chains = stages.chains();
  LongestFirst order(chains + static_cast<int>(files.size()));
  for (std::int64_t begin = 0; begin < nodes; begin += step)
  {
    const std::int64_t last = std::min(nodes, begin + step) - 1;
    finest.load(last);
    if (further.loaded)
    {
      further.loaded();
    }
    // Nodes are written when all stages have finished them a step ago.
    finest.showProgress();
    this->Run.together(order,
      [&](int task)
      {
        if (task < chains)
        {
          stages.advance(task);
        }
        else
        {
          files[static_cast<std::size_t>(task - chains)]();
        }
      });
    finest.release();
    this->Run.progress.update(static_cast<double>(last) / static_cast<double>(nodes));
  }
  // The upward part is finished before the downward part can be.
  stages.advance();
  finest.showProgress();
  stages.advance();
  finest.settle();
}

/** The stages of the pass, in chains. */
template <class Relaxation>
Pipeline Pass<Relaxation>::stages(const Further& further, int chains)
{
  Pipeline stages;
  this->Levels.finest().addUpward(stages);
  if (further.beforeDown)
  {
    stages.add(static_cast<double>(this->Levels.window().nodes()), further.beforeDown);
  }
  this->Levels.finest().addDownward(stages);
  if (StepRecorder* recorder = this->Run.recorder)
  {
    recorder->startPass(stages.costs());
    stages.cutAll();
    return stages;
  }
  stages.cut(chains);
  return stages;
}

/** The length of the steps and the number of chains that the threads need, as far as the memory
 * suffices. */
template <class Relaxation>
auto Pass<Relaxation>::schedule(const IterateHistory* history) const -> Schedule
{
  const std::int64_t usual = this->Run.options.blockNodes;
  const std::int64_t wanted = Pipeline::chainsFor(this->Run.scheduled);
  const std::int64_t longer = Pipeline::stepFor(this->Run.scheduled, usual);
  const std::optional<std::int64_t> sparseness =
    history ? std::optional(history->sparseness()) : std::nullopt;
  const std::int64_t step = this->chainsFor(longer, sparseness) < wanted ? usual : longer;
  const std::int64_t chains = this->chainsFor(step, sparseness);
  return { step, static_cast<int>(std::clamp(chains, std::int64_t(1), wanted)) };
}

/** The number of chains for which the memory suffices: each takes a step's nodes. In core all nodes
 * are in memory anyway. */
template <class Relaxation>
std::int64_t Pass<Relaxation>::chainsFor(
  std::int64_t step, std::optional<std::int64_t> sparseness) const
{
  constexpr std::int64_t NodeBytes = 400; // measured, with coarser levels: 220 of surfaces
  if (!this->Run.scratch)
  {
    return std::numeric_limits<std::int64_t>::max();
  }
  const std::int64_t room = this->Run.pool.limit() - passBytes(this->Run.firstPassPeak, sparseness);
  return room / (NodeBytes * std::min(step, this->Levels.window().nodes()));
}

template <class Relaxation>
void Pass<Relaxation>::begin()
{
  this->Levels.zeroCoarse();
  this->Levels.startPass(true);
  auto& finest = this->Levels.finest();
  finest.setScale(1.0);
  finest.advanceDown();
  finest.settle();
  this->Levels.endPass();
}

} // namespace smg
