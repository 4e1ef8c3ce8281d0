// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace smg
{

struct MeshBlock;
struct ProblemDescription;

/**
 * Where the iteration begins if the description does not say: at the undeformed mesh if a Dirichlet
 * value is the position; in each column in the middle of the prescribed and ambient numbers if it
 * is farther from 0 than they are from each other; else at 0. The tolerance is a share of the
 * residual of the initial values: that of 0 grows with an offset of the values (temperatures in
 * kelvin), which is no difference that the solution has.
 */
class StartValues
{
public:
  StartValues() = default;
  /** For a description whose numbers have been checked. */
  explicit StartValues(const ProblemDescription& description);

  /** Sets the values of the vertices of the block, which are 0. */
  void set(const MeshBlock& block, std::vector<double>& values) const;

private:
  bool IsPosition = false;
  std::vector<double> Start; ///< of each column
};

} // namespace smg
