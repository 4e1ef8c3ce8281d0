// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"
#include "Testing/Random/Oracle.h"
#include "smg/Report.h"

#include <Eigen/Core>

#include <string>

namespace smg::testing
{

/** What came out of a case. */
struct CheckedCase
{
  std::string failure; ///< what is wrong; empty: nothing
  bool isRefused = false;
  bool isOutOfMemory = false; ///< refused since the limit of memory is too low
  bool hasConverged = true;   ///< a solve may need more V-cycles, but says so
  bool isApproximate = false; ///< cells too flat for finite elements, which the report says
  double error = 0.0;         ///< largest difference to the oracle, over the largest value
};

/**
 * Runs a case in its way and compares: with the oracle; the bits with those of a run in core, on
 * one thread, of one block; with the answer to a related case; the gradients and fluxes of the
 * result file with those of its solution.
 */
CheckedCase check(const Case& given);

/** Compares the values of a solve with the oracle; `size` is that of numbers that have cancelled.
 */
void compare(const Case& given, const Oracle& oracle, const Eigen::MatrixXd& values,
  const Report& report, CheckedCase& to, double size = 0.0);

/** check() of deform, smooth, distance and blend, without the reasons to refuse. */
void checkDeformation(const Case& given, CheckedCase& to);
void checkSmoothing(const Case& given, CheckedCase& to);
void checkDistance(const Case& given, CheckedCase& to);
void checkBlend(const Case& given, CheckedCase& to);

/** The smallest case that can be found by leaving out cells, entries of the problem and parts of
 * the run, and still fails in some way. */
Case shrink(const Case& failing);

} // namespace smg::testing
