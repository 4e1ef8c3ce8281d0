// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkPointSet;

namespace smg
{

/**
 * A whole VTK mesh in memory as a compact mesh stream: its cells in their order, its points
 * numbered by first use. Points that no cell uses, and cells that are duplicates, are left out.
 */
class MeshInMemory
{
public:
  /**
   * Copies the mesh. Throws Error if it has no cells but duplicates, these are neither all
   * triangles nor all tetrahedra, a cell has a point that does not exist, or a coordinate is not
   * finite.
   */
  explicit MeshInMemory(vtkPointSet& mesh);

  /** Whether a stream of the one is a stream of the other. */
  bool operator==(const MeshInMemory&) const = default;

  CellType cellType() const { return this->Type; }
  /** Of each vertex, in stream order, the number of its point. */
  const std::vector<std::int64_t>& points() const { return this->Points; }
  std::int64_t vertices() const { return static_cast<std::int64_t>(this->Points.size()); }

  /** The mesh stream, with the CellFlags of the mesh. */
  std::unique_ptr<MeshSource> source() const;

private:
  void copyCells(vtkPointSet& mesh);
  void copyFlags(vtkPointSet& mesh, const std::vector<std::int64_t>& cells);
  void numberVertices(std::int64_t points);
  void copyPositions(vtkPointSet& mesh);

  CellType Type = CellType::Triangle;
  bool IsDouble = true;
  std::vector<std::int64_t> Points;
  std::vector<double> Positions;
  std::vector<std::int64_t> Corners;
  std::vector<std::uint8_t> Flags; ///< CellFlags; empty if the mesh has none
};

} // namespace smg
