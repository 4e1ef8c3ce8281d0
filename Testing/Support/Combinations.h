// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/Sanitized.h"

#include <cstdint>

namespace smg::testing
{

/**
 * Chooses among the combinations that nested loops visit: all of them, or every seventh in a build
 * with sanitizers, which find errors in the paths that a combination takes, not in results. Seven
 * has no divisor in common with the usual numbers of values, so that each value of each loop is
 * still visited.
 */
class Combinations
{
public:
  /** Whether the next combination is to be tested. */
  bool next() { return this->Visited++ % Stride == 0; }

private:
  static constexpr std::int64_t Stride = Sanitized ? 7 : 1;
  std::int64_t Visited = 0;
};

} // namespace smg::testing
