// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** A column without values for each of the specs, with room for this many tuples. */
inline std::vector<Column> emptyColumns(
  const std::vector<ColumnSpec>& specs, std::size_t tuples = 0)
{
  std::vector<Column> columns;
  for (const ColumnSpec& spec : specs)
  {
    columns.push_back({ spec, {} });
    columns.back().bytes.reserve(spec.tupleBytes() * tuples);
  }
  return columns;
}

inline std::vector<std::string> columnNames(const std::vector<ColumnSpec>& specs)
{
  std::vector<std::string> names;
  for (const ColumnSpec& spec : specs)
  {
    names.push_back(spec.name);
  }
  return names;
}

/** Removes all tuples, but keeps the memory. */
inline void clearTuples(std::vector<Column>& columns)
{
  for (Column& column : columns)
  {
    column.bytes.clear();
  }
}

// Names of columns with a known meaning, from files of any format.

/** What all meshes have beside their columns, where it is asked for as one: x, y, z of the
 * vertices, and the corners of the cells. */
inline const ColumnSpec PositionSpec{ "Position", ScalarType::Float64, 3 };
inline constexpr const char* CornersName = "Corners";

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
/** An integer of cells: the number of the solid in STL files. */
inline constexpr const char* SolidName = "Solid";
/** Any number of components, of vertices or of cells: the attributes in TetGen files. */
inline constexpr const char* AttributeName = "Attribute";
/** An integer, of vertices: the boundary marker in TetGen files. */
inline constexpr const char* MarkerName = "Marker";

/** Field array of a mesh in VTK's data and files: its groups as JSON (IO/Mesh/GroupsJson.h), which
 * give the arrays VertexGroups, FacetGroups and CellGroups a meaning. Views do not list it. */
inline constexpr const char* MeshGroupsName = "MeshGroups";

/** Whether a column holds normals, of any type. */
inline bool isNormals(const ColumnSpec& spec)
{
  return spec.name == NormalsName && spec.components == 3;
}

constexpr bool isReal(ScalarType type)
{
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

/** Whether views of VTK are to shade by a column of vertices: its active normals. */
inline bool isActiveNormals(const ColumnSpec& spec)
{
  return isReal(spec.type) && isNormals(spec);
}

/** Whether they are to map textures by it: the active texture coordinates. */
inline bool isActiveTexture(const ColumnSpec& spec)
{
  return isReal(spec.type) && spec.name == TextureCoordinatesName && spec.components <= 3;
}

/** Point array, uint8: 1 where no later piece uses the point. */
inline constexpr const char* StreamFinalizedName = "StreamFinalized";
/** Point GlobalIds: stream indices. */
inline constexpr const char* GlobalIdsName = "GlobalIds";
/** Point array, uint8, of VTK: DUPLICATEPOINT where an earlier piece owns the point. */
inline constexpr const char* GhostTypeName = "vtkGhostType";

/** Whether an array of this name belongs to the piece contract, not to the mesh. */
constexpr bool isContractArray(std::string_view name)
{
  return name == StreamFinalizedName || name == GlobalIdsName || name == GhostTypeName;
}

/** Whether no attribute of a mesh can have this name: an array of the piece contract, or a table or
 * column of the container itself (VsmFormat.h). */
constexpr bool isReservedColumn(std::string_view name)
{
  constexpr std::array<std::string_view, 3> own{ "Position", "LastCell", "Corners" };
  return isContractArray(name) || std::find(own.begin(), own.end(), name) != own.end();
}

/** The type of the coordinates of a mesh or file. */
constexpr ScalarType positionType(bool doublePositions)
{
  return doublePositions ? ScalarType::Float64 : ScalarType::Float32;
}

/** Makes positions the bytes of a file, in its precision. */
class FilePositions
{
public:
  explicit FilePositions(bool doublePositions)
    : Type(positionType(doublePositions))
  {
  }

  ScalarType type() const { return this->Type; }
  /** Bytes of a position. */
  std::size_t size() const { return 3 * sizeOf(this->Type); }

  /** The bytes of these coordinates, until the next call. */
  std::span<const std::byte> bytes(std::span<const double> coordinates)
  {
    if (this->Type == ScalarType::Float64)
    {
      return std::as_bytes(coordinates);
    }
    this->Singles.assign(coordinates.begin(), coordinates.end());
    return std::as_bytes(std::span(this->Singles));
  }

  /** Appends the coordinates that have these bytes. */
  void append(std::span<const std::byte> bytes, std::vector<double>& coordinates) const
  {
    const auto append = [&]<class T>(T)
    {
      const auto* const values = reinterpret_cast<const T*>(bytes.data());
      coordinates.insert(coordinates.end(), values, values + bytes.size() / sizeof(T));
    };
    this->Type == ScalarType::Float64 ? append(double()) : append(float());
  }

private:
  ScalarType Type;
  std::vector<float> Singles;
};

/** Bytes of a tuple of each of the columns, and `more`. */
inline std::int64_t rowBytes(const std::vector<ColumnSpec>& columns, std::int64_t more = 0)
{
  for (const ColumnSpec& column : columns)
  {
    more += static_cast<std::int64_t>(column.tupleBytes());
  }
  return more;
}

/** Bytes of the coordinates of a vertex. */
inline std::int64_t positionBytes(const StreamInfo& mesh)
{
  return 3 * static_cast<std::int64_t>(sizeOf(positionType(mesh.doublePositions)));
}

/** Bytes of all columns of a mesh. */
inline std::int64_t columnBytes(const StreamInfo& mesh)
{
  return mesh.vertices * rowBytes(mesh.vertexColumns) + mesh.cells * rowBytes(mesh.cellColumns);
}

/**
 * The position of vertex `vertex` in the single precision of `what`, a file or mesh. Throws Error,
 * which names both, if a coordinate is too large for it or not finite.
 */
SMG_EXPORT std::array<float, 3> singlePrecision(
  std::span<const double, 3> position, std::int64_t vertex, const std::string& what);

} // namespace smg
