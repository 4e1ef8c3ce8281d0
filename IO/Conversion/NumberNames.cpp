// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/NumberNames.h"

#include "IO/Files/InQuotes.h"
#include "Solver/Mesh/OriginalNumbers.h"

#include <algorithm>

namespace smg
{

namespace
{

void freeName(
  std::vector<RawColumn>& columns, const std::string& name, std::vector<std::string>& notes)
{
  const auto isNamed = [&columns](const std::string& candidate)
  {
    return std::ranges::any_of(
      columns, [&candidate](const RawColumn& column) { return column.spec.name == candidate; });
  };
  for (RawColumn& column : columns)
  {
    if (column.spec.name == name && column.spec != ColumnSpec{ name, ScalarType::Int64, 1 })
    {
      int number = 1;
      while (isNamed(name + ('_' + std::to_string(number))))
      {
        ++number;
      }
      column.spec.name += '_' + std::to_string(number);
      notes.push_back("The column " + inQuotes(name) + " of the input is called " +
                      inQuotes(column.spec.name) + ", since " + inQuotes(name) +
                      " says the places in the input itself.");
    }
  }
}

} // namespace

void freeNumberNames(RawMesh& mesh, std::vector<std::string>& notes)
{
  freeName(mesh.vertexColumns, OriginalIdName, notes);
  freeName(mesh.elementColumns, OriginalCellIdName, notes);
}

bool isNumbered(const RawMesh& mesh)
{
  const auto has = [](const std::vector<RawColumn>& columns, const ColumnSpec& numbers)
  {
    return std::ranges::any_of(
      columns, [&numbers](const RawColumn& column) { return column.spec == numbers; });
  };
  return has(mesh.vertexColumns, OriginalIdSpec) || has(mesh.elementColumns, OriginalCellIdSpec);
}

} // namespace smg
