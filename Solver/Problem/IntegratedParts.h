// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Groups.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace smg
{

/** The parts of a mesh over which a solution is integrated: the whole, or groups of cells, which
 * may have cells in common. */
struct SMG_EXPORT IntegratedParts
{
  /** Is called with a place in the description and a sentence. Does not return. */
  using Fail = std::function<void(const std::string& key, const std::string& sentence)>;

  IntegratedParts() = default;
  /** The groups of cells that are called so, each once; "*" is the whole and all of them. Fails if
   * no group of cells is called so. */
  IntegratedParts(
    const std::vector<std::string>& wanted, const MeshGroups& groups, const Fail& fail);

  std::vector<std::string> names; ///< of the parts, in the report
  /** For each set of groups, the numbers of the parts that a cell with it is in; empty: no parts.
   */
  std::vector<std::vector<std::uint32_t>> ofSet;
};

} // namespace smg
