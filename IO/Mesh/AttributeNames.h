// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

namespace smg
{

// Names of columns with a known meaning, from files of any format.

/** Three components: normals, of vertices or of cells. */
inline constexpr const char* NormalsName = "Normals";
/** Three or four components: red, green, blue and alpha; bytes, or numbers from 0 to 1. */
inline constexpr const char* ColorsName = "Colors";
/** Two components, of vertices. */
inline constexpr const char* TextureCoordinatesName = "TextureCoordinates";
/** An integer, of vertices or of cells: the label in Medit files. */
inline constexpr const char* ReferenceName = "Reference";
/** Integers of cells: the physical group and the entity of the geometry in Gmsh files. */
inline constexpr const char* PhysicalTagName = "PhysicalTag";
inline constexpr const char* GeometricalTagName = "GeometricalTag";
/** Any number of components, of vertices or of cells: the attributes in TetGen files. */
inline constexpr const char* AttributeName = "Attribute";
/** An integer, of vertices: the boundary marker in TetGen files. */
inline constexpr const char* MarkerName = "Marker";

/** Whether a column holds normals, of any type. */
inline bool isNormals(const ColumnSpec& spec)
{
  return spec.name == NormalsName && spec.components == 3;
}

} // namespace smg
