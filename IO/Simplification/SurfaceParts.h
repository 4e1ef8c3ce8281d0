// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfacePart.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace smg
{

/** Consecutive triangles of a stream. */
struct StreamPart
{
  SurfacePart surface;
  /** Earlier parts may have the vertices below `begin`, later ones those from `end` on, which may
   * be less. */
  std::int64_t begin = 0, end = 0;
  std::int64_t endVertex = 0; ///< the number of vertices that were read

  bool isInside(std::size_t vertex) const
  {
    const std::int64_t id = this->surface.ids[vertex];
    return id >= this->begin && id < this->end;
  }
};

/**
 * Cuts a stream of triangles into parts, with the columns of their vertices. Cells that repeat a
 * corner, and duplicates (see CellFlag), are left out. The memory is that of a part and of the open
 * vertices of the stream, which `pool` accounts for.
 */
class SurfaceParts
{
public:
  /** A part has at least so many triangles, the last one fewer, in whole blocks. `progress`
   * receives the share of the vertices that was read, if their number is known, and may throw. */
  SurfaceParts(
    MeshSource& source, Pool& pool, std::size_t triangles, std::function<void(double)> progress);

  /** Replaces `part` by the next one; returns whether there is one. */
  bool next(StreamPart& part);

  /** The number of cells that were read. */
  std::int64_t cells() const { return this->Cells; }
  /** The number of vertices that were read. */
  std::int64_t vertices() const { return this->Vertices; }

private:
  void add(const MeshBlock& block);
  void localise(SurfacePart& surface);

  MeshSource& Source;
  std::size_t Least;
  std::function<void(double)> Progress;
  std::size_t RowBytes = 0;
  OpenValues<double> Points;
  OpenValues<std::byte> Rows;
  MeshBlock Block;
  std::array<double, 3> Origin{}; ///< the first vertex
  std::vector<std::int64_t> Corners;
  std::int64_t Released = 0; ///< the first open vertex
  std::int64_t Final = 0;    ///< vertices below are not in later cells
  std::int64_t Vertices = 0, Cells = 0;
  bool IsAtEnd = false;
};

} // namespace smg
