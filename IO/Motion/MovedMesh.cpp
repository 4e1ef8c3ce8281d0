// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Motion/MovedMesh.h"

#include "IO/Motion/CellNormals.h"
#include "IO/Motion/MovedPoints.h"
#include "Solver/Stream/AddedColumn.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

const ColumnSpec NormalsSpec{ NormalsName, ScalarType::Float32, 3 };

bool hasNormals(const std::vector<ColumnSpec>& specs)
{
  return std::any_of(specs.begin(), specs.end(), isNormals);
}

std::vector<std::string> namesWithoutNormals(const std::vector<ColumnSpec>& specs)
{
  std::vector<std::string> names;
  for (const ColumnSpec& spec : specs)
  {
    if (!isNormals(spec))
    {
      names.push_back(spec.name);
    }
  }
  return names;
}

} // namespace

MovedMesh::MovedMesh(
  const VsmReader& mesh, Solution& positions, MovedNormals normals, const NormalsOptions& options)
  : Mesh(mesh)
  , Positions(positions)
  , Options(options)
{
  const StreamInfo& info = mesh.info();
  if (normals == MovedNormals::Drop || info.cellType != CellType::Triangle)
  {
    return;
  }
  this->OfCells = hasNormals(info.cellColumns);
  if (hasNormals(info.vertexColumns))
  {
    MovedPoints moved(mesh.source({}, {}), positions);
    this->OfVertices.emplace(moved, options);
  }
}

std::unique_ptr<MeshSource> MovedMesh::withoutNormals() const
{
  const StreamInfo& info = this->Mesh.info();
  return std::make_unique<MovedPoints>(this->Mesh.source(namesWithoutNormals(info.vertexColumns),
                                         namesWithoutNormals(info.cellColumns)),
    this->Positions);
}

std::unique_ptr<MeshSource> MovedMesh::source() const
{
  std::unique_ptr<MeshSource> source = this->withoutNormals();
  if (this->OfVertices)
  {
    source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Vertices, NormalsSpec,
      [this](const MeshBlock& block, Column& column)
      { this->OfVertices->read(block.firstVertex, block.vertices(), column.as<float>()); });
  }
  if (this->OfCells)
  {
    const auto normals = std::make_shared<CellNormals>(this->Options.scratch, this->Options.memory);
    source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, NormalsSpec,
      [normals](const MeshBlock& block, Column& column)
      {
        normals->read(block, column.as<float>());
        normals->release(block);
      });
  }
  return source;
}

} // namespace smg
