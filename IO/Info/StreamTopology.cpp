// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Info/StreamTopology.h"

// How the cells of a stream fit together, in one pass. When a vertex gets no more cells, all that
// is around it is known: for surfaces its triangles, hence its edges with their numbers of
// triangles, and whether the triangles are connected across these. An edge is counted at its lower
// vertex. For solids the same holds for the triangles of the boundary: a face of one tetrahedron is
// known when its lowest corner is complete, which is before its other corners are.

namespace smg
{

void OpenStars::append(std::int64_t v, std::int64_t to, std::int64_t from)
{
  const std::int32_t slot = this->Triangles.take();
  this->Triangles[slot] = { static_cast<std::uint32_t>(to), static_cast<std::uint32_t>(from),
    this->Heads[v] };
  this->Heads[v] = slot;
}

void OpenStars::add(std::int64_t a, std::int64_t b, std::int64_t c)
{
  this->append(a, b, c);
  this->append(b, c, a);
  this->append(c, a, b);
}

const VertexStar* OpenStars::take(std::int64_t v)
{
  this->Link.clear();
  const std::uint32_t shift = Centre - static_cast<std::uint32_t>(v);
  for (std::int32_t slot = this->Heads[v]; slot != 0;)
  {
    const Entry entry = this->Triangles[slot];
    this->Triangles.give(slot);
    this->Link.push_back(entry.to + shift);
    this->Link.push_back(entry.from + shift);
    slot = entry.next;
  }
  this->Heads[v] = 0;
  if (this->Link.empty())
  {
    return nullptr;
  }
  this->Neighbours.resize(std::max(this->Neighbours.size(), this->Link.size()));
  this->OfLinks.resize(accountedBytes(static_cast<std::int64_t>(
    (this->Link.capacity() + this->Neighbours.capacity()) * sizeof(std::uint32_t))));
  this->Found = this->Star.visit(Centre, this->Link, 3, this->Neighbours);
  return &this->Star;
}

void StreamTopology::extend(std::int64_t vertices)
{
  this->Boundary.extend(vertices);
  this->Stars.extend(vertices);
  if (this->Type == CellType::Tetrahedron)
  {
    this->Faces.extend(vertices);
  }
}

void StreamTopology::add(const std::int64_t* corners, GroupSet groups)
{
  if (this->Type == CellType::Triangle)
  {
    this->Stars.add(corners[0], corners[1], corners[2]);
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    const CellFacet face = facetOf(this->Type, corners, k);
    this->Faces.add(face.vertex[0], face.vertex[1], face.vertex[2], groups);
  }
}

void StreamTopology::close(std::int64_t end, const MeshMeasures& points)
{
  for (; this->Closed < end; ++this->Closed)
  {
    this->closeVertex(this->Closed, points);
  }
  this->Stars.release(end);
  if (this->Type == CellType::Tetrahedron)
  {
    this->Faces.release(end);
  }
  this->Boundary.close(
    end, [this](const Part& part) { this->Counts.boundaryParts += part.facets > 0 ? 1 : 0; });
}

void StreamTopology::closeVertex(std::int64_t v, const MeshMeasures& points)
{
  if (this->Type == CellType::Tetrahedron)
  {
    this->Counts.nonManifoldFacets += this->Faces.take(v,
      [&](std::int64_t middle, std::int64_t high, std::int32_t groups)
      {
        const std::int64_t face[] = { v, middle, high };
        this->addBoundary(face, points);
        const auto placeOf = [&points](std::int64_t corner)
        { return PlaceSample::placeOf(points.point(corner)); };
        this->Coincident.add(
          PlaceSample::placeOf({ placeOf(v), placeOf(middle), placeOf(high) }), groups);
        this->Stars.add(v, middle, high);
      });
  }
  const VertexStar* star = this->Stars.take(v);
  if (!star)
  {
    return;
  }
  this->Counts.nonManifoldEdges += star->nonManifoldEdges();
  this->Counts.nonManifoldVertices += star->fans() > 1 ? 1 : 0;
  if (this->Type == CellType::Triangle)
  {
    this->Counts.nonManifoldFacets += star->nonManifoldEdges();
    this->Counts.turnedEdges += star->turnedEdges();
    this->Counts.unbalancedEdges += star->unbalancedEdges();
    if (star->boundaryEdges() > 0)
    {
      this->Stars.visitBoundary(v,
        [&](std::int64_t to)
        {
          const std::int64_t edge[] = { v, to };
          this->addBoundary(edge, points);
        });
    }
  }
}

auto StreamTopology::coincidentFaces() const -> CoincidentFaces
{
  CoincidentFaces found;
  std::vector<PlaceSample::Entry> entries = this->Coincident.entries();
  const int shift = this->Coincident.shift();
  PlaceSample::forPlaces(entries,
    [&](std::span<const PlaceSample::Entry> place)
    {
      if (place.size() > 1)
      {
        const std::int64_t places = std::int64_t(1) << shift;
        found.places[{ place.front().label, place.back().label }] += places;
        found.count += places;
      }
    });
  found.isExact = shift == 0;
  return found;
}

/** Adds a facet of the boundary, whose corners are open. */
void StreamTopology::addBoundary(const std::int64_t* corners, const MeshMeasures& points)
{
  const double* at[3] = {};
  std::int64_t root = corners[0];
  for (int k = 0; k < BoundaryFacet::cornersOf(this->Type); ++k)
  {
    at[k] = points.point(corners[k]);
    root = this->Boundary.join(root, corners[k]);
  }
  ++this->Boundary.sums(root).facets;
  ++this->Counts.boundaryFacets;
  this->Counts.boundarySize += facetArea(this->Type, at);
}

} // namespace smg
