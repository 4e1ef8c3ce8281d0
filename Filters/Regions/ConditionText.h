// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace smg
{

/** The type of a condition. */
enum class ConditionKind
{
  Dirichlet,    ///< u = values
  Flux,         ///< (K grad u - q) . n = values, into the body
  Robin,        ///< (K grad u - q) . n = coefficient * (values - u)
  Source,       ///< f = values
  Conductivity, ///< K = values: 1 number, 3 (the diagonal of a tensor) or 6
  Screening,    ///< s = values: 1 number
  Soft          ///< adds coefficient * (u - values) to the equations
};

/** A condition of a problem on a mesh, with the arrays of the mesh that define its region. */
struct Condition
{
  ConditionKind kind = ConditionKind::Dirichlet;
  std::vector<double> values{ 0.0 };
  bool isPosition = false; ///< the values are the coordinates of the vertex instead
  double coefficient = 1.0;
  /** The name of a point or cell array that is not 0 in the region; or ... */
  std::string mask;
  /** ... of a point or cell array that has the value `tag` there; or ... */
  std::string tagged;
  double tag = 0.0;
  /** ... the boundary. None of them: everywhere. */
  bool isOnBoundary = false;

  /** Whether this kind may hold everywhere. */
  bool mayHoldEverywhere() const
  {
    return this->kind == ConditionKind::Source || this->kind == ConditionKind::Conductivity ||
           this->kind == ConditionKind::Screening;
  }

  /** The condition as a problem in the JSON of a problem file. Throws Error if its numbers do not
   * match its kind. */
  std::string text() const;
};

} // namespace smg
