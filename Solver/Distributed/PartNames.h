// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Mesh/OriginalNumbers.h"
#include "smg/DistributedSolver.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace smg
{

/** The name in messages of vertex `v` of a part: its original number if the part has these. */
inline std::string nameOfVertex(const MeshPart& part, std::int64_t v)
{
  const auto place = static_cast<std::size_t>(v);
  const std::vector<Column>& columns = part.block.vertexColumns;
  return nameOfRow(columns, OriginalIdSpec, part.ids[place] - v, place);
}

} // namespace smg
