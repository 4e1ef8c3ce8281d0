// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "smg/Convert.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Whether cells of VTK's type `type` are points or lines, which have no triangles. */
bool isPointOrLine(int type);

/** The dimension of cells of VTK's type `type`. */
int dimensionOfVtk(int type);

/** As "polyhedron", or "VTK's type 50". */
SMG_EXPORT std::string nameOfVtkType(int type);

/** Whether cells of VTK's type `type` are read; those of an empty cell, 0, are not. */
SMG_EXPORT bool isReadFromVtk(int type);

/** Whether cells of VTK's type `type` are solid, and have tetrahedra. */
SMG_EXPORT bool isSolidOfVtk(int type);

/** About the triangles or tetrahedra of a cell of VTK's type `type` with so many points; of a
 * hexahedron six, though five may do. */
SMG_EXPORT std::int64_t partsOfVtk(int type, std::int64_t points);

/** Passes a cell of VTK's type `type` to the builder, by its corners, without other points. Throws
 * MeshError if the type is not supported, or the cell has too few points for it. */
void takeVtkCell(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder);

/** The triangles or tetrahedra of cells of VTK, as a conversion cuts them. */
struct VtkCellParts
{
  CellType type = CellType::Triangle;
  std::vector<std::int64_t> corners; ///< cornersOf(type) a part
  std::vector<std::int64_t> cellOf;  ///< the cell of each part
};

/** Returns the type of a cell of VTK, and its points. */
using VtkCellAt = std::function<int(std::int64_t cell, std::vector<std::int64_t>& points)>;

using VtkPointAt = std::function<std::array<double, 3>(std::int64_t point)>;

/**
 * Cuts cells in memory into triangles or tetrahedra. Cells of the other kind, points and lines have
 * no parts.
 * @param points number of points
 * @param pointAt their positions
 * @param cells number of cells
 * @param choice which cells are cut
 * @param at the cells
 * @param scratch folder for scratch files; empty: the system's temporary folder
 * @throws Error if a cell is of a type that is not supported, or there are no parts
 */
SMG_EXPORT VtkCellParts cutVtkCells(std::int64_t points, const VtkPointAt& pointAt,
  std::int64_t cells, CellChoice choice, const VtkCellAt& at, const std::filesystem::path& scratch);

} // namespace smg
