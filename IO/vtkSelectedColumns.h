// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <string>
#include <vector>

class vtkDataArraySelection;

namespace smg
{

/**
 * Adds the columns to a selection, in which they are chosen; those that stand in it stay as they
 * are. The marks of cells that do not count come with every piece, and its own arrays, too: they
 * cannot be selected.
 */
void offerColumns(vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns);

/** The names of the columns that are selected, and of those marks. */
std::vector<std::string> chosenColumns(
  vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns);

} // namespace smg
