// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/FixedVertices.h"

#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/Selection.h"

#include <algorithm>
#include <string>

// The vertices that a job holds: the union of several parts of the mesh, and of the boundary if the
// job keeps it. Each part is a Selection; the union is formed block by block, in one byte per
// vertex of the block.

namespace smg
{

/** Makes a selection of each part; its key in messages is its place in the list of held parts. */
FixedVertices::FixedVertices(
  const std::vector<Where>& parts, bool findsBoundary, MeshColumns& columns)
  : Memory(columns.memory())
  , All(columns)
{
  if (findsBoundary)
  {
    this->Boundary = std::make_unique<BoundarySelection>(DataPlace::Vertices, "boundary", columns);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    // A column of the vertices is meant if both have one, as in problem files.
    this->Parts.push_back(this->All.add(
      parts[k], DataPlace::Vertices, ColumnOwner::Vertices, "hold[" + std::to_string(k) + "]"));
  }
}

/** The boundary is a selection like any other. */
void FixedVertices::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (this->Boundary)
  {
    this->Boundary->prepare(block, scratch);
  }
  this->All.prepare(block, scratch);
}

/** Unlike a part that is asked for, a boundary may be empty: the mesh is closed then. It is looked
 * for even where it is not held, see hasBoundary(). */
void FixedVertices::endPreparing(bool fixesBoundary)
{
  this->BoundarySize = this->Boundary ? this->Boundary->finish() : 0;
  if (!fixesBoundary || this->BoundarySize == 0)
  {
    // Not held, or empty: later readings need not look at it.
    this->Boundary.reset();
  }
  this->All.endPreparing(nullptr);
}

std::span<const std::uint8_t> FixedVertices::at(const MeshBlock& block)
{
  this->Held.assign(static_cast<std::size_t>(block.vertices()), 0);
  const auto add = [this](const Selection* part)
  {
    for (std::size_t i = 0; i < this->Held.size(); ++i)
    {
      this->Held[i] |= part ? part->atVertices()[i] : 1;
    }
  };
  this->All.startBlock(block);
  std::ranges::for_each(this->Parts, add);
  if (this->Boundary)
  {
    this->Boundary->startBlock(block);
    add(this->Boundary.get());
  }
  return this->Held;
}

/** If vertices and cells have a column of the name, that of the cells is meant. */
SelectedVertices::SelectedVertices(
  const Where& where, const StreamInfo& mesh, const std::string& name)
  : Columns(mesh, name)
  , All(this->Columns)
  , Selected(this->All.add(where, DataPlace::Vertices, ColumnOwner::Cells, "region"))
{
}

void SelectedVertices::add(const MeshBlock& block)
{
  // In the temporary folder of the system.
  this->All.prepare(block, {});
  if (!this->Selected->needsPreparing())
  {
    if (!this->Own)
    {
      this->Own.emplace(std::filesystem::path());
    }
    this->Own->append(this->Selected->atVertices());
  }
}

void SelectedVertices::finish()
{
  if (this->Own)
  {
    this->Own->finish();
  }
  this->All.endPreparing(nullptr);
}

/** Any vertex in any order, from the bits that the preparation has stored. */
bool SelectedVertices::contains(std::int64_t vertex) const
{
  VertexSetFile& vertices = this->Own ? *this->Own : *this->Selected->preparedVertices();
  return vertices.contains(vertex);
}

} // namespace smg
