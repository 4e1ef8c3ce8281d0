// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/CellParts.h"

#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkTetra.h"
#include "vtkTriangle.h"

#include <array>
#include <cmath>
#include <utility>

namespace smg
{

CellParts::CellParts(vtkPointSet& mesh, const std::filesystem::path& scratch)
  : Mesh(vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance()))
{
  vtkNew<vtkIdList> ids;
  const auto cellAt = [&](std::int64_t cell, std::vector<std::int64_t>& points)
  {
    mesh.GetCellPoints(cell, ids);
    points.assign(ids->begin(), ids->end());
    return mesh.GetCellType(cell);
  };
  const auto pointAt = [&mesh](std::int64_t point)
  {
    std::array<double, 3> position;
    mesh.GetPoint(point, position.data());
    return position;
  };
  VtkCellParts parts = cutVtkCells(mesh.GetNumberOfPoints(), pointAt, mesh.GetNumberOfCells(),
    countingCells(mesh), cellAt, scratch);
  this->Corners = std::move(parts.corners);
  this->CellOf = std::move(parts.cellOf);
  this->CornersOfPart = static_cast<std::size_t>(cornersOf(parts.type));
  this->Mesh->SetPoints(mesh.GetPoints());
  this->Mesh->GetPointData()->ShallowCopy(mesh.GetPointData());
  setCells(*this->Mesh, this->Corners, cornersOf(parts.type));
  copyRows(*mesh.GetCellData(), this->CellOf, *this->Mesh->GetCellData());
}

double CellParts::measure(std::size_t part) const
{
  std::array<std::array<double, 3>, 4> p{};
  for (std::size_t k = 0; k < this->CornersOfPart; ++k)
  {
    this->Mesh->GetPoint(this->Corners[part * this->CornersOfPart + k], p[k].data());
  }
  return this->CornersOfPart == 3
           ? vtkTriangle::TriangleArea(p[0].data(), p[1].data(), p[2].data())
           : std::abs(vtkTetra::ComputeVolume(p[0].data(), p[1].data(), p[2].data(), p[3].data()));
}

void CellParts::average(const std::string& name, vtkPointSet& whole) const
{
  vtkDataArray* ofParts = this->Mesh->GetCellData()->GetArray(name.c_str());
  if (!ofParts)
  {
    return;
  }
  const int components = ofParts->GetNumberOfComponents();
  vtkNew<vtkDoubleArray> mean;
  mean->SetName(name.c_str());
  mean->SetNumberOfComponents(components);
  mean->SetNumberOfTuples(whole.GetNumberOfCells());
  mean->Fill(0.0);
  std::vector<double> measures(static_cast<std::size_t>(whole.GetNumberOfCells()), 0.0);
  for (std::size_t part = 0; part < this->CellOf.size(); ++part)
  {
    const std::int64_t cell = this->CellOf[part];
    const double weight = this->measure(part);
    if (!(weight > 0.0))
    {
      continue; // a flat part has no gradient
    }
    measures[static_cast<std::size_t>(cell)] += weight;
    for (int k = 0; k < components; ++k)
    {
      const double more = weight * ofParts->GetComponent(static_cast<vtkIdType>(part), k);
      mean->SetComponent(cell, k, mean->GetComponent(cell, k) + more);
    }
  }
  for (vtkIdType cell = 0; cell < whole.GetNumberOfCells(); ++cell)
  {
    for (int k = 0; k < components; ++k)
    {
      const double sum = mean->GetComponent(cell, k);
      const double weight = measures[static_cast<std::size_t>(cell)];
      mean->SetComponent(cell, k, weight > 0.0 ? sum / weight : vtkMath::Nan());
    }
  }
  whole.GetCellData()->AddArray(mean);
}

} // namespace smg
