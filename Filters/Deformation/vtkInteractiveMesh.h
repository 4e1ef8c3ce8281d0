// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Mesh/vtkMeshInMemory.h"
#include "Solver/Deformation/InteractiveDeformation.h"

#include <memory>
#include <optional>
#include <vector>

class vtkPointSet;

namespace smg
{

/**
 * A VTK mesh in memory that is deformed again and again by the handles in its point arrays. The
 * hierarchy is kept as long as mesh, options and held points are the same.
 */
class InteractiveMesh
{
public:
  /**
   * Deforms the mesh. Answers, for each of its points, the position and, if `needsNormals` and the
   * cells are triangles, the normal; columns() numbers. Points that no cell uses go to their
   * targets if they are held, else they stay; they keep the normals they have, if any. Throws Error
   * and Cancelled.
   */
  std::vector<double> deform(vtkPointSet& mesh, const DeformOptions& options, bool needsNormals);

  /** Lets go of the mesh and of the hierarchy, which take memory. */
  void forget();

  /** Numbers a point of the last deformation. */
  int columns() const { return this->Columns; }
  /** Of the last deformation, which succeeded. */
  const Report& report() const { return this->Deformation->report(); }
  /** How many times a hierarchy has been built. */
  int builds() const { return this->Builds; }

private:
  void update(MeshInMemory mesh, const DeformOptions& options, const VertexHandles& handles);
  std::vector<double> values(vtkPointSet& mesh, const DeformOptions& options);
  void moveLoose(vtkPointSet& mesh, std::vector<double>& values) const;

  std::optional<MeshInMemory> Mesh;
  DeformOptions Options;
  std::unique_ptr<InteractiveDeformation> Deformation;
  int Columns = 3;
  int Builds = 0;
};

} // namespace smg
