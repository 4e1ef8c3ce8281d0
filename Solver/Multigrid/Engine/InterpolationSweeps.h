// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/LevelCoarsening.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

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
          data.mayEnd(i);
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
