// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Columns.h"
#include "IO/Simplification/EdgeCollapse.h"
#include "IO/Simplification/SurfaceParts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

// The memory of a StreamSimplifier, in triangles.

namespace smg
{

/** The least number of triangles of a window. */
inline constexpr std::int64_t MinWindow = 20000;
/** The number of parts whose triangles the window holds. */
inline constexpr std::int64_t PartsOfWindow = 3;

/** A window has at least so many triangles for each vertex that is locked or held: otherwise little
 * of it could be simplified. */
inline constexpr std::size_t TrianglesPerLocked = 8;

/** The triangles that a window should have of which so many vertices are locked or held, if it has
 * `window`: never more than all. */
inline std::size_t windowOf(std::size_t window, std::int64_t fixed, const StreamInfo& info)
{
  const auto vertices = static_cast<std::size_t>(fixed);
  const auto all = static_cast<std::size_t>(info.cells > 0 ? info.cells : INT64_MAX);
  return vertices * TrianglesPerLocked <= window
           ? window
           : std::max(window, std::min(vertices * TrianglesPerLocked * 3 / 2, all));
}

/** The bytes that a triangle of a surface with these columns takes while its edges collapse. */
inline std::int64_t bytesOfTriangle(const StreamInfo& info)
{
  const std::int64_t row = rowBytes(info.vertexColumns);
  // Corners, and half a vertex: its number, position, row and its places in tables.
  constexpr auto OfVertex = static_cast<std::int64_t>(8 + 24 + 16 + sizeof(Quadric));
  return CollapseBytes + 12 + (OfVertex + 2 * row) / 2 + 2 * rowBytes(carriedColumns(info));
}

/** The triangles of a part. The window, which has those of PartsOfWindow parts, and as many parts
 * in work have the same share of the memory; the rest is for open vertices. */
inline std::size_t trianglesOfPart(std::int64_t memory, const StreamInfo& info)
{
  constexpr std::int64_t Most = std::int64_t(1) << 29; // the corners of a window have 32 bits
  const auto share = static_cast<std::int64_t>(0.45 * static_cast<double>(memory));
  return static_cast<std::size_t>(
    std::clamp(share / bytesOfTriangle(info), MinWindow, Most) / PartsOfWindow);
}

/** What a simplification in so much memory takes of it for the window and the parts in work, at
 * least for MinWindow triangles or all of the surface. */
inline std::int64_t windowBytes(std::int64_t memory, const StreamInfo& info)
{
  const auto window = PartsOfWindow * static_cast<std::int64_t>(trianglesOfPart(memory, info));
  return 2 * (info.cells > 0 ? std::min(window, info.cells) : window) * bytesOfTriangle(info);
}

/** What a window takes beside windowBytes() if so many vertices are held. */
inline std::int64_t heldBytes(std::int64_t memory, std::int64_t held, const StreamInfo& info)
{
  const std::size_t window = PartsOfWindow * trianglesOfPart(memory, info);
  return static_cast<std::int64_t>(windowOf(window, held, info) - window) * bytesOfTriangle(info);
}

/** What the open vertices of the stream take beside the window, at least. */
inline std::int64_t openBytes(const StreamInfo& info)
{
  return std::max<std::int64_t>(0, info.width) * (24 + rowBytes(info.vertexColumns));
}

} // namespace smg
