// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/PreviewSource.h"

#include "IO/Conversion/PartialProgress.h"
#include "IO/Formats/StreamConversion.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <utility>

namespace smg
{

namespace
{

Column numbers(const char* name, const std::vector<std::int64_t>& values)
{
  Column column{ { name, ScalarType::Int64, 1 }, {} };
  column.resize(values.size());
  std::copy(values.begin(), values.end(), column.as<std::int64_t>().begin());
  return column;
}

} // namespace

PreviewSource::PreviewSource(VsmReader& mesh, std::int64_t maximumPoints,
  const ProgressFunction& progress, const std::string& name)
{
  MeshPiece piece = makePreviewPiece(mesh, maximumPoints, partOf(progress, 0.0, 0.95));
  if (piece.corners.empty())
  {
    throw Error((name.empty() ? mesh.path().string() : name) + ": " + emptyPreview(maximumPoints));
  }
  std::vector<Column>& columns = piece.vertexColumns;
  // The mesh may be a preview itself: what its points are in another mesh is not asked for.
  std::erase_if(columns, [](const Column& column) { return column.spec.name == StreamIndexName; });
  columns.push_back(numbers(StreamIndexName, piece.ids));
  if (findColumn(columns, { OriginalIdName, ScalarType::Int64, 1 }) < 0)
  {
    columns.push_back(numbers(OriginalIdName, piece.ids));
  }
  this->Mesh.doublePositions = mesh.info().doublePositions;
  this->Mesh.positions = std::move(piece.positions);
  this->Mesh.corners = std::move(piece.corners);
  this->Mesh.vertexColumns = std::move(columns);
  this->Layout = layOut(this->Mesh, StreamOrder::BreadthFirst, partOf(progress, 0.95, 1.0));
  this->Source.emplace(this->Mesh, this->Layout, LayoutSource::WithoutCellIds);
}

} // namespace smg
