// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkPointSet;

namespace smg
{

/** A whole VTK mesh in memory as a compact mesh stream: its cells in their order, its points
 * numbered by first use, without points that no cell uses and without duplicate cells. */
class MeshInMemory
{
public:
  /**
   * Copies the mesh. Throws Error if it has no cells except duplicates, if these are neither all
   * triangles nor all tetrahedra, if a cell has a point that does not exist, or if a coordinate is
   * not finite.
   */
  explicit MeshInMemory(vtkPointSet& mesh);

  /** Whether both have the same stream. */
  bool operator==(const MeshInMemory&) const = default;

  CellType cellType() const { return this->Type; }
  /** The point index of each vertex, in stream order. */
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
