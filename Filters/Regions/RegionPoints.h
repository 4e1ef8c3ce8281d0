// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/MeshInMemory.h"
#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/RegionSettings.h"
#include "Solver/Jobs/Projection/PointProjection.h"

#include <cstdint>
#include <optional>
#include <vector>

class vtkPointSet;
class vtkSelection;

namespace smg
{

/** The positions (x, y, z) of points of the mesh. */
std::vector<double> positionsOf(vtkPointSet& mesh, const std::vector<std::int64_t>& points);

/** The mean edge length of the mesh: see meanEdgeLength() of a block. */
double meanEdgeLength(const MeshInMemory& mesh);

/** The radius of balls that leave no gap around the corners of triangles of that edge length. */
double radiusBetween(const MeshInMemory& mesh);

/**
 * The ids of the points of the mesh, of the kind in the settings. Throws Error if there are none.
 */
std::vector<std::int64_t> idsOf(vtkPointSet& mesh, const PointRegionSettings& settings);

/** The selected points of the mesh. With one process, throws Error if there are none. */
std::vector<std::int64_t> selectPoints(vtkPointSet& mesh, const RegionContext& context);

/** Throws Error, which names the first missing id, if not all ids are found. */
void checkIds(const IdList& ids, const std::vector<char>& isFound);

/** What to do about regions inside of a solid whose surface is shown. */
inline constexpr const char* RemedyOfSurface =
  "PreviewCells of the reader offers tetrahedra, which have points inside";

/** The points whose distance from the mesh exceeds 1 % of its diagonal plus `slack`. */
std::vector<std::int64_t> distantPoints(const PointProjection& projection, double slack);

/** Warns of them; `mesh` is what it is called. */
void warnOfDistant(const PointProjection& projection, double slack, const std::string& mesh,
  const RegionContext& to);

/**
 * The indices of the selected points of the mesh, or of the points of its selected cells, in
 * ascending order, as extracted by vtkExtractSelection. Throws Error if the selection is empty, or
 * is of a kind that VTK alone cannot evaluate (a query).
 */
std::vector<std::int64_t> selectedPoints(vtkPointSet& mesh, vtkSelection& selection);

/**
 * The GlobalIds in the selection, in ascending order; none if the selection has any other content.
 */
std::optional<std::vector<std::int64_t>> selectedGlobalIds(vtkSelection& selection);

/** Whether a node of the selection depends on the indices of points or cells in the data. */
bool isByNumber(vtkSelection& selection);

/** Whether a node of the selection depends on array values. */
bool isByValue(vtkSelection& selection);

} // namespace smg
