// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/RunAll.h"
#include "Solver/Cycle/IterateHistory.h"
#include "Solver/Cycle/Pipeline.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/SolveRun.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <functional>

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
  std::int64_t stepNodes(int chains) const;

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
  const std::int64_t nodes = finest.window().nodes();
  const int chains = stages.chains();
  const std::int64_t step = this->stepNodes(chains);
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
    runAll(this->Run.threads, chains + 2,
      [&](int task) {
        task < chains ? stages.advance(task) : task == chains ? finest.readAhead() : finest.write();
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

/** The stages of the pass, in twice as many chains as there are threads: they are of unequal
 * length. */
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
  const int threads = this->Run.scheduled;
  stages.cut(threads == 1 ? 1 : 2 * threads);
  return stages;
}

/** The nodes by which a pass advances at once. A chain is as many nodes behind the one before it,
 * so that more chains take shorter steps, down to one block of rows. */
template <class Relaxation>
std::int64_t Pass<Relaxation>::stepNodes(int chains) const
{
  const std::int64_t nodes = this->Run.options.blockNodes;
  return std::min(nodes, std::max(RowBlock::Nodes, 2 * nodes / std::max(2, chains)));
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
