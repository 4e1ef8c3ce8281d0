// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace smg
{

/** What a condition says of the part of a mesh where it holds. */
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

/** A condition of a problem on a mesh, with the arrays of the mesh that say where it holds. */
struct Condition
{
  ConditionKind kind = ConditionKind::Dirichlet;
  std::vector<double> values{ 0.0 };
  bool isPosition = false; ///< the values are the vertex's own coordinates instead
  double coefficient = 1.0;
  /** Name of a point array that is not 0 where it holds; or ... */
  std::string mask;
  /** ... of an array of points or cells that has the value `tag` there. Both empty: everywhere. */
  std::string tagged;
  double tag = 0.0;

  /** Whether this kind may hold everywhere. */
  bool mayHoldEverywhere() const
  {
    return this->kind == ConditionKind::Source || this->kind == ConditionKind::Conductivity ||
           this->kind == ConditionKind::Screening;
  }

  /** The condition as a problem in the words of a problem file. Throws Error if its numbers are not
   * those that its kind needs. */
  std::string text() const;
};

} // namespace smg
