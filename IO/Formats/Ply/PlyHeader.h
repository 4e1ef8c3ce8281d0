// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "smg/Column.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The name of a type in a PLY file; PLY has no 64-bit integers. */
constexpr std::string_view plyTypeName(ScalarType type)
{
  constexpr std::string_view names[] = { "char", "uchar", "short", "ushort", "int", "uint", "", "",
    "float", "double" };
  return names[static_cast<int>(type)];
}

/** A property of a PLY element: a number, or a list with its length before it. */
struct PlyProperty
{
  std::string name;
  ScalarType type = ScalarType::Float32;
  bool list = false;
  ScalarType lengthType = ScalarType::UInt8; ///< of a list
};

/** An element of a PLY file: a number of records with these properties. */
struct PlyElement
{
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /** The minimum bytes of a record. */
  std::size_t minBytes(bool ascii) const;
};

enum class PlyEncoding
{
  Ascii,
  LittleEndian,
  BigEndian
};

/** The header of a PLY file: the content of the body, in its order. */
struct PlyHeader
{
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  /** The beginnings of unknown lines: at most ten different ones, 80 bytes of each. */
  std::vector<std::string> unknown;
  std::size_t bodyOffset = 0;
  std::int64_t bodyLine = 1;

  std::int64_t vertices() const
  {
    const auto vertex = std::ranges::find(this->elements, "vertex", &PlyElement::name);
    return vertex == this->elements.end() ? 0 : vertex->count;
  }
};

/** Reads and checks the header. Throws Error naming the line. */
PlyHeader readPlyHeader(InputFile& file);

/** The operation for the next property of a record, or the next ones. */
struct PlyStep
{
  enum Kind
  {
    Skip,       ///< skips `count` numbers
    Coordinate, ///< a coordinate, along axis `place`
    Attribute,  ///< goes to byte `place` of the record's attributes
    SkipList,   ///< skips a list
    Corners     ///< the list of a cell's vertices
  };
  Kind kind = Skip;
  ScalarType type = ScalarType::Float32;
  ScalarType lengthType = ScalarType::UInt8; ///< of a list
  std::size_t place = 0;
  std::int64_t count = 1;
};

/** The bytes of a tuple of a column in the attributes of a record. */
struct PlyTuple
{
  int column = 0;
  std::size_t begin = 0;
  std::size_t bytes = 0;
};

/** How the records of an element are read. */
struct PlyPlan
{
  std::vector<PlyStep> steps;
  std::vector<PlyTuple> tuples;
  std::size_t attributeBytes = 0;
};

/** The kind of the records of an element. */
enum class PlyRole
{
  Vertices,
  Cells,
  Others
};

/**
 * Compiles the properties of an element. Attributes become columns: nx ny nz are `Normals`,
 * texture_u texture_v `TextureCoordinates`, red green blue (alpha) `Colors`. `addColumn` returns
 * the number of a column, or -1 to omit it; without it there are none.
 */
PlyPlan planOf(const PlyElement& element, PlyRole role,
  const std::function<int(const ColumnSpec&)>& addColumn = {});

/** What a mesh has no place for: lists other than corners, and elements other than vertices, faces
 * and strips, as a note calls them. */
std::vector<std::string> leftOutOf(const PlyHeader& header);

/** The property of this name that is a number; null if there is none. */
const PlyProperty* findNumber(const PlyElement& element, std::string_view name);

} // namespace smg
