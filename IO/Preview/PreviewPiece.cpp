// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/PreviewPiece.h"

#include "IO/Mesh/Columns.h"
#include "IO/Preview/SolidPreview.h"
#include "IO/Preview/StreamPreview.h"

#include <cstring>

namespace smg
{
namespace
{

/** The values of a column at the vertices `ids`, ascending, read in ranges of several vertices. */
Column gather(VsmReader& mesh, const ColumnSpec& spec, const std::vector<std::int64_t>& ids)
{
  constexpr std::int64_t stretch = 16384;
  const std::size_t size = spec.tupleBytes();
  Column gathered{ spec, {} };
  gathered.resize(ids.size());
  Column rows;
  for (std::size_t begin = 0; begin < ids.size();)
  {
    const std::int64_t first = ids[begin];
    std::size_t end = begin;
    while (end < ids.size() && ids[end] < first + stretch)
    {
      ++end;
    }
    mesh.readVertexColumn(spec.name, first, ids[end - 1] + 1 - first, rows);
    for (; begin < end; ++begin)
    {
      std::memcpy(gathered.bytes.data() + begin * size,
        rows.bytes.data() + (ids[begin] - first) * size, size);
    }
  }
  return gathered;
}

} // namespace

MeshPiece makePreviewPiece(VsmReader& mesh, std::int64_t maximumPoints,
  const ProgressFunction& progress, SolidPreviewCells cells)
{
  const std::vector<ColumnSpec>& columns = mesh.info().vertexColumns;
  if (cells != SolidPreviewCells::Tetrahedra || mesh.info().cellType != CellType::Tetrahedron)
  {
    return makePreview(*mesh.source(columnNames(columns), {}), maximumPoints, progress);
  }
  // Most rows are not needed, so the columns are read afterwards.
  MeshPiece piece = makeSolidPreview(mesh, maximumPoints, progress);
  for (const ColumnSpec& spec : columns)
  {
    piece.vertexColumns.push_back(gather(mesh, spec, piece.ids));
  }
  return piece;
}

} // namespace smg
