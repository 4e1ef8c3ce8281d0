// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Mesh/vtkMeshInMemory.h"
#include "Filters/Regions/PointRegionSettings.h"
#include "Filters/Regions/SoughtIds.h"
#include "Filters/Regions/vtkRegionContext.h"
#include "Solver/Projection/PointProjection.h"

#include <cstdint>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Whether this is one of several processes. */
bool hasSeveralProcesses();

/** x, y, z of points of the mesh. */
std::vector<double> positionsOf(vtkPointSet& mesh, const std::vector<std::int64_t>& points);

/** The mean length of the mesh's edges: see meanEdgeLength() of a block. */
double meanEdgeLength(const MeshInMemory& mesh);

/** The ids of the mesh's points, of the kind that is sought. Throws Error if it has none. */
std::vector<std::int64_t> idsOf(vtkPointSet& mesh, const PointRegionSettings& settings);

/** The selected points of the mesh. Throws Error if, with one process, there are none. */
std::vector<std::int64_t> selectPoints(vtkPointSet& mesh, const RegionContext& context);

/** Throws Error, which names the first one that is not, if not all ids are found. */
void checkIds(const SoughtIds& ids, const std::vector<char>& isFound);

/**
 * Warns of points whose distance from the mesh is more than 1 % of its diagonal, and `slack` more.
 */
void warnOfDistant(const PointProjection& projection, double slack, const RegionContext& to);

} // namespace smg
