// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/BoundarySelection.h"

#include <algorithm>

namespace smg
{

auto BoundarySelection::marker()
{
  return [this](std::int64_t low, std::int64_t middle, std::int64_t high)
  {
    if (this->Open->inner.contains({ low, middle, high }))
    {
      return;
    }
    const bool isFace = this->Columns.cellType() == CellType::Tetrahedron;
    for (const std::int64_t v : { low, middle, isFace ? high : middle })
    {
      *this->Open->marks.at(v) = 1;
    }
  };
}

void BoundarySelection::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (!this->Vertices)
  {
    this->Vertices.emplace(scratch);
    this->Open.emplace(this->Columns);
  }
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
    this->Count += std::ranges::count(final, 1);
    this->Vertices->append(final);
    open.written = finalized;
    open.marks.release(finalized);
  }
}

std::int64_t BoundarySelection::finish(MeshParts* parts)
{
  if (this->Open)
  {
    if (parts)
    {
      this->Open->inner = parts->innerFacets(this->Open->facets.open());
    }
    this->Open->facets.finish(this->marker());
    if (parts)
    {
      parts->join({ this->Open->marks.at(0), static_cast<std::size_t>(this->Open->vertices) });
    }
    this->write(this->Open->vertices);
    this->Vertices->finish();
    this->Open.reset();
  }
  return this->Count;
}

void BoundarySelection::endPreparing(MeshParts* parts)
{
  this->finish(parts);
  this->Selection::endPreparing(parts);
}

void BoundarySelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  if (block.firstVertex == 0)
  {
    this->Vertices->rewind();
  }
  this->Vertices->read(selected);
}

} // namespace smg
