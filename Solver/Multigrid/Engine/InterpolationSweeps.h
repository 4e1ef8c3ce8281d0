// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/StepLimit.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

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
