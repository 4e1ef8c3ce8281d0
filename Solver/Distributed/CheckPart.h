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

// A vertex that several processes have must have the same data on each: they go into the cells of
// each process and into the rows of others, so a difference would make the matrix unsymmetric, or
// the result one that solves no problem. Differences up to 1e-6 of the largest number count as
// rounding. These functions are called on all processes and throw Error.

/** Compares the positions. */
void checkSharedPositions(const SharedVertices& vertices, const MeshPart& part);
/** Compares what the problem prescribes at the vertices of the part. */
void checkSharedConditions(
  const SharedVertices& vertices, const MeshPart& part, const OpenVertices& given);
/** Compares the targets of held vertices. */
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
