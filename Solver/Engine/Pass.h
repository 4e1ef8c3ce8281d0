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
#include <vector>

namespace smg
{

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
  Pipeline stages(const Further& further);
  int mostChains() const;
  std::int64_t stepNodes() const
  {
    return Pipeline::stepFor(this->Run.scheduled, this->Run.options.blockNodes);
  }

  SolveRun& Run;
  Hierarchy<Relaxation>& Levels;
};

template <class Relaxation>
void Pass<Relaxation>::operator()(double scale, const Further& further)
{
  this->Levels.runCore();
  this->Levels.startPass(false);
  this->Levels.finest().setHistory(further.history);
  this->setScale(scale / std::sqrt(static_cast<double>(this->Levels.window().nodes())));
  this->stream(further);
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
  const Pipeline stages = this->stages(further);
  std::vector<std::function<void()>> files;
  finest.addReaders(files);
  finest.addWriters(files);
  const std::int64_t nodes = finest.window().nodes();
  const int chains = stages.chains();
  LongestFirst order(chains + static_cast<int>(files.size()));
  const std::int64_t step = this->stepNodes();
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
Pipeline Pass<Relaxation>::stages(const Further& further)
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
  stages.cut(std::min(Pipeline::chainsFor(this->Run.scheduled), this->mostChains()));
  return stages;
}

/** The number of chains for which the memory suffices: each takes a step's nodes. In core all nodes
 * are in memory anyway. */
template <class Relaxation>
int Pass<Relaxation>::mostChains() const
{
  constexpr int Unlimited = 1 << 20;
  constexpr std::int64_t NodeBytes = 400; // measured, with coarser levels: 220 of surfaces
  if (!this->Run.scratch)
  {
    return Unlimited;
  }
  const Pool& pool = this->Run.pool;
  // With the history of an acceleration, a pass on one thread takes 0.91 (surface of 0.7 million
  // vertices) to 1.0 (177 million) of the memory of the first one.
  const std::int64_t used = std::max(pool.peak() + pool.peak() / 32, this->Run.usedBefore());
  const std::int64_t chains =
    (pool.limit() - used) /
    (NodeBytes * std::min(this->stepNodes(), this->Levels.window().nodes()));
  return static_cast<int>(std::clamp<std::int64_t>(chains, 1, Unlimited));
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
