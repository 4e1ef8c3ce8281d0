// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SimplifiedMesh.h"

#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <span>
#include <utility>

// The parts of a simplified surface as one mesh stream. Vertices that several parts have are
// numbered once, at their first use, and remembered until no later part can have them: memory grows
// with the borders between parts.

namespace smg
{

SimplifiedMesh::SimplifiedMesh(MeshSource& mesh, bool marksHeld, const SimplifyTarget& target,
  std::int64_t memory, Workers& workers, std::function<void(double)> progress)
  : Surface(mesh)
  , Simplifier(this->Surface, marksHeld, target, memory, workers, std::move(progress))
  , Info(mesh.info())
{
  this->Info.cellType = CellType::Triangle;
  // Counted as the stream goes; what the mesh says of its order does not hold for the result.
  this->Info.vertices = this->Info.cells = 0;
  this->Info.width = this->Info.span = -1;
  if (marksHeld)
  {
    this->Info.vertexColumns.pop_back();
  }
  this->Info.cellColumns = carriedColumns(this->Surface.info());
  this->AddsIds = std::ranges::none_of(
    this->Info.vertexColumns, [](const ColumnSpec& spec) { return spec.name == OriginalIdName; });
  if (this->AddsIds)
  {
    this->Info.vertexColumns.push_back(OriginalIdSpec);
  }
}

bool SimplifiedMesh::next(MeshBlock& block)
{
  MeshBlock made;
  made.firstVertex = this->Info.vertices;
  made.firstCell = this->Info.cells;
  do
  {
    if (!this->Simplifier.next(this->Part))
    {
      return false;
    }
  } while (this->Part.surface.triangles() == 0);
  made.vertexColumns = emptyColumns(this->Info.vertexColumns);
  made.cellColumns = emptyColumns(this->Info.cellColumns);
  const SurfacePart& surface = this->Part.surface;
  std::vector<std::int64_t> numbers(surface.vertices(), -1);
  const Poll& poll = this->Simplifier.polled();
  for (std::size_t v = 0; v < numbers.size(); ++v)
  {
    poll.at(v);
    // Vertices of earlier parts have their numbers already.
    if (const auto known = this->Numbers.find(surface.ids[v]); known != this->Numbers.end())
    {
      numbers[v] = known->second;
    }
  }
  for (std::size_t i = 0; i < surface.corners.size(); ++i)
  {
    poll.at(i);
    const std::uint32_t corner = surface.corners[i];
    // Numbered by first use, as a stream requires.
    if (numbers[corner] < 0)
    {
      numbers[corner] = this->Info.vertices++;
      this->addVertex(corner, made);
    }
    made.corners.push_back(numbers[corner]);
  }
  for (std::size_t t = 0; t < surface.triangles(); ++t)
  {
    poll.at(t);
    surface.copyTriangle(t, made.cellColumns);
  }
  this->Info.cells += static_cast<std::int64_t>(surface.triangles());
  for (std::size_t v = 0; v < numbers.size(); ++v)
  {
    poll.at(v);
    if (this->Part.isShared[v] != 0)
    {
      this->Numbers.emplace(surface.ids[v], numbers[v]);
    }
  }
  // First the new shared vertices, then those that have ended, which may be among them.
  for (const std::int64_t id : this->Part.ended)
  {
    this->Numbers.erase(id);
  }
  // Final are the vertices below the first one that a later part may use.
  made.finalized = this->Info.vertices;
  for (const auto& [id, number] : this->Numbers)
  {
    made.finalized = std::min(made.finalized, number);
  }
  block = std::move(made);
  return true;
}

/** Appends a vertex of the part with its columns. */
void SimplifiedMesh::addVertex(std::size_t vertex, MeshBlock& block)
{
  const SurfacePart& surface = this->Part.surface;
  const std::span<Column> columns(block.vertexColumns);
  surface.copyVertex(
    vertex, block.positions, columns.first(columns.size() - (this->AddsIds ? 1 : 0)));
  if (this->AddsIds)
  {
    const auto id = std::as_bytes(std::span(&surface.ids[vertex], 1));
    columns.back().bytes.insert(columns.back().bytes.end(), id.begin(), id.end());
  }
}

} // namespace smg
