// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <filesystem>
#include <span>
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

/** Copies some tuples of all arrays, in this order, to attributes without arrays. */
inline void copyRows(
  vtkDataSetAttributes& from, std::span<const std::int64_t> rows, vtkDataSetAttributes& to)
{
  const auto count = static_cast<vtkIdType>(rows.size());
  to.CopyAllOn();
  to.CopyAllocate(&from, count);
  to.SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    to.CopyData(&from, rows[static_cast<std::size_t>(i)], i);
  }
}

} // namespace smg
