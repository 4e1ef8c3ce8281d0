// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Values/JobRun.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/** Values at the vertices as a solution, with the job that has the memory or scratch files of
 * these, and the report. */
class VertexSolution : public Solution
{
public:
  /** `kind`: of the values, in the report of the traffic. */
  VertexSolution(const SolveOptions& options, int columns, const std::string& kind,
    const PoolUse& use = SolveMemory)
    : job(options, use)
    , storage{ this->job.pool, this->job.scratch ? &*this->job.scratch : nullptr,
      this->job.traffic.add(kind) }
    , values(this->storage, columns)
  {
  }

  std::int64_t vertices() const override { return this->values.vertices(); }
  int columns() const override { return this->values.lanes(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> to) override
  {
    checkVertexRange(
      first, count, to.size() / static_cast<std::size_t>(this->columns()), this->vertices());
    this->values.read(first, count, to.data());
  }
  const Report& report() const override { return this->job.report; }

  JobRun job;
  VertexStorage storage; ///< for further values
  VertexFile values;
};

} // namespace smg
