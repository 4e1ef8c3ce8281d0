// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "smg/Convert.h"
#include "smg/Groups.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace smg
{

/** A list of cells of VTK's types. */
struct CellArrays
{
  ArrayView corners;              ///< the points of all cells, one after the other
  ArrayView offsets;              ///< where those of each cell begin and, last, where all end
  std::optional<ArrayView> types; ///< VTK's type of each cell
  int type = 0;                   ///< VTK's type of all cells, if there are no `types`

  std::int64_t cells() const { return std::max<std::int64_t>(this->offsets.rows - 1, 0); }
};

/** An array with a tuple per point or cell. */
struct NamedArray
{
  std::string name;
  ArrayView values;
};

/** The arrays of the points or of the cells of a mesh. */
struct AttributeArrays
{
  std::vector<NamedArray> arrays;
  std::string normals;          ///< the name of the array of normals; empty: none
  std::set<std::string> others; ///< names of arrays that are no numbers
};

/** A mesh as VTK has it in memory, which belongs to somebody else: cells of any type. */
struct MeshArrays
{
  ArrayView points;
  std::vector<CellArrays> cells; ///< the lists one after the other
  AttributeArrays ofPoints, ofCells;
  std::optional<ArrayView> ghosts; ///< VTK's ghost types of the cells
  MeshGroups groups = {};          ///< which the columns of their sets refer to
};

} // namespace smg
