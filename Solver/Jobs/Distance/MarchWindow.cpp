// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/MarchWindow.h"

#include <algorithm>
#include <cstring>
#include <limits>

// The window of a march: up to four consecutive chunks in memory, addressed as a ring. A vertex has
// the place (index mod 4 lengths) whatever chunks are shown, so that cells are stored with places,
// and moving the window moves no data: a chunk that is still shown stays where it is, and only the
// new one is read into the slot (chunk mod 4) of one that left.
//
// Chunks have a fixed number of vertices, so the memory is known before the march: 45 bytes per
// vertex (8 more with sources, 12 with directions, 40 with paths, 32 with
// roots, 40 with nearest sources) and the lists of
// cells.

namespace smg
{

namespace
{

/** Bytes of a vertex: position and distance, the facet of `via`, flags, and what is wanted of its
 * source, direction and path. */
std::int64_t vertexBytes(const ChunkPlan& plan)
{
  return 4 * std::int64_t(sizeof(double)) + 3 * std::int64_t(sizeof(std::uint32_t)) +
         std::int64_t(sizeof(std::uint8_t)) +
         (plan.sources ? std::int64_t(sizeof(std::int64_t)) : 0) +
         (plan.directions ? 3 * std::int64_t(sizeof(float)) : 0) +
         (plan.arrivals ? std::int64_t(sizeof(PathArrival)) : 0) +
         (plan.roots ? std::int64_t(sizeof(FrontRoot)) : 0) +
         (plan.nearest ? std::int64_t(sizeof(NearestSource)) : 0);
}

/** The vertices of a window, which may be longer than the mesh. */
std::int64_t windowVertices(const ChunkPlan& plan, std::int64_t vertices)
{
  return std::min(plan.window(), vertices);
}

std::int64_t slotBytes(const ChunkPlan& plan, std::int64_t innerCells, std::int64_t crossingCells)
{
  const std::int64_t corners = cornersOf(plan.cellType);
  return CellStars::bytes(plan.length, corners * innerCells) +
         CellStars::bytes(2 * plan.span, corners * crossingCells);
}

} // namespace

std::int64_t MarchWindow::bytes(
  const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells, std::int64_t crossingCells)
{
  const std::int64_t slots =
    std::min(ChunkPlan::WindowChunks, (vertices + plan.length - 1) / plan.length);
  return windowVertices(plan, vertices) * vertexBytes(plan) +
         slots * slotBytes(plan, innerCells, crossingCells);
}

MarchWindow::MarchWindow(ChunkedMesh& mesh, Pool& pool)
  : Mesh(mesh)
  , Length(static_cast<std::uint32_t>(mesh.plan.length))
  , Span(static_cast<std::uint32_t>(mesh.plan.span))
{
  const std::int64_t vertices = windowVertices(mesh.plan, mesh.vertices);
  this->Memory = Buffer(pool, static_cast<std::size_t>(vertices * vertexBytes(mesh.plan)));
  // One allocation, from the type with the strictest alignment on.
  std::byte* next = this->Memory.data();
  const auto part = [&]<class T>(T*& values, std::int64_t components)
  {
    values = reinterpret_cast<T*>(next);
    next += components * vertices * static_cast<std::int64_t>(sizeof(T));
  };
  part(this->Point, 3);
  part(this->Distance, 1);
  if (mesh.plan.sources)
  {
    part(this->Source, 1);
  }
  if (mesh.plan.arrivals)
  {
    part(this->Arrival, 1);
  }
  if (mesh.plan.roots)
  {
    part(this->Root, 1);
  }
  if (mesh.plan.nearest)
  {
    part(this->Nearest, 1);
  }
  if (mesh.plan.directions)
  {
    part(this->Direction, 3);
  }
  part(this->Via, 1);
  part(this->Flag, 1);

  // Each slot gets room for the chunk with the most cells, since any chunk may come to be in it.
  std::int64_t inner = 0, crossing = 0;
  for (const ChunkedMesh::Chunk& chunk : mesh.chunks)
  {
    inner = std::max(inner, chunk.innerCells);
    crossing = std::max(crossing, chunk.crossingCells);
  }
  this->MostInner = static_cast<std::uint32_t>(inner);
  this->MostCrossing = static_cast<std::uint32_t>(crossing);
  for (std::int64_t s = 0; s < std::min(ChunkPlan::WindowChunks, mesh.count()); ++s)
  {
    this->Slots[static_cast<std::size_t>(s)].memory =
      Buffer(pool, static_cast<std::size_t>(slotBytes(mesh.plan, inner, crossing)));
  }
}

/** Loads what is not there yet. Consecutive chunks are in different slots, so a chunk to be shown
 * never displaces another one. */
void MarchWindow::show(std::int64_t first, std::int64_t last)
{
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    Slot& slot = this->Slots[static_cast<std::size_t>(chunk % ChunkPlan::WindowChunks)];
    if (slot.chunk != chunk)
    {
      this->write(slot.chunk);
      this->load(slot, chunk);
    }
    slot.hasPrevious = chunk > first;
    slot.hasNext = chunk < last;
  }
  // The window moves by one chunk in the direction of the pass.
  this->readAhead(first < this->Shown ? first - 1 : last + 1);
  this->Shown = first;
}

void MarchWindow::flush()
{
  for (const Slot& slot : this->Slots)
  {
    this->write(slot.chunk);
  }
}

/** Tells the operating system which chunk comes next, so that it is read while this position is
 * settled. */
void MarchWindow::readAhead(std::int64_t chunk) const
{
  if (chunk < 0 || chunk >= this->Mesh.count())
  {
    return;
  }
  const auto announce = [chunk](const BlockStore& file, std::int64_t parts)
  {
    for (std::int64_t block = chunk * parts; block < (chunk + 1) * parts;)
    {
      block = file.willRead(block, (chunk + 1) * parts);
    }
  };
  announce(this->Mesh.mesh, ChunkedMesh::MeshParts);
  announce(this->Mesh.state, ChunkedMesh::StateParts);
}

void MarchWindow::load(Slot& slot, std::int64_t chunk)
{
  slot.chunk = chunk;
  this->loadVertices(chunk);
  this->loadCells(slot, chunk);
  this->loadState(chunk);
  const std::int64_t fronts = chunk * ChunkedMesh::StateParts + ChunkedMesh::Fronts;
  slot.waiting.resize(this->Mesh.state.bytes(fronts) / sizeof(FrontInterval));
  this->Mesh.state.read(fronts, std::as_writable_bytes(std::span(slot.waiting)));
  ++this->Read;
}

/** Reads the positions of a chunk, as doubles whatever the file has. */
void MarchWindow::loadVertices(std::int64_t chunk)
{
  this->Mesh.readPositions(chunk, { this->Point + 3 * std::size_t(this->placeOf(chunk)),
                                    3 * static_cast<std::size_t>(this->Mesh.countOf(chunk)) });
  const std::int64_t index = chunk * ChunkedMesh::MeshParts + ChunkedMesh::NearestSources;
  if (this->Nearest && this->Mesh.mesh.bytes(index) > 0)
  {
    this->Mesh.mesh.read(index, std::as_writable_bytes(this->of(this->Nearest, chunk)));
  }
  else if (this->Nearest)
  {
    // Nothing can be reached from sources without facets.
    std::ranges::fill(this->of(this->Nearest, chunk), NearestSource());
  }
}

/** Reads the cells of a chunk into the memory of its slot: corners, then the lists of the cells of
 * each vertex, then where these lists begin. */
void MarchWindow::loadCells(Slot& slot, std::int64_t chunk)
{
  const ChunkedMesh::Chunk& counts = this->Mesh.chunks[static_cast<std::size_t>(chunk)];
  const std::int64_t corners = cornersOf(this->Mesh.plan.cellType);
  auto* next = reinterpret_cast<std::uint32_t*>(slot.memory.data());
  const auto place = [&](CellStars& stars, std::int64_t vertices, std::int64_t cells, int part)
  {
    stars.corners = next;
    stars.list = stars.corners + corners * cells;
    stars.start = stars.list + corners * cells;
    next = stars.start + vertices + 1;
    this->Mesh.mesh.read(chunk * ChunkedMesh::MeshParts + part,
      std::as_writable_bytes(std::span(stars.corners, stars.list)));
  };
  place(slot.inner, this->Length, counts.innerCells, ChunkedMesh::InnerCells);
  place(
    slot.crossing, 2 * std::int64_t(this->Span), counts.crossingCells, ChunkedMesh::CrossingCells);
  corners == 3 ? this->buildStars<3>(slot) : this->buildStars<4>(slot);
}

/** Lists the cells of each vertex: inner cells by the index in the chunk, crossing ones by the
 * index from Span vertices before the chunk on. A crossing cell is not longer than the span, so it
 * lies within Span vertices on either side of the beginning of its chunk. */
template <int Corners>
void MarchWindow::buildStars(Slot& slot)
{
  const ChunkedMesh::Chunk& counts = this->Mesh.chunks[static_cast<std::size_t>(slot.chunk)];
  const std::uint32_t first = this->placeOf(slot.chunk);
  slot.inner.build<Corners>(
    this->Length, counts.innerCells, [first](std::uint32_t corner) { return corner - first; });
  // The chunk before the one in the first slot is in the last slot: places wrap around.
  const std::uint32_t window = this->Length * static_cast<std::uint32_t>(ChunkPlan::WindowChunks);
  const std::uint32_t begin = (first + window - this->Span) % window;
  slot.crossing.build<Corners>(2 * std::int64_t(this->Span), counts.crossingCells,
    [begin, window](std::uint32_t corner)
    { return corner >= begin ? corner - begin : corner + window - begin; });
}

/** Reads flags, distances, sources and directions. A chunk without sources is stored without
 * distances until the march writes some. */
void MarchWindow::loadState(std::int64_t chunk)
{
  BlockStore& file = this->Mesh.state;
  const std::int64_t index = chunk * ChunkedMesh::StateParts;
  const std::span<std::uint8_t> flags = this->of(this->Flag, chunk);
  const std::span<double> distances = this->of(this->Distance, chunk);
  file.read(index + ChunkedMesh::Flags, std::as_writable_bytes(flags));
  const auto readOr = [&]<class T>(std::span<T> of, int part, T fallback)
  {
    if (file.bytes(index + part) > 0)
    {
      file.read(index + part, std::as_writable_bytes(of));
      return;
    }
    std::ranges::fill(of, fallback);
  };
  readOr(distances, ChunkedMesh::Distances, std::numeric_limits<double>::infinity());
  // Where the front came from is not stored: it is unknown until the next shorter path arrives.
  std::ranges::fill(this->of(this->Via, chunk), std::array{ NoVertex, NoVertex, NoVertex });
  if (this->Source)
  {
    readOr(this->of(this->Source, chunk), ChunkedMesh::Sources, std::int64_t(-1));
  }
  if (this->Direction)
  {
    readOr(this->directions(chunk), ChunkedMesh::Directions, 0.0F);
  }
  if (this->Arrival)
  {
    readOr(this->of(this->Arrival, chunk), ChunkedMesh::Arrivals, PathArrival());
  }
  if (this->Root)
  {
    readOr(this->of(this->Root, chunk), ChunkedMesh::Roots, FrontRoot());
  }
}

/** Writes the state of a chunk if any vertex has changed: chunks that the front only passes by are
 * not written. */
void MarchWindow::write(std::int64_t chunk)
{
  const auto isChanged = [](std::uint8_t flags) { return (flags & Changed) != 0; };
  if (chunk < 0 || std::ranges::none_of(this->of(this->Flag, chunk), isChanged))
  {
    return;
  }
  const std::int64_t index = chunk * ChunkedMesh::StateParts;
  const auto store = [&](auto values, int part)
  { this->Mesh.state.write(index + part, std::as_bytes(values)); };
  // The file must not say Changed, or the chunk would be written again after it is read.
  for (std::uint8_t& flags : this->of(this->Flag, chunk))
  {
    flags &= static_cast<std::uint8_t>(~Changed);
  }
  store(this->of(this->Flag, chunk), ChunkedMesh::Flags);
  store(this->of(this->Distance, chunk), ChunkedMesh::Distances);
  if (this->Source)
  {
    store(this->of(this->Source, chunk), ChunkedMesh::Sources);
  }
  if (this->Direction)
  {
    store(this->directions(chunk), ChunkedMesh::Directions);
  }
  if (this->Arrival)
  {
    store(this->of(this->Arrival, chunk), ChunkedMesh::Arrivals);
  }
  if (this->Root)
  {
    store(this->of(this->Root, chunk), ChunkedMesh::Roots);
  }
  store(std::span(this->waiting(chunk)), ChunkedMesh::Fronts);
}

} // namespace smg
