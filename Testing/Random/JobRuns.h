// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Check.h"
#include "Testing/Random/Doors.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace smg::testing
{

/** The result of a job as told, which has the bits of the plain run. */
inline Result sameAsPlain(
  const Case& given, const std::function<Result(const CaseRun&)>& run, CheckedCase& to)
{
  const Result expected = run(plain(given.run));
  Result found = run(given.run);
  if (!sameBits(found.values, expected.values))
  {
    to.failure = "does not have the bits of the plain run";
  }
  to.hasConverged = found.report.converged;
  return found;
}

template <class Options>
Options optionsOf(const CaseRun& run, const TemporaryFolder& folder)
{
  Options options;
  setOptions(run, options);
  options.scratch = folder.path();
  return options;
}

/** Numbers as rows of so many columns. */
inline Eigen::MatrixXd rowsOf(const std::vector<double>& values, int columns)
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), std::ssize(values) / columns, columns);
}

} // namespace smg::testing
