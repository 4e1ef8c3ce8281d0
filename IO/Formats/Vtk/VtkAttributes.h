// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace smg
{

// What is the same for the arrays of points and cells in files of VTK and in its memory.

/** The maximum number of stored names of arrays for notes. */
inline constexpr std::size_t MaxOtherArrays = 20;

/** Gives an array that is to come after `arrays` a name of its own, NAME_1 or more, if one of these
 * has its name, which is then added to `repeated`. */
template <class Array>
void nameApart(Array& array, const std::vector<Array>& arrays, std::set<std::string>& repeated)
{
  const auto isTaken = [&arrays](const std::string& name)
  { return std::ranges::find(arrays, name, &Array::name) != arrays.end(); };
  if (!isTaken(array.name))
  {
    return;
  }
  if (repeated.size() < MaxOtherArrays)
  {
    repeated.insert(array.name);
  }
  const std::string name = array.name + '_';
  for (int number = 1; isTaken(array.name); ++number)
  {
    array.name = name + std::to_string(number);
  }
}

/** The name of the column of one of `arrays`: the usual one for the array `normals`, unless another
 * array has it. */
template <class Array>
std::string columnName(const std::string& name, int components, const std::vector<Array>& arrays,
  const std::string& normals)
{
  const bool areNormals = name == normals && components == 3;
  const bool isFree =
    std::ranges::find(arrays, std::string(NormalsName), &Array::name) == arrays.end();
  return areNormals && isFree ? NormalsName : name;
}

/** Whether a cell with these bits of vtkGhostType belongs to the mesh: not those that belong to
 * another piece, are refined elsewhere, or hidden. */
constexpr bool isOwnVtkCell(std::int64_t ghostType)
{
  constexpr std::int64_t Duplicate = 1, Refined = 8, Hidden = 32;
  return (ghostType & (Duplicate | Refined | Hidden)) == 0;
}

/** Notes which arrays of no numbers are left out, and which names several arrays had. */
void noteArrays(RawMeshBuilder& builder, const std::set<std::string>& others,
  const std::set<std::string>& repeated);

/** Notes how many cells are left out as ghosts, if any. */
void noteGhosts(RawMeshBuilder& builder, std::int64_t ghosts);

} // namespace smg
