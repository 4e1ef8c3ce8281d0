// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenFacets.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <iterator>
#include <set>
#include <utility>

namespace smg
{

/** Finds the boundary facets of a mesh stream in one pass: the facets of exactly one cell. Cells
 * that use a vertex twice or are flagged as duplicates do not count. */
class BoundaryFacets
{
public:
  BoundaryFacets(Pool& pool, CellType type)
    : Type(type)
    , Open(pool)
  {
  }

  /** Adds the next block and calls found(low, middle, high) for each boundary facet whose lowest
   * vertex is final, in the order of these; `high` is 0 for an edge. */
  template <class Found>
  void add(const MeshBlock& block, Found&& found)
  {
    this->Vertices = block.firstVertex + block.vertices();
    this->Open.extend(this->Vertices);
    this->addCells(block);
    this->take(block.finalized, found);
  }

  /** Calls found() for the other boundary facets, after the last block. */
  template <class Found>
  void finish(Found&& found)
  {
    this->take(this->Vertices, found);
  }

  /** The number of edges of triangles so far that have two of them, which run along in the same
   * direction: they are wound against each other. */
  std::int64_t turnedEdges() const
  {
    return this->Turned + static_cast<std::int64_t>(this->MaybeTurned.size());
  }
  /** The facets of the cells so far, until their lowest vertex is final. */
  const OpenFacets& open() const { return this->Open; }

private:
  void addCells(const MeshBlock& block);

  template <class Found>
  void take(std::int64_t end, Found& found)
  {
    for (; this->Final < end; ++this->Final)
    {
      this->Open.take(this->Final, [&](std::int64_t middle, std::int64_t high, std::int32_t)
        { found(this->Final, middle, this->Type == CellType::Triangle ? 0 : high); });
    }
    this->Open.release(this->Final);
    const auto known = this->MaybeTurned.lower_bound({ this->Final, 0 });
    this->Turned += std::distance(this->MaybeTurned.begin(), known);
    this->MaybeTurned.erase(this->MaybeTurned.begin(), known);
  }

  CellType Type;
  OpenFacets Open;
  std::int64_t Vertices = 0, Final = 0, Turned = 0;
  /** Edges with two triangles so far, wound against each other, until they are final: with more
   * triangles an edge has no two sides. */
  std::set<std::pair<std::int64_t, std::int64_t>> MaybeTurned;
};

} // namespace smg
