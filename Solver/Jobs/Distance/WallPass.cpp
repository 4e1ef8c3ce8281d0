// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/WallPass.h"

#include "Solver/Assembly/Facets.h"
#include "Solver/Mesh/VisitCells.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The two halves of a wall distance: collecting the wall triangles of a mesh stream
// (WallTriangles), and lowering the distances of all vertices with a part of these (WallPass).
//
// A pass treats the vertices in chunks of fixed length, whatever the blocks are. The vertices of a
// chunk are distributed over the threads; each is independent of all others, since the guess from
// the vertex before it only makes the search faster. So the result depends on neither blocks nor
// threads.

namespace smg
{

WallTriangles::WallTriangles(BlockStore& to, DistanceSources& from, bool everywhere, Pool& pool)
  : To(to)
  , From(from)
  , Everywhere(everywhere)
  , Open(pool)
  , Points(pool, 3)
  , Numbers(pool)
{
}

void WallTriangles::add(const MeshBlock& block)
{
  this->addVertices(block);
  this->addCells(block);
  this->take(block.finalized);
}

/** Keeps positions and numbers of open vertices: a triangle is known when its lowest corner is
 * final. */
void WallTriangles::addVertices(const MeshBlock& block)
{
  this->Vertices = block.firstVertex + block.vertices();
  this->Open.extend(this->Vertices);
  this->Points.extendRaw(this->Vertices);
  this->Numbers.extendRaw(this->Vertices);
  std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
  for (std::int64_t i = 0; i < block.vertices(); ++i)
  {
    this->Numbers[block.firstVertex + i] = this->From.numberOf(block, static_cast<std::size_t>(i));
  }
}

void WallTriangles::addCells(const MeshBlock& block)
{
  constexpr int Corners = 4;
  const std::span<const std::uint8_t> selected = this->From.facetsAt(block);
  const std::span<const std::uint8_t> inner = this->From.innerFacets();
  forDistinctCells(CellType::Tetrahedron, block,
    [&](const std::int64_t* corners, std::size_t c)
    {
      for (int k = 0; k < Corners; ++k)
      {
        const CellFacet facet = facetOf(CellType::Tetrahedron, corners, k);
        // Both cells of an interior face are added, so that it is known as such, even if it is not
        // selected. Boundary faces have one cell, whose selection is stored.
        const std::int32_t group = this->From.group(Corners * c + static_cast<std::size_t>(k));
        const bool isOfGroup = (inner[c] >> k & 1U) != 0;
        if (isOfGroup)
        {
          // Wall in any case, whether another cell has it or not.
          this->Inner[facet.vertex[0]].push_back({ facet.vertex[1], facet.vertex[2], group });
        }
        const bool isWall = this->Everywhere || (!isOfGroup && (selected[c] >> k & 1U) != 0);
        this->Open.add(facet.vertex[0], facet.vertex[1], facet.vertex[2], isWall ? group + 1 : 0);
      }
    });
}

void WallTriangles::take(std::int64_t end)
{
  // In the order of the lowest corner, then of the stream: the numbers of triangles do not depend
  // on blocks.
  for (; this->Final < end; ++this->Final)
  {
    this->Open.take(this->Final,
      [&](std::int64_t middle, std::int64_t high, std::int32_t wall)
      {
        if (wall > 0)
        {
          this->add(middle, high, wall - 1);
        }
      });
    const auto ofGroups = this->Inner.find(this->Final);
    if (ofGroups != this->Inner.end())
    {
      for (const OfGroup& facet : ofGroups->second)
      {
        this->add(facet.middle, facet.high, facet.group);
      }
      this->Inner.erase(ofGroups);
    }
  }
  this->Open.release(this->Final);
  this->Points.release(this->Final);
  this->Numbers.release(this->Final);
}

/** Adds a triangle with the lowest corner `Final`. */
void WallTriangles::add(std::int64_t middle, std::int64_t high, std::int32_t group)
{
  NumberedTriangle triangle;
  const std::int64_t corners[3] = { this->Final, middle, high };
  for (int k = 0; k < 3; ++k)
  {
    std::copy_n(this->Points.at(corners[k]), 3, triangle.points.point[k]);
    triangle.numbers[k] = this->From.label(this->Numbers[corners[k]], group);
  }
  this->To.add(triangle);
}

void WallTriangles::finish()
{
  this->take(this->Vertices);
  this->To.finish();
}

WallPass::WallPass(const TrianglePart& part, bool isFirst, WallValues values, Pool& pool)
  : Part(part)
  , IsFirst(isFirst)
  , Values(values)
  , Memory(pool, static_cast<std::size_t>(WallValues::ChunkVertices * WallValues::VertexBytes))
{
  // One allocation, from the type with the strictest alignment on. All parts have room, wanted or
  // not.
  std::byte* next = this->Memory.data();
  const auto place = [&]<class T>(std::span<T>& of, std::int64_t components)
  {
    const auto count = static_cast<std::size_t>(components * WallValues::ChunkVertices);
    of = { reinterpret_cast<T*>(next), count };
    next += of.size_bytes();
  };
  place(this->Position, 3);
  place(this->Distance, 1);
  place(this->Source, 1);
  place(this->Direction, 3);
}

void WallPass::add(std::span<const double> positions, Workers& threads)
{
  while (!positions.empty())
  {
    // A block of the stream may be shorter or longer than a chunk.
    const auto room = static_cast<std::size_t>(3 * (WallValues::ChunkVertices - this->Count));
    const auto part = positions.first(std::min(positions.size(), room));
    std::ranges::copy(part, this->Position.begin() + 3 * this->Count);
    positions = positions.subspan(part.size());
    this->Count += static_cast<std::int64_t>(part.size() / 3);
    if (this->Count == WallValues::ChunkVertices)
    {
      this->lowerChunk(threads);
    }
  }
}

void WallPass::finish(Workers& threads)
{
  if (this->Count > 0)
  {
    this->lowerChunk(threads);
  }
}

/** Lowers the distances of a chunk on all threads. Each vertex has places of its own for its
 * results. */
void WallPass::lowerChunk(Workers& threads)
{
  this->loadChunk();
  // Enough vertices in a row for the guesses to pay, enough parts for many threads.
  constexpr std::int64_t PartVertices = 1024;
  runAll(threads, static_cast<int>((this->Count + PartVertices - 1) / PartVertices),
    [this](int part)
    {
      const std::int64_t begin = part * PartVertices;
      this->lower(begin, std::min(begin + PartVertices, this->Count));
    });
  this->writeChunk();
  ++this->Chunk;
  this->Count = 0;
}

void WallPass::lower(std::int64_t begin, std::int64_t end)
{
  // Consecutive vertices of a stream are mostly close together: the triangle nearest to one is a
  // good guess for the next.
  std::int64_t guess = -1;
  for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
  {
    const double* point = this->Position.data() + 3 * v;
    // The distance so far is the bound: infinite in the first pass.
    const TriangleTree::Nearest nearest =
      this->Part.tree().nearest(point, this->Distance[v], guess);
    // An earlier part of the wall has a triangle that is at least as near.
    if (nearest.triangle < 0)
    {
      continue;
    }
    guess = nearest.triangle;
    const auto triangle = static_cast<std::size_t>(nearest.triangle);
    const TrianglePoints& corners = this->Part.points()[triangle];
    const Vector away = difference(point, nearestPoint(corners, point).data());
    // The gradient points away from the nearest point of the wall.
    const double distance = nearest.distance;
    this->Distance[v] = distance;
    for (int k = 0; k < 3; ++k)
    {
      this->Direction[3 * v + k] = distance > 0 ? static_cast<float>(away[k] / distance) : 0.0F;
    }
    if (this->Values.sources)
    {
      // The source is the corner of the nearest triangle that is nearest to the vertex.
      this->Source[v] = this->Part.numberNearest(nearest.triangle, point);
    }
  }
}

/** The one place that knows which parts a chunk has, for reading and writing alike. */
void WallPass::forParts(auto visit)
{
  const auto count = static_cast<std::size_t>(this->Count);
  visit(WallValues::Distances, std::as_writable_bytes(this->Distance.first(count)));
  if (this->Values.sources)
  {
    visit(WallValues::Sources, std::as_writable_bytes(this->Source.first(count)));
  }
  if (this->Values.directions)
  {
    visit(WallValues::Directions, std::as_writable_bytes(this->Direction.first(3 * count)));
  }
}

void WallPass::loadChunk()
{
  if (this->IsFirst)
  {
    // Sources and directions are set with the first distance, which is finite.
    std::ranges::fill(this->Distance, std::numeric_limits<double>::infinity());
    return;
  }
  this->forParts([this](int part, std::span<std::byte> bytes)
    { this->Values.file.read(this->Chunk * WallValues::Parts + part, bytes); });
}

void WallPass::writeChunk()
{
  this->forParts([this](int part, std::span<std::byte> bytes)
    { this->Values.file.write(this->Chunk * WallValues::Parts + part, bytes); });
}

} // namespace smg
