// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/MeshArrays.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointSet;

namespace smg
{

/**
 * The arrays of a vtkPolyData or vtkUnstructuredGrid, where VTK has them; those whose tuples are
 * not contiguous are copied. Without those of the piece contract, which are those of another mesh,
 * and those of another length, which some filters of VTK leave (the RegionId of the cells of
 * Connectivity). Keeps references to the mesh's arrays, which must outlive it.
 */
class VtkMeshArrays
{
public:
  explicit VtkMeshArrays(vtkPointSet& mesh);

  const MeshArrays& views() const { return this->Views; }

private:
  void addCells(vtkCellArray* cells, int type, vtkDataArray* types);
  void addAttributes(vtkDataSetAttributes& from, std::int64_t tuples, AttributeArrays& to);
  ArrayView viewOf(vtkDataArray& array);

  MeshArrays Views;
  std::vector<vtkSmartPointer<vtkDataArray>> Copies;
};

} // namespace smg
