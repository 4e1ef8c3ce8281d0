// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * The number of nodes that a stage may process in a step of several concurrent stages. A step lasts
 * as long as its longest stage, so a stage that gets many nodes at once distributes them over
 * several steps. While it cannot keep up, its limit grows from step to step, so that what waits for
 * it stays a small multiple of what it got at once.
 */
class StepLimit
{
public:
  /** Begins a step of usually at most this number of nodes; a few are permitted in any case. */
  void begin(std::int64_t nodes)
  {
    constexpr std::int64_t Least = 16;
    nodes = std::max(nodes, Least);
    this->Most = this->Reached ? std::max(nodes, this->Most + this->Most / 4) : nodes;
    this->Reached = false;
  }
  std::int64_t nodes() const { return this->Most; }

  /** Calls work(i) for i from `next` on, as long as i is below `end`, may(i) is true, and the
   * step permits it. */
  template <class May, class Work>
  void run(std::int64_t& next, std::int64_t end, May&& may, Work&& work)
  {
    const std::int64_t limit = next + this->Most;
    // Cursors of stages on other threads share the cache line: this one is stored once, not for
    // each node.
    std::int64_t at = next;
    for (end = std::min(end, limit); at < end && may(at); ++at)
    {
      work(at);
    }
    next = at;
    this->Reached = next == limit;
  }

  /** The same for the cursor of a stage. */
  template <class May, class Work>
  void run(Cursor& next, std::int64_t end, May&& may, Work&& work)
  {
    std::int64_t at = next;
    this->run(at, end, may, work);
    next = at;
  }

private:
  std::int64_t Most = std::int64_t(1) << 62; // no limit
  bool Reached = false;
};

/** The limits of the stages of a coarsening, except for the sweeps. */
struct StepLimits
{
  StepLimit choose, initial, interpolate, productAP, productPtAP;

  /** A few more nodes than the stages get on average, so that they catch up. */
  static std::int64_t more(std::int64_t nodes) { return nodes + nodes / 16; }

  /** Begins a step of this number of nodes, which become that number of coarse ones. */
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

/** The sweeps over the rows of P, each one behind the sweep before it. A sweep may relax row i
 * once the sweep before has relaxed all neighbours of i, together with their patches. */
template <OperatorSet Operators>
class InterpolationSweeps
{
public:
  /** `begin`: the first row. */
  InterpolationSweeps(int sweeps, std::int64_t begin)
    : Sweeps(static_cast<std::size_t>(sweeps), Sweep{ begin, begin, {} })
  {
  }

  /** Begins a step in which each sweep usually relaxes at most this number of rows. */
  void begin(std::int64_t rows)
  {
    for (Sweep& sweep : this->Sweeps)
    {
      sweep.limit.begin(rows);
    }
  }

  /** Advances all sweeps on the rows of P0 below `end`. */
  void advance(Operators& set, CoarseningData& data, std::int64_t end)
  {
    std::int64_t before = end;
    for (Sweep& sweep : this->Sweeps)
    {
      sweep.limit.run(
        sweep.next, end, [&](std::int64_t i) { return data.fine.reach(i) < before; },
        [&](std::int64_t i)
        {
          // The first sweep to arrive appends the row, as Pending: neighbours read P0 until it is
          // relaxed, which for a node of a patch is later.
          if (i == data.relaxed.end())
          {
            data.relaxed.extendRaw(i + 1);
            data.relaxed[i].size = RelaxedRow::Pending;
          }
          set.relaxInterpolation(data, i);
        });
      // A patch is relaxed at its last node: rows before it are final only then.
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
  /** The cursor of a sweep: the next row, and the end of the rows that have really been relaxed,
   * which patches hold back. */
  struct Sweep
  {
    std::int64_t next, settled;
    StepLimit limit;
  };

  std::vector<Sweep> Sweeps;
};

} // namespace smg
