// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Mesh/AddedColumn.h"
#include "smg/Deform.h"
#include "smg/DistributedSolver.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace smg
{

/** Throws Error if the mesh of a part is not valid. */
void checkPart(const MeshPart& part);

// Vertices of several processes must be the same on each: the data of a process go into its cells
// and into the rows of others, so that what differs makes the matrix unsymmetric, or the result
// that of no problem. What rounding makes of them, 1e-6 of the largest number, is the same. Called
// on all processes; throw Error.

/** Compares the positions. */
void checkSharedPositions(const SharedVertices& vertices, const MeshPart& part);
/** Compares what the problem says of the vertices of the part. */
void checkSharedConditions(
  const SharedVertices& vertices, const MeshPart& part, const OpenVertices& given);
/** Compares where held vertices go. */
void checkSharedTargets(
  const SharedVertices& vertices, const MeshPart& part, const VertexHandles& handles);

/** The name in messages of vertex `v` of a part: its original number if the part has these. */
inline std::string nameOfVertex(const MeshPart& part, std::int64_t v)
{
  const auto place = static_cast<std::size_t>(v);
  const std::vector<Column>& columns = part.block.vertexColumns;
  return nameOfRow(columns, OriginalIdSpec, part.ids[place] - v, place);
}

} // namespace smg
