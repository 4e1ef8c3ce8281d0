// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

// What is the same for the arrays of points and cells in files of VTK and in its memory.

/** The maximum number of stored names of arrays for notes. */
inline constexpr std::size_t MaxOtherArrays = 20;

/** The names of the arrays of the points, or of the cells. */
class VtkArrayNames
{
public:
  bool contains(const std::string& name) const { return this->Taken.contains(name); }

  /** Gives the next array a name of its own, NAME_1 or more, if another one has its name, which is
   * then added to `repeated`. */
  template <class Array>
  void nameApart(Array& array, std::set<std::string>& repeated)
  {
    if (this->Taken.insert(array.name).second)
    {
      return;
    }
    if (repeated.size() < MaxOtherArrays)
    {
      repeated.insert(array.name);
    }
    int& number = this->Numbers[array.name];
    const std::string name = array.name + '_';
    do
    {
      array.name = name + std::to_string(++number);
    } while (!this->Taken.insert(array.name).second);
  }

private:
  std::set<std::string> Taken;
  std::map<std::string, int> Numbers; ///< the last one given for a name
};

/** The name of the column of one of `arrays`: the usual one for the arrays `normals` and `texture`,
 * unless another array has it. */
template <class Array>
std::string columnName(const std::string& name, int components, const std::vector<Array>& arrays,
  const std::string& normals, const std::string& texture = "")
{
  const bool areNormals = name == normals && components == 3;
  const bool isTexture = !texture.empty() && name == texture && components <= 3;
  const std::string usual = areNormals ? NormalsName : isTexture ? TextureCoordinatesName : name;
  const bool isFree = std::ranges::find(arrays, usual, &Array::name) == arrays.end();
  return isFree ? usual : name;
}

/** The names of arrays of cells whose integers are labels: those of this library, and of others
 * that write cells of several dimensions into one file. The first one counts. */
inline constexpr std::array<std::string_view, 12> VtkLabelNames{ PhysicalTagName, ReferenceName,
  "gmsh:physical", "medit:ref", "netgen:index", "nastran:ref", "tetgen:ref", "su2:tag",
  "avsucd:material", "cell_tags", "CellEntityIds", "material_id" };

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

/** Adds the name of an array of the field data to those to be noted, unless nobody misses it: the
 * time and number of a step, and what the filters of this library leave there. */
inline void addFieldName(std::set<std::string>& names, const std::string& name)
{
  static constexpr std::string_view Unmissed[] = { "", "TimeValue", "TIME", "CYCLE", "Report",
    "Preview", "PreviewOfReader", "FullNumberOfPoints", "FullNumberOfCells", "Failed",
    "MeshRegions", "MeshConditions", "MeshConditionArrays", MeshGroupsName };
  if (names.size() < MaxOtherArrays && std::ranges::find(Unmissed, name) == std::end(Unmissed))
  {
    names.insert(name);
  }
}

/** Notes which arrays of the field data are left out. */
void noteFields(RawMeshBuilder& builder, const std::set<std::string>& names);

/** Notes how many cells are left out as ghosts, if any. */
void noteGhosts(RawMeshBuilder& builder, std::int64_t ghosts);

} // namespace smg
