// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/MeshInMemory.h"

#include "Filters/Pieces/PieceBlock.h"
#include "IO/Vtk/PieceCells.h"
#include "smg/Error.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

constexpr const char* Input = "The input";

} // namespace

MeshInMemory::MeshInMemory(vtkPointSet& mesh)
{
  if (mesh.GetNumberOfCells() > 0)
  {
    this->copyCells(mesh);
  }
  if (this->Corners.empty())
  {
    throw Error(
      "The input has no cells, or all of them are marked as duplicates or hidden: give it "
      "a mesh of triangles or tetrahedra.");
  }
  this->numberVertices(mesh.GetNumberOfPoints());
  this->copyPositions(mesh);
}

void MeshInMemory::copyCells(vtkPointSet& mesh)
{
  this->Type = cellTypeOf(mesh, Input);
  this->Corners = smg::cellCorners(mesh, this->Type, Input);
  this->copyFlags(mesh, keepOwnCells(mesh, cornersOf(this->Type), this->Corners));
}

void MeshInMemory::copyFlags(vtkPointSet& mesh, const std::vector<std::int64_t>& cells)
{
  vtkDataArray* flags = mesh.GetCellData()->GetArray(CellFlagsName);
  if (flags && flags->GetNumberOfComponents() == 1)
  {
    for (const std::int64_t cell : cells)
    {
      this->Flags.push_back(static_cast<std::uint8_t>(flags->GetTuple1(cell)));
    }
  }
}

void MeshInMemory::numberVertices(std::int64_t points)
{
  std::vector<std::int64_t> vertexOf(points, -1);
  for (std::int64_t& corner : this->Corners)
  {
    if (corner < 0 || corner >= points)
    {
      throw Error("The input has a cell with the point " + std::to_string(corner) +
                  ", which does not exist.");
    }
    std::int64_t& vertex = vertexOf[corner];
    if (vertex < 0)
    {
      vertex = this->vertices();
      this->Points.push_back(corner);
    }
    corner = vertex;
  }
}

void MeshInMemory::copyPositions(vtkPointSet& mesh)
{
  this->IsDouble = mesh.GetPoints()->GetDataType() != VTK_FLOAT;
  this->Positions.resize(3 * this->Points.size());
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    double* point = this->Positions.data() + 3 * i;
    mesh.GetPoint(this->Points[i], point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw Error("The input has a coordinate that is not a finite number at its point " +
                  std::to_string(this->Points[i]) + ".");
    }
  }
}

std::unique_ptr<MeshSource> MeshInMemory::source() const
{
  StreamInfo info;
  info.cellType = this->Type;
  info.vertices = this->vertices();
  info.cells = static_cast<std::int64_t>(this->Corners.size() / cornersOf(this->Type));
  info.doublePositions = this->IsDouble;
  for (int axis = 0; axis < 3; ++axis)
  {
    double& low = info.bounds[2 * axis] = this->Positions[axis];
    double& high = info.bounds[2 * axis + 1] = this->Positions[axis];
    for (std::size_t i = axis; i < this->Positions.size(); i += 3)
    {
      low = std::min(low, this->Positions[i]);
      high = std::max(high, this->Positions[i]);
    }
  }
  MeshBlock block;
  block.positions = this->Positions;
  block.corners = this->Corners;
  block.finalized = info.vertices;
  if (!this->Flags.empty())
  {
    info.cellColumns.push_back({ CellFlagsName, ScalarType::UInt8, 1 });
    Column flags{ info.cellColumns.back(), {} };
    flags.resize(this->Flags.size());
    std::ranges::copy(this->Flags, flags.as<std::uint8_t>().begin());
    block.cellColumns.push_back(std::move(flags));
  }
  return std::make_unique<OneBlockSource>(std::move(info), std::move(block));
}

} // namespace smg
