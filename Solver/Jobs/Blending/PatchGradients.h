// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Blending/PatchedValues.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The gradients of the original values around the vertices of a mesh stream: of each vertex the sum
 * over its cells that lie in one patch, times their areas or volumes. They are found in one reading
 * of the mesh, kept in a file, and read in later readings.
 */
class PatchGradients
{
public:
  /** `open` accounts for open vertices. */
  PatchGradients(const VertexStorage& storage, Pool& open, CellType type, int columns);

  /** Adds a block, whose vertices `values` has begun with. */
  void add(const MeshBlock& block, const PatchedValues& values);
  /** To be called after the last block. */
  void finish();

  /** Reads the gradients of the vertices of the next block; the first block restarts it. */
  void startBlock(const MeshBlock& block);
  /** Sets the gradients of a cell, x, y, z for each column, to the mean over the cells around its
   * corners, weighted by area or volume; 0 if there is none. */
  void average(std::span<const std::int64_t> corners, std::vector<double>& gradients) const;

private:
  void addCell(std::span<const std::int64_t> corners, const PatchedValues& values);
  void append(std::int64_t end);

  CellType Type;
  std::size_t Columns;
  VertexFile File; ///< of each vertex the size of its cells, and the sum of the gradients
  OpenValues<double> Points, Sums;
  OpenValues<double> Known;               ///< sums that were read again
  std::int64_t Vertices = 0, Written = 0; ///< read, and in the file
  std::int64_t Finalized = 0;             ///< of the previous block that was read again
};

} // namespace smg
