// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/ByteOrder.h"
#include "IO/Mesh/Format.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace smg
{

/** Text or binary; corners with the same coordinates become one vertex. */
void importStl(InputFile& file, RawMeshBuilder& builder);

/** Whether a file begins as STL in text does: "solid", any name, then a facet or the end, in
 * letters of any case, after any comments. */
bool isTextStl(std::string_view start);

/** Bytes of the header of a binary STL file: 80 of any text and the number of triangles. */
inline constexpr std::size_t StlHeaderBytes = 84;
/** Bytes of a triangle: normal and corners, 12 floats, and two bytes of attributes. */
inline constexpr std::size_t StlTriangleBytes = 50;

/** The number of triangles of a binary STL file that begins with `bytes`, at least 84. */
inline std::uint32_t trianglesOfStl(std::string_view bytes)
{
  return numberAt<std::uint32_t>(bytes.data() + StlHeaderBytes - 4, std::endian::little);
}

/** The size of a binary STL file that begins with `bytes`, at least 84. */
inline std::uint64_t stlBytes(std::string_view bytes)
{
  return StlHeaderBytes + std::uint64_t(StlTriangleBytes) * trianglesOfStl(bytes);
}

/** Whether a file of `size` bytes that begins with `bytes` is binary STL; the text "solid" at the
 * beginning is ignored, since many binary files have it. */
inline bool isBinaryStl(std::string_view bytes, std::uint64_t size)
{
  return bytes.size() >= StlHeaderBytes && stlBytes(bytes) == size;
}

} // namespace smg
