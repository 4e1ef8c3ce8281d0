// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/VertexStar.h"
#include "Solver/Assembly/CoincidentPoints.h"
#include "Solver/Assembly/Facets.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Mesh/OpenSets.h"
#include "smg/Groups.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace smg
{

/** The triangles around the open vertices of a mesh stream, and what they are around those that
 * have all of their triangles. */
class OpenStars
{
public:
  explicit OpenStars(Pool& pool)
    : Heads(pool)
    , Triangles(pool)
    , Star(pool, { Centre - Near, Centre + Near }, 64)
    , OfLinks(pool)
  {
  }

  void extend(std::int64_t vertices) { this->Heads.extend(vertices); }
  void release(std::int64_t first) { this->Heads.release(first); }

  /** Adds a triangle with distinct corners. */
  void add(std::int64_t a, std::int64_t b, std::int64_t c);

  /** What is around vertex v, which is open and gets no more triangles; null if it has none.
   * Releases its triangles. */
  const VertexStar* take(std::int64_t v);

  /** Calls visit(to) for each edge of the vertex that was taken last to a higher vertex which has
   * one triangle. */
  template <class Visit>
  void visitBoundary(std::int64_t v, Visit&& visit) const
  {
    for (std::size_t k = 0; k < this->Found; ++k)
    {
      if (this->Neighbours[k] > Centre && this->Star.isBoundary(k))
      {
        visit(v + (this->Neighbours[k] - Centre));
      }
    }
  }

private:
  /** A triangle at one of its corners: the others, in cyclic order. */
  struct Entry
  {
    std::uint32_t to, from; ///< by their low 32 bits
    std::int32_t next;      ///< of the same corner; 0: none
  };

  // Vertices get ranks around that of the vertex that is taken; near ones are in a table.
  static constexpr std::uint32_t Centre = std::uint32_t(1) << 31, Near = 1 << 13;

  void append(std::int64_t v, std::int64_t to, std::int64_t from);

  Ring<std::int32_t> Heads; ///< the last triangle of a vertex; 0: none
  FreeList<Entry> Triangles;
  VertexStar Star;
  std::vector<std::uint32_t> Link, Neighbours;
  std::size_t Found = 0; ///< neighbours of the vertex that was taken last
  Reservation OfLinks;
};

/** How the cells of a mesh fit together. Every cell with distinct corners counts, duplicates, too.
 */
struct TopologyCounts
{
  std::int64_t boundaryFacets = 0;    ///< of one cell: edges of triangles, faces of tetrahedra
  std::int64_t boundaryParts = 0;     ///< of these: connected by vertices
  std::int64_t nonManifoldFacets = 0; ///< of more than two cells
  // Of the surface, or of the boundary of a solid:
  std::int64_t nonManifoldEdges = 0;    ///< of more than two triangles
  std::int64_t nonManifoldVertices = 0; ///< of VertexStar::fans() above 1
  std::int64_t turnedEdges = 0;         ///< see VertexStar; of surfaces
  std::int64_t unbalancedEdges = 0;     ///< likewise
  double boundarySize = 0.0;            ///< length of the boundary edges, area of the faces
};

/** Finds the topology of a mesh stream in one pass, with its open vertices in memory. */
class StreamTopology
{
public:
  StreamTopology(Pool& pool, CellType type)
    : Type(type)
    , Faces(pool)
    , Stars(pool)
    , Boundary(pool)
  {
  }

  /** To be called for the vertices of a block before its cells. */
  void extend(std::int64_t vertices);
  /** Adds a cell with distinct corners, and the set of groups that it is in. */
  void add(const std::int64_t* corners, GroupSet groups);
  /** Counts at the vertices up to before `end`, which get no more cells; `points` has them. */
  void close(std::int64_t end, const MeshMeasures& points);

  const TopologyCounts& counts() const { return this->Counts; }

  /** Faces of the boundary of a solid that lie on others, by the sets of groups of two of the cells
   * there. Of a large boundary they are estimates. */
  struct CoincidentFaces
  {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> places;
    std::int64_t count = 0;
    bool isExact = true;
  };
  CoincidentFaces coincidentFaces() const;

private:
  /** The facets of a part of the boundary. */
  struct Part
  {
    std::int64_t facets;

    Part& operator+=(const Part& other)
    {
      this->facets += other.facets;
      return *this;
    }
  };

  void closeVertex(std::int64_t v, const MeshMeasures& points);
  void addBoundary(const std::int64_t* corners, const MeshMeasures& points);

  CellType Type;
  OpenFacets Faces; ///< of tetrahedra
  OpenStars Stars;  ///< of the triangles of the surface, or of the boundary
  OpenSets<Part> Boundary;
  PlaceSample Coincident{ std::size_t(1) << 16 }; ///< faces with the sets of groups of their cells
  TopologyCounts Counts;
  std::int64_t Closed = 0;
};

} // namespace smg
