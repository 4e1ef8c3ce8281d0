// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"

#include <string>

namespace smg::testing
{

/** What came out of a case. */
struct CheckedCase
{
  std::string failure; ///< what is wrong; empty: nothing
  bool isRefused = false;
  bool hasConverged = true; ///< a solve may need more V-cycles, but says so
  double error = 0.0;       ///< largest difference to the direct solution, over the largest value
};

/**
 * Solves a case in its way and compares: with the oracle; the bits with those of a solve in core,
 * on one thread, of one block; the bits of a cancelled and continued solve; the gradients and
 * fluxes of the result file with those of its solution.
 */
CheckedCase check(const Case& given);

/** The smallest case that can be found by leaving out cells, entries of the problem and parts of
 * the run, and still fails in some way. */
Case shrink(const Case& failing);

} // namespace smg::testing
