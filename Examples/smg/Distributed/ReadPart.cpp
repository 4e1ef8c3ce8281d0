// SPDX-License-Identifier: BSD-3-Clause
#include "ReadPart.h"

#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace
{

bool hasIds(const std::vector<smg::ColumnSpec>& columns)
{
  return std::ranges::find(columns, smg::OriginalIdSpec) != columns.end();
}

/** A column with these stream indices as original numbers. */
smg::Column idColumn(const std::vector<std::int64_t>& ids)
{
  smg::Column column{ smg::OriginalIdSpec, {} };
  column.resize(ids.size());
  if (!ids.empty())
  {
    std::memcpy(column.bytes.data(), ids.data(), ids.size() * sizeof(std::int64_t));
  }
  return column;
}

} // namespace

smg::StreamInfo infoOfPart(const smg::StreamInfo& mesh)
{
  smg::StreamInfo info = mesh;
  if (!hasIds(info.vertexColumns))
  {
    if (std::ranges::find(info.vertexColumns, smg::OriginalIdName, &smg::ColumnSpec::name) !=
        info.vertexColumns.end())
    {
      throw smg::Error("--engine hypre: the column OriginalId of the mesh must be one of int64, "
                       "with the number of each vertex: convert the mesh again.");
    }
    info.vertexColumns.push_back(smg::OriginalIdSpec);
  }
  return info;
}

void readPart(smg::VsmReader& mesh, std::vector<std::string> vertexColumns,
  std::vector<std::string> cellColumns, smg::Team& team, smg::MeshPart& part)
{
  // Always with the numbers, which messages name.
  std::erase(vertexColumns, smg::OriginalIdName);
  const bool addsIds = !hasIds(mesh.info().vertexColumns);
  if (!addsIds)
  {
    vertexColumns.emplace_back(smg::OriginalIdName);
  }
  std::erase(cellColumns, smg::OriginalCellIdName);
  if (smg::findColumn(mesh.info().cellColumns, smg::OriginalCellIdSpec) >= 0)
  {
    cellColumns.emplace_back(smg::OriginalCellIdName);
  }
  mesh.selectColumns(vertexColumns, cellColumns);
  smg::MeshPiece piece;
  mesh.readPiece(firstCellOf(mesh.info(), team.rank(), team.size()),
    firstCellOf(mesh.info(), team.rank() + 1, team.size()), piece);
  const auto foreign = std::ranges::count(piece.ghost, 1);
  if (addsIds)
  {
    piece.vertexColumns.push_back(idColumn(piece.ids));
  }
  smg::MeshBlock& block = part.block;
  block.firstCell = piece.firstCell;
  block.positions = std::move(piece.positions);
  block.corners = std::move(piece.corners);
  block.vertexColumns = std::move(piece.vertexColumns);
  block.cellColumns = std::move(piece.cellColumns);
  part.ids = std::move(piece.ids);
  // Vertices belong to the process whose cells come first, in their order.
  const std::vector<std::int64_t> owned =
    team.gather(std::vector<std::int64_t>{ static_cast<std::int64_t>(part.ids.size()) - foreign });
  part.firstOwned = std::accumulate(owned.begin(), owned.begin() + team.rank(), std::int64_t(0));
  part.endOwned = part.firstOwned + owned[static_cast<std::size_t>(team.rank())];
}
