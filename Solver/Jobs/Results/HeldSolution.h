// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Solve.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** Values in memory as a solution. */
class HeldSolution final : public Solution
{
public:
  /** `columns` values of each vertex, which another object owns. */
  HeldSolution(std::span<const double> values, int columns)
    : Values(values)
    , Columns(columns)
  {
  }

  std::int64_t vertices() const override
  {
    return static_cast<std::int64_t>(this->Values.size()) / this->Columns;
  }
  int columns() const override { return this->Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    std::ranges::copy(this->Values.subspan(static_cast<std::size_t>(first * this->Columns),
                        static_cast<std::size_t>(count * this->Columns)),
      values.begin());
  }
  const Report& report() const override { return this->Nothing; }

private:
  std::span<const double> Values;
  int Columns;
  Report Nothing;
};

} // namespace smg
