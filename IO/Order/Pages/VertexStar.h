// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Order/Pages/CellGroups.h"
#include "Solver/Memory/Buffer.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/**
 * What is around a vertex, from its link (see VertexLinks): its neighbours and, of triangles,
 * whether the mesh is a manifold there. For one vertex of a range after the other.
 *
 * Triangles that have a corner twice join neighbours, but are not counted as triangles; a triangle
 * that is there twice counts twice.
 */
class VertexStar
{
public:
  /** Links have `largestLink` ranks or fewer. */
  VertexStar(Workspace& workspace, RankRange range, std::size_t largestLink);
  /** Its memory in bytes. */
  static std::int64_t bytes(std::int64_t rangeSize, std::size_t largestLink);

  /**
   * Finds the neighbours of a vertex, each once, not itself.
   * @param neighbours room for as many ranks as the link has
   * @returns how many there are
   */
  std::size_t visit(std::uint32_t vertex, std::span<const std::uint32_t> link, std::size_t corners,
    std::span<std::uint32_t> neighbours);

  // Of the triangles around the last visited vertex:

  /** The number of edges to vertices of higher rank with one triangle. */
  std::int64_t boundaryEdges() const { return this->Boundary; }
  /** The number of edges to vertices of higher rank with more than two triangles. */
  std::int64_t nonManifoldEdges() const { return this->NonManifold; }
  /** The number of groups of triangles that are connected by edges at the vertex: fans and discs.
   * With more than one, the vertex is not manifold. */
  std::int64_t fans() const { return this->Fans; }

private:
  /** The data of a neighbour. */
  struct Spoke
  {
    std::uint32_t triangles; ///< of the edge to it
    std::uint32_t parent;    ///< in the forest of connected spokes
  };

  std::uint32_t spoke(std::uint32_t rank, std::span<std::uint32_t> neighbours);
  void findOutside(
    std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours);
  void connectTriangles(
    std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours);
  std::uint32_t root(std::uint32_t spoke);

  std::uint32_t* slots() const { return reinterpret_cast<std::uint32_t*>(this->Slots.data()); }
  Spoke* spokes() const { return reinterpret_cast<Spoke*>(this->Spokes.data()); }

  std::uint32_t First, Count;
  Buffer Slots; ///< of each vertex of the range: Begin at that time + number among the neighbours
  Buffer Spokes;
  std::uint32_t Begin = 0; ///< grows, so that slots of earlier vertices need not be cleared
  std::uint32_t Found = 0, Outside = 0;
  std::int64_t Boundary = 0, NonManifold = 0, Fans = 0;
};

} // namespace smg
