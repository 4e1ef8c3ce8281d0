// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/BoundarySelection.h"

#include <algorithm>

// The vertices of the boundary. Whether a vertex lies on it is known only when all its cells are,
// so one reading of the stream finds the boundary facets (BoundaryFacets), marks their corners, and
// writes a bit for each vertex that is final to a scratch file; later readings take the bits in
// stream order. In memory are the facets and marks of open vertices.

namespace smg
{

/** A function that marks the corners of a boundary facet. Its lowest corner is final; higher ones
 * may get more facets. */
auto BoundarySelection::marker()
{
  return [this](std::int64_t low, std::int64_t middle, std::int64_t high)
  {
    // The second cell of the facet belongs to another part of the mesh.
    if (this->Open->inner.contains({ low, middle, high }))
    {
      return;
    }
    const bool isFace = this->Columns.cellType() == CellType::Tetrahedron;
    // `high` is 0 for an edge, not a vertex.
    for (const std::int64_t v : { low, middle, isFace ? high : middle })
    {
      *this->Open->marks.at(v) = 1;
    }
  };
}

void BoundarySelection::begin()
{
  this->Selection::begin();
  this->Open.reset();
  this->Vertices.reset();
}

/** Adds a block: its facets, and the marks of vertices on boundary facets that become known by
 * it. */
void BoundarySelection::add(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (!this->Vertices)
  {
    this->Vertices.emplace(scratch);
    this->Open.emplace(this->Columns);
  }
  // Vertices first: the cells of the block use them.
  this->Open->vertices += block.vertices();
  this->Open->marks.append(block.vertices());
  this->Open->facets.add(block, this->marker());
  this->write(block.finalized);
}

/** Writes the vertices below `finalized`, whose facets are all known. */
void BoundarySelection::write(std::int64_t finalized)
{
  Window& open = *this->Open;
  if (finalized > open.written)
  {
    const std::span<const std::uint8_t> final(
      open.marks.at(open.written), static_cast<std::size_t>(finalized - open.written));
    // Final vertices cannot be marked any more.
    this->Count += std::ranges::count(final, 1);
    this->Vertices->append(final);
    open.written = finalized;
    open.marks.release(finalized);
  }
}

/** The end of preparation, which an empty boundary does not turn into an error. */
std::int64_t BoundarySelection::finish(MeshParts* parts)
{
  // Only once: the window is gone afterwards.
  if (this->Open)
  {
    if (parts)
    {
      this->Open->inner = parts->innerFacets(this->Open->facets.open());
    }
    // The facets whose lowest vertex was open until the end of the stream.
    this->Open->facets.finish(this->marker());
    if (parts)
    {
      // All vertices of a part are open until its end, so that the marks are complete from vertex 0
      // on.
      parts->join({ this->Open->marks.at(0), static_cast<std::size_t>(this->Open->vertices) });
    }
    this->write(this->Open->vertices);
    this->Vertices->finish();
    this->Open.reset();
  }
  return this->Count;
}

/** Here, a mesh without a boundary is an error: it was asked for. */
void BoundarySelection::endPreparing(MeshParts* parts)
{
  this->finish(parts);
  this->Selection::endPreparing(parts);
}

void BoundarySelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  this->Vertices->read(block.firstVertex, selected);
}

} // namespace smg
