// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Fairing/OpenTuples.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The unit normals at the vertices of a triangle mesh stream with other positions: means of the
 * normals of the triangles, weighted with their angles at the vertex. Triangles without area do not
 * count; a vertex without any other, and one that is held, has the normal 0. */
class PointNormals
{
public:
  /** Appends the normals of the vertices to `normals`, as they become final. */
  PointNormals(Pool& pool, const VertexFile& positions, VertexFile& normals)
    : Points(pool, positions)
    , Sums(pool, 4)
    , Normals(normals)
  {
  }

  /** Adds the next block; `held` is 1 at its vertices that are held. */
  void add(const MeshBlock& block, std::span<const std::uint8_t> held);
  /** To be called after the last block. */
  void finish();

private:
  void addCell(const std::int64_t* corners);
  void write(std::int64_t finalized);

  OpenTuples Points;
  Ring<double> Sums; ///< of weighted normals, and whether the vertex is held
  VertexFile& Normals;
  std::vector<double> Units; ///< to write
};

} // namespace smg
