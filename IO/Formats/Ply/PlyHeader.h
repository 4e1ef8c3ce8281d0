// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "smg/Column.h"

#include <cstdint>
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
  std::size_t leastBytes(bool ascii) const;
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
};

/** Reads and checks the header. Throws Error naming the line. */
PlyHeader readPlyHeader(InputFile& file);

} // namespace smg
