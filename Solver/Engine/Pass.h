// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/RunAll.h"
#include "Solver/Cycle/IterateHistory.h"
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
    /** Called in each step before the downward part, on its thread. */
    std::function<void()> beforeDown;
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
  const std::int64_t nodes = finest.window().nodes();
  const std::int64_t step = this->Run.options.blockNodes;
  const auto down = [&]
  {
    if (further.beforeDown)
    {
      further.beforeDown();
    }
    finest.advanceDown();
  };
  for (std::int64_t begin = 0; begin < nodes; begin += step)
  {
    const std::int64_t last = std::min(nodes, begin + step) - 1;
    finest.load(last);
    if (further.loaded)
    {
      further.loaded();
    }
    // The downward part processes nodes that the upward part has finished a step ago, and nodes are
    // written after the downward part: no node is accessed by two of them.
    finest.showProgress();
    runAll(this->Run.threads, 4,
      [&](int task)
      {
        task == 0   ? finest.pull(last)
        : task == 1 ? down()
        : task == 2 ? finest.readAhead()
                    : finest.write();
      });
    finest.release();
    this->Run.progress.update(static_cast<double>(last) / static_cast<double>(nodes));
  }
  finest.showProgress();
  down();
  finest.settle();
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
