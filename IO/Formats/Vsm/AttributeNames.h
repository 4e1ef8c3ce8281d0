// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

namespace smg
{

// Names of columns whose meaning is known, whatever file they come from.

/** Three components: normals, of vertices or of cells. */
inline constexpr const char* NormalsName = "Normals";
/** Three or four components: red, green, blue and alpha; bytes, or numbers from 0 to 1. */
inline constexpr const char* ColorsName = "Colors";
/** Two components, of vertices. */
inline constexpr const char* TextureCoordinatesName = "TextureCoordinates";
/** An integer, of vertices or of cells: the label that Medit files have. */
inline constexpr const char* ReferenceName = "Reference";
/** Integers of cells: the physical group and the entity of the geometry that Gmsh files have. */
inline constexpr const char* PhysicalTagName = "PhysicalTag";
inline constexpr const char* GeometricalTagName = "GeometricalTag";
/** Any number of components, of vertices or of cells: what TetGen files have. */
inline constexpr const char* AttributeName = "Attribute";
/** An integer, of vertices: the boundary marker that TetGen files have. */
inline constexpr const char* MarkerName = "Marker";

/** Whether a column holds normals, in whatever type. */
inline bool isNormals(const ColumnSpec& spec)
{
  return spec.name == NormalsName && spec.components == 3;
}

} // namespace smg
