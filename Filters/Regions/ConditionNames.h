// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/ProblemDescription.h"

#include <cstddef>
#include <string>
#include <vector>

namespace smg
{

/** Which entries of a problem come from which Mesh Condition, since a user of panels has not
 * written the list that an error of the solver counts in. */
class ConditionNames
{
public:
  /** The entries that a problem has after the condition `number`, counted from 1, and had not
   * before. */
  void add(int number, const ProblemDescription& before, const ProblemDescription& after);
  /** Entry 0 of each list: of a problem that consists of this condition. */
  static ConditionNames ofAlone(int number);

  /** A sentence with the conditions and their properties instead of entries and keys: "Mesh
   * Condition 2 (Dirichlet): Value: ..." for "problem: dirichlet[1].value: ...". */
  std::string in(std::string sentence) const;

private:
  struct Entry
  {
    std::string key;
    std::size_t index;
    int number;
  };

  std::vector<Entry> Entries;
};

} // namespace smg
