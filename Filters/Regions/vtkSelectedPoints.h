// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

class vtkPointSet;
class vtkSelection;

namespace smg
{

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
