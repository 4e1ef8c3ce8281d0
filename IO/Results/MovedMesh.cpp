// SPDX-License-Identifier: BSD-3-Clause
#include "smg/MovedMesh.h"

#include "IO/Results/MovedPoints.h"
#include "IO/Results/VertexNormals.h"
#include "Solver/Jobs/Fairing/OrientedMesh.h"
#include "Solver/Mesh/AddedColumn.h"
#include "smg/Error.h"

#include <algorithm>
#include <optional>
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

struct MovedMesh::Implementation
{
  Implementation(const StoredMesh& given, Solution& moved, const NormalsOptions& how)
    : oriented(moved.winding() ? std::optional<OrientedMesh>(std::in_place, given, *moved.winding())
                               : std::nullopt)
    , mesh(this->oriented ? *this->oriented : given)
    , positions(moved)
    , options(how)
  {
  }

  std::optional<OrientedMesh> oriented; ///< if the result is wound otherwise
  const StoredMesh& mesh;               ///< wound as the result
  Solution& positions;
  NormalsOptions options;
  std::optional<VertexNormals> ofVertices; ///< if the stream has these
  bool ofCells = false;                    ///< whether the stream has these

  std::unique_ptr<MeshSource> withoutNormals(Report* report) const
  {
    const StreamInfo& info = this->mesh.info();
    return std::make_unique<MovedPoints>(this->mesh.source(namesWithoutNormals(info.vertexColumns),
                                           namesWithoutNormals(info.cellColumns)),
      this->positions, report, this->options);
  }
};

MovedMesh::MovedMesh(
  const StoredMesh& mesh, Solution& positions, MovedNormals normals, const NormalsOptions& options)
  : Self(std::make_unique<Implementation>(mesh, positions, options))
{
  const StreamInfo& info = mesh.info();
  if (positions.columns() != 3 || positions.vertices() != info.vertices)
  {
    throw Error("a solution of " + std::to_string(positions.columns()) + " columns for " +
                std::to_string(positions.vertices()) + " vertices holds no positions of the " +
                std::to_string(info.vertices) + " vertices of " +
                (mesh.file().empty() ? "the mesh" : mesh.file().string()));
  }
  if (normals == MovedNormals::Drop || info.cellType != CellType::Triangle)
  {
    return;
  }
  this->Self->ofCells = hasNormals(info.cellColumns);
  if (hasNormals(info.vertexColumns))
  {
    MovedPoints moved(this->Self->mesh.source({}, {}), positions);
    this->Self->ofVertices.emplace(moved, options);
  }
}

MovedMesh::~MovedMesh() = default;

std::unique_ptr<MeshSource> MovedMesh::source(Report* report) const
{
  const Implementation* self = this->Self.get();
  std::unique_ptr<MeshSource> source = self->withoutNormals(report);
  if (self->ofVertices)
  {
    source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Vertices, NormalsSpec,
      [self](const MeshBlock& block, Column& column)
      { self->ofVertices->read(block.firstVertex, block.vertices(), column.as<float>()); });
  }
  if (self->ofCells)
  {
    const auto normals =
      std::make_shared<CellNormals>(self->options.scratch, self->options.memory / 2);
    source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, NormalsSpec,
      [normals](const MeshBlock& block, Column& column)
      {
        normals->read(block, column.as<float>());
        normals->release(block);
      });
  }
  return self->oriented ? numberedByFirstUse(std::move(source)) : std::move(source);
}

} // namespace smg
