// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace smg
{

/** Values at the vertices as a solution, with the memory or scratch files that have them, and the
 * report. */
class VertexSolution : public Solution
{
public:
  VertexSolution(const SolveOptions& options, int columns, const PoolUse& use = SolveMemory)
    : memory(options.memoryLimit, use)
    , scratch(options.inCore ? std::nullopt
                             : std::optional<ScratchFolder>(
                                 std::in_place, options.scratch, options.scratchLimit))
    , storage{ this->memory, this->scratch ? &*this->scratch : nullptr, this->traffic }
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
  const Report& report() const override { return this->total; }

  /** Adds to the report what the computation has cost; `kind` is that of the values on scratch
   * files. */
  void finishReport(const char* kind)
  {
    Report& r = this->total;
    r.bytes_by_kind.push_back({ kind, -1, this->traffic.bytesRead, this->traffic.bytesWritten });
    r.bytes_read += this->traffic.bytesRead;
    r.bytes_written += this->traffic.bytesWritten;
    r.pool_bytes_peak = std::max(r.pool_bytes_peak, this->memory.peak());
    r.rss_bytes_peak = peakResidentBytes();
    r.scratch_bytes_peak = this->scratch ? this->scratch->account().peak() : 0;
    r.seconds.total = this->Wall.seconds();
    r.cpu_seconds = processSeconds() - this->CpuAtStart;
  }

  Pool memory;
  std::optional<ScratchFolder> scratch;
  IoStatistics traffic;
  VertexStorage storage; ///< for further values
  VertexFile values;
  Report total;

private:
  Timer Wall;
  double CpuAtStart = processSeconds();
};

} // namespace smg
