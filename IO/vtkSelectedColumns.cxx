// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkSelectedColumns.h"

#include "IO/Mesh/ReservedNames.h"
#include "smg/MeshSource.h"

#include "vtkDataArraySelection.h"

namespace smg
{

namespace
{

bool isSelectable(const ColumnSpec& column)
{
  return column.name != CellFlagsName && !isContractArray(column.name);
}

} // namespace

void offerColumns(vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns)
{
  for (const ColumnSpec& column : columns)
  {
    if (isSelectable(column) && !selection.ArrayExists(column.name.c_str()))
    {
      selection.AddArray(column.name.c_str());
    }
  }
}

std::vector<std::string> chosenColumns(
  vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns)
{
  std::vector<std::string> names;
  for (const ColumnSpec& column : columns)
  {
    if (column.name == CellFlagsName ||
        (isSelectable(column) && selection.ArrayIsEnabled(column.name.c_str())))
    {
      names.push_back(column.name);
    }
  }
  return names;
}

} // namespace smg
