// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/AddedColumns.h"
#include "IO/Arrays/OriginalOrder.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Solve.h"

#include <cstddef>
#include <string>

namespace smg
{

/** The column of this name of the vertices or cells, or what every mesh has: "Position" of the
 * vertices, "Corners" of the cells, which are rows of vertices. Throws ArgumentError if there is
 * none. */
SMG_EXPORT ColumnSpec columnOf(const StreamInfo& mesh, bool ofCells, const std::string& name);

/**
 * Reads a whole column of a mesh in the original order.
 * @param mesh a mesh with a StoredMesh::file()
 * @param order its original order
 * @param added the same mesh if it has added columns, for vertices of no cell; else null
 * @param ofCells of the cells, or of the vertices
 * @param name the column, see columnOf()
 * @param values room for all rows
 * @throws Error if the mesh has no such column or cannot be read; Cancelled
 */
SMG_EXPORT void readColumn(const StoredMesh& mesh, const OriginalOrder& order,
  const AddedColumns* added, bool ofCells, const std::string& name, std::byte* values,
  const ProgressFunction& progress = {});

/**
 * Reads components of a solution as a column of the vertices in the original order.
 * @param solution of `mesh`
 * @param first the number of the first of the components
 * @param column the type that they are rounded to, how many there are, and their value at vertices
 * of no cell (ColumnSpec::isolated; none: what the mesh has there in a column of this name)
 * @param values room for all rows; points that were merged have the values of those with which
 */
SMG_EXPORT void readSolution(const StoredMesh& mesh, const OriginalOrder& order,
  const AddedColumns* added, Solution& solution, int first, const ColumnSpec& column,
  std::byte* values, const ProgressFunction& progress = {});

/** Gives points that were merged with others (OriginalOrder::merged()) the values of these, in a
 * whole column of the vertices that was read. */
SMG_EXPORT void fillMerged(const OriginalOrder& order, const ColumnSpec& column, std::byte* values);

} // namespace smg
