// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/MeshInMemory.h"
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"

#include <memory>
#include <optional>
#include <vector>

class vtkPointSet;

namespace smg
{

/** A VTK mesh in memory that is deformed repeatedly by the handles in its point arrays. The
 * hierarchy is kept as long as mesh, options and held points do not change. */
class InteractiveMesh
{
public:
  /**
   * Deforms the mesh. Returns for each of its points columns() numbers: the position and, if
   * `needsNormals` and the cells are triangles, the normal. Points that no cell uses move to their
   * targets if they are held and stay otherwise; they keep their normals, if any. Throws Error and
   * Cancelled.
   */
  std::vector<double> deform(vtkPointSet& mesh, const DeformOptions& options, bool needsNormals);

  /** Adds the cells that the last deformation inverts, and the points of no cell, to a report.
   * Throws Error. */
  void judge(Report& report) const;

  /** Releases the memory of the mesh and the hierarchy. */
  void forget();

  /** Numbers per point of the last deformation. */
  int columns() const { return this->Columns; }
  /** The report of the last deformation, which must have succeeded. */
  const Report& report() const { return this->Deformation->report(); }
  /** The number of hierarchies built. */
  int builds() const { return this->Builds; }

private:
  void update(MeshInMemory mesh, const DeformOptions& options, const VertexHandles& handles);
  std::vector<double> values(vtkPointSet& mesh, const DeformOptions& options);
  void moveLoose(vtkPointSet& mesh, std::vector<double>& values);

  std::optional<MeshInMemory> Mesh;
  DeformOptions Options;
  std::unique_ptr<InteractiveDeformation> Deformation;
  std::int64_t Loose = 0; ///< points of no cell
  int Columns = 3;
  int Builds = 0;
};

/** What InteractiveMesh::deform() returns for a mesh that stays as it is, of 3 numbers a point, or
 * 6 with its normals. */
std::vector<double> valuesAtRest(vtkPointSet& mesh, int columns);

} // namespace smg
