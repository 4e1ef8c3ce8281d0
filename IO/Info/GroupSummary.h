// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "smg/Describe.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <vector>

namespace smg
{

/** How large the groups of a mesh are: counts and measures by sets, since an entity may be in
 * several groups. In a stream with the columns of groups. */
class GroupSummary
{
public:
  explicit GroupSummary(const StreamInfo& info);

  /** Adds a block, whose positions `points` has. */
  void add(const MeshBlock& block, const MeshMeasures& points);
  std::vector<MeshDescription::Group> result() const;

private:
  struct Size
  {
    std::int64_t count = 0;
    double measure = 0.0;
  };

  void addCells(const MeshBlock& block, const MeshMeasures& points);

  const StreamInfo& Info;
  std::array<std::vector<Size>, 3> Sets; ///< by GroupOf
};

} // namespace smg
