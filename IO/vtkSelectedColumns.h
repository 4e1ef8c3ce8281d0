// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <string>
#include <vector>

class vtkDataArraySelection;

namespace smg
{

/**
 * Adds the columns to a selection as selected; existing entries do not change. The marks of
 * degenerate and duplicate cells, and the arrays of the piece contract, are part of every piece and
 * cannot be selected.
 */
void offerColumns(vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns);

/** The names of the selected columns, and of those marks. */
std::vector<std::string> chosenColumns(
  vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns);

} // namespace smg
