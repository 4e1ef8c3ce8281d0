// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>

namespace smg::testing
{

/** A case whose solution follows from that of another one, without an oracle. */
struct Related
{
  Case other;
  /** The solution of the given case from that of the other one. */
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> back;
  bool isExact = false; ///< to the last bit or two
  double size = 0.0;    ///< of the values of the other case, which cancel on the way back
};

/**
 * The case of a relation; none if it does not apply.
 * - linear: all data times -2 give the solution times -2;
 * - scaled: another unit of length, a power of two, gives the same solution;
 * - shifted: prescribed, ambient and initial values plus a constant (without screening);
 * - permuted: other numbers of vertices and cells (without repeated cells);
 * - turned: by a third of a turn about x = y = z.
 */
std::optional<Related> related(const Case& given, const std::string& relation);

} // namespace smg::testing
