// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** A mesh with its cells cut into triangles or tetrahedra: the same points and point arrays, each
 * part with the values of its cell. */
class CellParts
{
public:
  /** Throws Error if a cell cannot be cut. `scratch`: folder for scratch files of large meshes. */
  CellParts(vtkPointSet& mesh, const std::filesystem::path& scratch);

  vtkPointSet& mesh() const { return *this->Mesh; }

  /** Adds the cell array `name` of the parts to the whole mesh: the mean over the parts of a cell,
   * weighted with their areas or volumes; not a number without any. */
  void average(const std::string& name, vtkPointSet& whole) const;

private:
  double measure(std::size_t part) const;

  vtkSmartPointer<vtkPointSet> Mesh;
  std::vector<std::int64_t> Corners, CellOf;
  std::size_t CornersOfPart = 3;
};

} // namespace smg
