// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** Some cells of a mesh, distributed over its file, and the coordinates of their corners. */
struct CellSample
{
  /** The maximum number of cells of a sample. */
  static constexpr std::int64_t Most = 8192;

  std::size_t corners = 3;                      ///< of a cell
  std::vector<std::uint32_t> vertices;          ///< `corners` per cell
  std::vector<std::array<double, 3>> positions; ///< of each of them

  std::size_t cells() const { return this->vertices.size() / this->corners; }

  /**
   * Places in `vertices` of a sample of the mesh's vertices: a corner of each cell, so that a
   * vertex of many cells is not everywhere, and none twice.
   */
  std::vector<std::size_t> differentVertices() const;
};

/** Selects a random cell from each of CellSample::Most parts of the file. */
CellSample sampleCells(const RawMesh& mesh);

} // namespace smg
