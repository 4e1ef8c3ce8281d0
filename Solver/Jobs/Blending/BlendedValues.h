// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The result of a blend: the original values with the memory or file that contains them, their
 * correction, and the report. */
class BlendedValues final : public Solution
{
public:
  BlendedValues(const SolveOptions& options, int columns)
    : memory(options.memoryLimit)
    , scratch(options.inCore ? std::nullopt
                             : std::optional<ScratchFolder>(
                                 std::in_place, options.scratch, options.scratchLimit))
    , originals(this->storage(), columns)
  {
  }

  std::int64_t vertices() const override { return this->originals.vertices(); }
  int columns() const override { return this->originals.lanes(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->correction->read(first, count, values);
    this->Start.resize(static_cast<std::size_t>(count * this->columns()));
    this->originals.read(first, count, this->Start.data());
    for (std::size_t k = 0; k < this->Start.size(); ++k)
    {
      values[k] += this->Start[k];
    }
  }
  const Report& report() const override { return this->total; }

  VertexStorage storage()
  {
    return { this->memory, this->scratch ? &*this->scratch : nullptr, this->traffic };
  }

  Pool memory;
  std::optional<ScratchFolder> scratch;
  IoStatistics traffic;
  VertexFile originals;
  std::unique_ptr<Solution> correction;
  Report total;

private:
  std::vector<double> Start;
};

} // namespace smg
