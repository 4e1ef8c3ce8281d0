// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesh/vtkCoarserPreview.h"

#include "Filters/Mesh/vtkCopiedRows.h"
#include "IO/Preview/CoarserSurface.h"
#include "IO/vtkPieceCells.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <utility>

namespace smg
{

bool CoarserPreview::isPossible(vtkPointSet& preview)
{
  return preview.GetNumberOfCells() > 0 && hasSimplices(preview) &&
         cellTypeOf(preview, "The preview") == CellType::Triangle;
}

CoarserPreview::CoarserPreview(
  vtkPointSet& preview, std::int64_t most, std::span<const std::uint8_t> locked)
{
  const auto count = static_cast<std::size_t>(preview.GetNumberOfPoints());
  std::vector<double> positions(3 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    preview.GetPoint(static_cast<vtkIdType>(i), positions.data() + 3 * i);
  }
  const std::vector<std::uint8_t> free(locked.empty() ? count : 0, 0);
  CoarserSurface surface =
    coarserSurface(positions, cellCorners(preview, CellType::Triangle, "The preview"),
      locked.empty() ? std::span<const std::uint8_t>(free) : locked, most);
  this->Points = std::move(surface.vertices);
  this->Corners = std::move(surface.corners);
}

vtkSmartPointer<vtkPointSet> CoarserPreview::of(vtkPointSet& preview) const
{
  auto mesh = vtkSmartPointer<vtkPointSet>::Take(preview.NewInstance());
  vtkNew<vtkPoints> points;
  points->SetDataType(preview.GetPoints()->GetDataType());
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), preview.GetPoint(this->Points[i]));
  }
  mesh->SetPoints(points);
  setCells(*mesh, this->Corners, cornersOf(CellType::Triangle));
  copyRows(*preview.GetPointData(), this->Points, *mesh->GetPointData());
  mesh->GetFieldData()->ShallowCopy(preview.GetFieldData());
  return mesh;
}

} // namespace smg
