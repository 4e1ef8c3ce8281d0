// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Multigrid/Engine/VertexRange.h"
#include "smg/Solve.h"

#include <optional>

namespace smg
{

/** The result of smoothing: values at the vertices, the memory or files that they are in, and the
 * report. */
class SmoothedValues final : public Solution
{
public:
  SmoothedValues(const SolveOptions& options, int columns)
    : memory(options.memoryLimit)
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

  Pool memory;
  std::optional<ScratchFolder> scratch;
  IoStatistics traffic;
  VertexStorage storage; ///< for further values
  VertexFile values;
  Report total;
};

} // namespace smg
