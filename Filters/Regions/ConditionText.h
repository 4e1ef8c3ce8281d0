// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace smg
{

/** A condition of a problem on a mesh, with the arrays of the mesh that define its region. */
struct Condition
{
  const char* key = "dirichlet"; ///< of its datum in the table ProblemData
  std::vector<double> values{ 0.0 };
  bool isPosition = false; ///< the values are the coordinates of the vertex instead
  double coefficient = 1.0;
  /** The name of a point or cell array that is not 0 in the region; or ... */
  std::string mask;
  /** ... of a point or cell array that has the value `tag` there; or ... */
  std::string tagged;
  double tag = 0.0;
  /** ... the name of a group, see InGroup; or ... */
  std::string group;
  /** ... the boundary. None of them: everywhere. */
  bool isOnBoundary = false;

  /** Whether it may hold everywhere: other than conditions of u or its flux do. */
  bool mayHoldEverywhere() const;

  /** The condition as a problem in the JSON of a problem file. Throws Error if its numbers do not
   * match its datum. */
  std::string text() const;
};

} // namespace smg
