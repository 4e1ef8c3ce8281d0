// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/ChunkedMesh.h"

#include "Solver/Core/Vector.h"
#include "Solver/Mesh/VisitCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

// Cuts a mesh stream into chunks of consecutive vertices on scratch files, in one reading. A cell
// belongs to the chunk of its highest vertex; since a chunk is at least as long as the span, its
// other corners are in the same chunk or in the one before. A chunk is written when all its
// vertices are final: then their flags are complete, which say whether cells reach over an end of
// the chunk.
//
// The cuts depend on the span, the number of vertices and the kind of the mesh only, not on blocks
// or the memory limit: therefore the march has the same bits whatever these are.

namespace smg
{

ChunkPlan ChunkPlan::of(const StreamInfo& mesh, std::int64_t span, bool sources, bool directions)
{
  // A longer window takes fewer passes, a shorter one less memory. Tetrahedral meshes have long
  // spans, so that fewer of them suffice.
  constexpr std::int64_t MinLength = 16384;
  const std::int64_t spans = mesh.cellType == CellType::Triangle ? 16 : 4;
  ChunkPlan plan;
  plan.cellType = mesh.cellType;
  plan.span = std::max<std::int64_t>(span, 1);
  plan.length = std::max(MinLength, spans * plan.span);
  if (mesh.vertices > 0)
  {
    // No longer than a small mesh, but never shorter than the span.
    plan.length = std::max(std::min(plan.length, mesh.vertices), plan.span);
  }
  plan.singlePositions = !mesh.doublePositions;
  plan.sources = sources;
  plan.directions = directions;
  // Places are stored with 32 bits.
  if (plan.window() > INT32_MAX)
  {
    throw Error("the span of the stream, " + std::to_string(span) +
                " vertices, is too long for distances: convert the mesh with the order bfs");
  }
  return plan;
}

void ChunkedMesh::readPositions(std::int64_t chunk, std::span<double> positions)
{
  const std::int64_t index = chunk * MeshParts + Positions;
  if (!this->plan.singlePositions)
  {
    this->mesh.read(index, std::as_writable_bytes(positions));
    return;
  }
  // Single precision is read into the second half of the room and widened from the front: the
  // writing end never overtakes the reading end.
  const std::span<std::byte> half =
    std::as_writable_bytes(positions).subspan(positions.size() * sizeof(float));
  this->mesh.read(index, half);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    float coordinate = 0;
    std::memcpy(&coordinate, half.data() + i * sizeof(float), sizeof(float));
    positions[i] = coordinate;
  }
}

/** Grows by a quarter: the memory of cells is the larger part of an open chunk. */
void ChunkWriter::CellList::add(Pool& pool, const std::uint32_t* corners, std::size_t count)
{
  const std::size_t bytes = count * sizeof(*corners);
  if (this->Used + bytes > this->Memory.size())
  {
    constexpr std::size_t First = 4096;
    this->Memory.grow(pool, std::max(First, this->Used + this->Used / 4 + bytes));
  }
  std::memcpy(this->Memory.data() + this->Used, corners, bytes);
  this->Used += bytes;
}

ChunkWriter::ChunkWriter(
  ChunkedMesh& to, DistanceSources& sources, SourceFacets* facets, Pool& pool)
  : To(to)
  , From(sources)
  , Facets(facets)
  , Owner(pool)
  , Points(pool, 3)
  , Marks(pool)
  , Numbers(pool)
{
}

/** Adds a block to the open chunks, and writes those that are complete. */
void ChunkWriter::add(const MeshBlock& block)
{
  this->addVertices(block);
  const auto cells = static_cast<std::int64_t>(cellsOf(this->To.plan.cellType, block));
  std::int64_t added = 0;
  // Cells without area or volume take part, since two parts of a surface may be joined by them
  // alone.
  forDistinctCells(this->To.plan.cellType, block,
    [&](const std::int64_t* corners, std::size_t /*c*/)
    {
      this->addCell(corners);
      ++added;
    });
  this->Cells += cells;
  this->Skipped += cells - added;
  const std::int64_t length = this->To.plan.length;
  while (this->To.firstOf(this->To.count()) + length <= block.finalized)
  {
    this->writeChunk(length);
  }
}

/** Keeps positions and marks of the vertices of a block until their chunk is written. Sources begin
 * dirty, with the distance 0. */
void ChunkWriter::addVertices(const MeshBlock& block)
{
  const std::int64_t first = block.firstVertex;
  const std::int64_t end = first + block.vertices();
  this->Points.extendRaw(end);
  std::ranges::copy(block.positions, this->Points.at(first));
  this->Marks.extend(end);
  if (this->To.plan.sources)
  {
    this->Numbers.extendRaw(end);
  }
  const std::span<const std::uint8_t> isSource = this->From.verticesAt(block);
  for (std::size_t i = 0; i < isSource.size(); ++i)
  {
    const std::int64_t vertex = first + static_cast<std::int64_t>(i);
    if (isSource[i])
    {
      this->Marks[vertex] = isSource[i] == RegionSource ? Dirty | OfRegion : Dirty;
      ++this->SourceCount;
    }
    if (this->To.plan.sources)
    {
      this->Numbers[vertex] =
        isSource[i] ? this->From.label(this->From.numberOf(block, i), this->From.group(i)) : -1;
    }
  }
}

/** Adds a cell to its chunk, and marks its corners. */
void ChunkWriter::addCell(const std::int64_t* corners)
{
  const ChunkPlan& plan = this->To.plan;
  const int count = cornersOf(plan.cellType);
  const auto [low, high] = std::minmax_element(corners, corners + count);
  if (*high - *low > plan.span)
  {
    // A longer cell could reach over more than one end of a chunk.
    throw Error("the mesh stream is not valid: a cell uses the vertices " + std::to_string(*low) +
                " and " + std::to_string(*high) + ", but its span is said to be " +
                std::to_string(plan.span) + ": convert the mesh again");
  }
  std::uint32_t local[4];
  int sources = 0;
  for (int k = 0; k < count; ++k)
  {
    local[k] = plan.local(corners[k]);
    sources += (this->Marks[corners[k]] & OfRegion) != 0;
  }
  if (this->Facets)
  {
    this->addSourceFacets({ corners, static_cast<std::size_t>(count) });
  }
  if (!std::isinf(plan.within))
  {
    this->noteLongestEdge(corners);
  }
  const std::int64_t chunk = *high / plan.length;
  const bool crosses = *low / plan.length != chunk;
  // Two sources of regions in one cell are the ends of an edge of a curve or surface of sources.
  for (int k = 0; k < count && (crosses || sources > 1); ++k)
  {
    std::uint8_t& mark = this->Marks[corners[k]];
    mark |= sources > 1 && (mark & OfRegion) != 0 ? Straight : 0;
    mark |= !crosses ? 0 : corners[k] / plan.length == chunk ? ReachesBack : ReachesOn;
  }
  // Chunks before To.count() are written already.
  const auto open = static_cast<std::size_t>(chunk - this->To.count());
  if (open >= this->Open.size())
  {
    this->Open.resize(open + 1);
  }
  OpenCells& cells = this->Open[open];
  (crosses ? cells.crossing : cells.inner).add(this->Owner, local, static_cast<std::size_t>(count));
}

/** Of a cell that has other vertices, too: what its vertices of a region span, and points. */
void ChunkWriter::addSourceFacets(std::span<const std::int64_t> corners)
{
  const Ring<std::int64_t>* const labels = this->To.plan.sources ? &this->Numbers : nullptr;
  std::array<std::int64_t, 4> ofRegion{};
  std::size_t count = 0;
  for (const std::int64_t& corner : corners)
  {
    const std::uint8_t mark = this->Marks[corner];
    if ((mark & OfRegion) != 0)
    {
      ofRegion[count++] = corner;
    }
    else if ((mark & Dirty) != 0)
    {
      this->Facets->add({ &corner, 1 }, this->Points, labels);
    }
  }
  if (count > 0 && count < corners.size())
  {
    this->Facets->add(std::span(ofRegion).first(count), this->Points, labels);
  }
}

void ChunkWriter::noteLongestEdge(const std::int64_t* corners)
{
  for (int a = 1; a < cornersOf(this->To.plan.cellType); ++a)
  {
    for (int b = 0; b < a; ++b)
    {
      const Vector edge = difference(this->Points.at(corners[a]), this->Points.at(corners[b]));
      this->To.longestEdge = std::max(this->To.longestEdge, std::sqrt(dot(edge, edge)));
    }
  }
}

/** Writes positions, state and cells of the first open chunk, and releases them. A chunk may be
 * without cells. */
void ChunkWriter::writeChunk(std::int64_t count)
{
  const std::int64_t chunk = this->To.count();
  const std::int64_t first = this->To.firstOf(chunk);
  const std::int64_t cellBytes =
    cornersOf(this->To.plan.cellType) * std::int64_t(sizeof(std::uint32_t));
  this->Row.grow(this->Owner, static_cast<std::size_t>(3 * count) * sizeof(double));
  this->writePositions(chunk, first, count);
  this->writeState(chunk, first, count);
  OpenCells cells;
  if (!this->Open.empty())
  {
    cells = std::move(this->Open.front());
    this->Open.pop_front();
  }
  const auto inner = cells.inner.bytes(), crossing = cells.crossing.bytes();
  this->To.mesh.write(chunk * ChunkedMesh::MeshParts + ChunkedMesh::InnerCells, inner);
  this->To.mesh.write(chunk * ChunkedMesh::MeshParts + ChunkedMesh::CrossingCells, crossing);
  const auto dirty = std::ranges::count_if(
    this->Marks.range(first, first + count), [](std::uint8_t mark) { return (mark & Dirty) != 0; });
  this->To.chunks.push_back({ static_cast<std::int64_t>(inner.size()) / cellBytes,
    static_cast<std::int64_t>(crossing.size()) / cellBytes, dirty });
  this->Points.release(first + count);
  this->Marks.release(first + count);
  this->Numbers.release(first + count);
}

/** In single precision if the mesh has no more, which halves what every pass reads. */
void ChunkWriter::writePositions(std::int64_t chunk, std::int64_t first, std::int64_t count)
{
  const std::int64_t index = chunk * ChunkedMesh::MeshParts + ChunkedMesh::Positions;
  const std::span<double> points = this->Points.range(first, first + count);
  if (!this->To.plan.singlePositions)
  {
    this->To.mesh.write(index, std::as_bytes(points));
    return;
  }
  const std::span<float> single = this->Row.values<float>(3 * count);
  std::ranges::transform(
    points, single.begin(), [](double coordinate) { return static_cast<float>(coordinate); });
  this->To.mesh.write(index, std::as_bytes(single));
}

/** Writes the flags of a chunk; distances and numbers only if it has a source. */
void ChunkWriter::writeState(std::int64_t chunk, std::int64_t first, std::int64_t count)
{
  const std::int64_t index = chunk * ChunkedMesh::StateParts;
  const std::span<std::uint8_t> marks = this->Marks.range(first, first + count);
  this->To.state.write(index + ChunkedMesh::Flags, std::as_bytes(marks));
  // Most chunks have no source, and need no distances yet.
  if (std::ranges::none_of(marks, [](std::uint8_t mark) { return (mark & Dirty) != 0; }))
  {
    return;
  }
  const std::span<double> distances = this->Row.values<double>(count);
  std::ranges::transform(marks, distances.begin(),
    [](std::uint8_t mark)
    { return (mark & Dirty) != 0 ? 0.0 : std::numeric_limits<double>::infinity(); });
  this->To.state.write(index + ChunkedMesh::Distances, std::as_bytes(distances));
  if (this->To.plan.sources)
  {
    this->To.state.write(
      index + ChunkedMesh::Sources, std::as_bytes(this->Numbers.range(first, first + count)));
  }
}

/** Writes the rest of the chunks; the last one may be shorter. */
void ChunkWriter::finish()
{
  const std::int64_t end = this->Points.end();
  while (this->To.firstOf(this->To.count()) < end)
  {
    this->writeChunk(std::min(this->To.plan.length, end - this->To.firstOf(this->To.count())));
  }
  this->To.vertices = end;
}

} // namespace smg
