// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/MovedVertices.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include <algorithm>

namespace smg
{

namespace
{

std::ptrdiff_t requireIds(const StreamInfo& info)
{
  const std::ptrdiff_t ids = findColumn(info.vertexColumns, OriginalIdSpec);
  if (ids < 0)
  {
    throw Error(std::string("The mesh has no column ") + OriginalIdName +
                ", which says where its vertices stand in the file that it was made of.");
  }
  return ids;
}

std::ptrdiff_t findNormals(const StreamInfo& info)
{
  const auto found = std::ranges::find_if(info.vertexColumns, isNormals);
  return found == info.vertexColumns.end() ? -1 : found - info.vertexColumns.begin();
}

} // namespace

MovedVertices::MovedVertices(
  MeshSource& moved, Workspace& workspace, const ProgressFunction& progress)
  : Ids(requireIds(moved.info()))
  , Normals(findNormals(moved.info()))
  , Rows(workspace)
  , Values(this->numbers())
{
  RowSort rows(workspace, workspace.available() * 3 / 4, this->numbers() * sizeof(double));
  Progress reported(progress);
  std::int64_t vertices = 0;
  for (MeshBlock block; moved.next(block);)
  {
    this->put(block, rows);
    vertices += block.vertices();
    reported.update(static_cast<double>(vertices) /
                    static_cast<double>(std::max(moved.info().vertices, vertices)));
  }
  rows.sort();
  this->keep(rows);
}

void MovedVertices::put(const MeshBlock& block, RowSort& rows)
{
  const auto ids = block.vertexColumns[static_cast<std::size_t>(this->Ids)].as<std::int64_t>();
  for (std::size_t v = 0; v < ids.size(); ++v)
  {
    if (ids[v] < 0)
    {
      throw Error("The original number " + std::to_string(ids[v]) +
                  " of a vertex is negative: the mesh must be the one that was made of the file.");
    }
    std::copy_n(&block.positions[3 * v], 3, this->Values.begin());
    for (int axis = 0; this->hasNormals() && axis < 3; ++axis)
    {
      this->Values[3 + std::size_t(axis)] =
        block.vertexColumns[static_cast<std::size_t>(this->Normals)].value(v, axis);
    }
    std::ranges::copy(
      std::as_bytes(std::span(this->Values)), rows.put(static_cast<std::uint64_t>(ids[v])));
    this->End = std::max(this->End, ids[v] + 1);
  }
}

/** Keeps the last row of each number. */
void MovedVertices::keep(RowSort& rows)
{
  const std::span<std::byte> values = std::as_writable_bytes(std::span(this->Values));
  RowSort::Row row;
  for (bool more = rows.next(row); more;)
  {
    const auto number = static_cast<std::int64_t>(row.key);
    std::copy_n(row.bytes, values.size(), values.begin());
    more = rows.next(row);
    if (!more || static_cast<std::int64_t>(row.key) != number)
    {
      this->Rows.put(0, number);
      this->Rows.append(0, values);
    }
  }
  this->Rows.close();
}

void MovedVertices::check(std::int64_t vertices, const std::string& name) const
{
  if (this->End > vertices)
  {
    throw Error(name + ": the mesh has a vertex " + std::to_string(this->End - 1) +
                ", but the file only " + std::to_string(vertices) +
                " vertices: it is not the one that the mesh was made of.");
  }
}

bool MovedVertices::find(std::int64_t vertex)
{
  if (!this->Reader || vertex < this->Wanted)
  {
    this->Reader.emplace(this->Rows);
    this->Number = -1;
  }
  this->Wanted = vertex;
  while (this->Number < vertex && this->Reader->get(this->Number))
  {
    this->Reader->read(std::as_writable_bytes(std::span(this->Values)));
  }
  return this->Number == vertex;
}

} // namespace smg
