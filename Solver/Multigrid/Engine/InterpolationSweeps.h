// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * The nodes that a stage may process in a step of several concurrent stages. The step lasts as long
 * as its longest stage: so a stage that gets many nodes at once distributes them over several
 * steps. While it cannot keep up, it may process more in each step, so that what waits for it
 * remains a small multiple of what it got at once.
 */
class StepLimit
{
public:
  /** Begins a step of usually at most so many nodes, but some in any case. */
  void begin(std::int64_t nodes)
  {
    constexpr std::int64_t Least = 16;
    nodes = std::max(nodes, Least);
    this->Most = this->Reached ? std::max(nodes, this->Most + this->Most / 4) : nodes;
    this->Reached = false;
  }
  std::int64_t nodes() const { return this->Most; }

  /** Calls work(i) for i from `next` on, below `end` and as long as may(i): for as many nodes as
   * the step may have. */
  template <class May, class Work>
  void run(std::int64_t& next, std::int64_t end, May&& may, Work&& work)
  {
    const std::int64_t limit = next + this->Most;
    // Cursors of stages on other threads are in the same cache line: this one is stored once.
    std::int64_t at = next;
    for (end = std::min(end, limit); at < end && may(at); ++at)
    {
      work(at);
    }
    next = at;
    this->Reached = next == limit;
  }

private:
  std::int64_t Most = std::int64_t(1) << 62; // no limit
  bool Reached = false;
};

/** Those of the stages of a coarsening, except for the sweeps. */
struct StepLimits
{
  StepLimit choose, initial, interpolate, productAP, productPtAP;

  /** A few more nodes than the stages get on average, so that they catch up. */
  static std::int64_t more(std::int64_t nodes) { return nodes + nodes / 16; }

  /** Begins a step of so many nodes, which become so many coarse ones. */
  void begin(std::int64_t nodes, std::int64_t coarse)
  {
    this->choose.begin(nodes);
    for (StepLimit* limit : { &this->initial, &this->interpolate, &this->productAP })
    {
      limit->begin(more(nodes));
    }
    this->productPtAP.begin(more(coarse));
  }
};

/** The sweeps over the rows of P, each of which follows the one before it. */
template <OperatorSet Operators>
class InterpolationSweeps
{
public:
  /** `begin`: the first row. */
  InterpolationSweeps(int sweeps, std::int64_t begin)
    : Sweeps(static_cast<std::size_t>(sweeps), Sweep{ begin, begin, {} })
  {
  }

  /** Begins a step in which each sweep usually relaxes so many rows at most. */
  void begin(std::int64_t rows)
  {
    for (Sweep& sweep : this->Sweeps)
    {
      sweep.limit.begin(rows);
    }
  }

  /** Advances on the initial rows below `end`. */
  void advance(Operators& set, CoarseningData& data, std::int64_t end)
  {
    std::int64_t before = end;
    for (Sweep& sweep : this->Sweeps)
    {
      sweep.limit.run(
        sweep.next, end, [&](std::int64_t i) { return data.fine.reach(i) < before; },
        [&](std::int64_t i)
        {
          if (i == data.relaxed.end())
          {
            data.relaxed.extendRaw(i + 1);
            data.relaxed[i].size = RelaxedRow::Pending;
          }
          set.relaxInterpolation(data, i);
        });
      // A patch is relaxed at its last node.
      while (sweep.settled < sweep.next && data.patches.last(sweep.settled) < sweep.next)
      {
        ++sweep.settled;
      }
      before = sweep.settled;
    }
  }

  /** The end of the rows that are final. */
  std::int64_t settled() const { return this->Sweeps.back().settled; }

private:
  /** The next row, and up to where all have been relaxed. */
  struct Sweep
  {
    std::int64_t next, settled;
    StepLimit limit;
  };

  std::vector<Sweep> Sweeps;
};

} // namespace smg
