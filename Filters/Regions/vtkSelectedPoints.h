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
 * The numbers of the selected points of the mesh, or of the points of its selected cells, in
 * ascending order: what vtkExtractSelection makes of the selection. Throws Error if the selection
 * says nothing, or is of a kind that VTK alone cannot evaluate (a query).
 */
std::vector<std::int64_t> selectedPoints(vtkPointSet& mesh, vtkSelection& selection);

/**
 * The GlobalIds of the points of the mesh that the selection names one by one, in ascending order;
 * none if it says in another way, too, what is selected.
 */
std::optional<std::vector<std::int64_t>> selectedGlobalIds(vtkSelection& selection);

/** Whether a part of the selection depends on how points or cells are numbered in the data. */
bool isByNumber(vtkSelection& selection);

/** Whether a part of the selection depends on the values of arrays. */
bool isByValue(vtkSelection& selection);

} // namespace smg
