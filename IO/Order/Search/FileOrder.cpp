// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/FileOrder.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/RankedVertices.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

// The order `keep`: vertices numbered by the first cell of the file that uses them. The first uses
// of all vertices are found with a bit per vertex (UsedVertices), sorted by their place in the
// file, and the places joined with the coordinates through two row tables.
//
// The vertices of no cell, which are not part of a stream: one pass over the vertices of the file
// with their columns, in chunks, and a bit per vertex.

namespace smg
{
namespace
{

/** The place of the first corner in the file that is a given vertex; all corners count, cell by
 * cell. */
struct FirstUse
{
  std::uint64_t corner;
  std::uint32_t id;
  auto operator<=>(const FirstUse&) const = default;
};

/** Stores the position of each used vertex; returns their number. */
std::int64_t putPlaces(const RawMesh& mesh, Workspace& workspace, RowTable& places)
{
  ExternalSort<FirstUse> uses(workspace, workspace.available() / 3);
  UsedVertices(mesh, workspace, workspace.available() / 4)
    .forEachFirstUse(
      [&uses](std::uint64_t corner, std::uint32_t id) {
        uses.put({ corner, id });
      });
  uses.sort();
  std::uint32_t count = 0;
  for (FirstUse use{}; uses.next(use); ++count)
  {
    // Sorted by corner, the uses come in the order of the positions.
    places.put(use.id, std::as_bytes(std::span(&count, 1)));
  }
  places.close();
  return count;
}

template <class Real>
void order(const RawMesh& mesh, Workspace& workspace, OrderedVertices& result)
{
  RowTable places(workspace, mesh.vertices, sizeof(std::uint32_t), workspace.available() / 4);
  result.count = putPlaces(mesh, workspace, places);
  RowTable rows(workspace, result.count, sizeof(OrderedVertex<Real>), workspace.available() / 4);
  OrderedVertex<Real> vertex{ {}, 0, NoIndex };
  BucketFile::Reader positions(mesh.positions);
  for (std::span<const std::byte> bytes; positions.get(vertex.position); ++vertex.id)
  {
    if (bytes.empty())
    {
      bytes = places.read(vertex.id);
    }
    std::uint32_t place = 0;
    std::memcpy(&place, bytes.data(), sizeof(place));
    bytes = bytes.subspan(sizeof(place));
    // Isolated vertices have no place: their row has all bits set.
    if (place != NoIndex)
    {
      rows.put(place, std::as_bytes(std::span(&vertex, 1)));
    }
  }
  rows.close();
  for (std::int64_t first = 0; first < rows.count(); first += rows.range())
  {
    result.records.append(0, rows.read(first));
  }
}

} // namespace

OrderedVertices firstUseOrder(const RawMesh& mesh, Workspace& workspace)
{
  OrderedVertices result(workspace);
  result.doublePositions = mesh.doublePositions;
  mesh.doublePositions ? order<double>(mesh, workspace, result)
                       : order<float>(mesh, workspace, result);
  result.records.close();
  return result;
}

namespace
{

constexpr std::size_t ChunkVertices = 4096;

/** Reads the vertices of a mesh one by one and collects those that are wanted. */
template <class Real>
class VertexCollector
{
public:
  VertexCollector(const RawMesh& mesh, Workspace& workspace, const TakeVertices& take)
    : Take(take)
    , Positions(mesh.positions)
    , Tuples(readersOf(mesh.vertexColumns, workspace.available() / 4))
  {
    for (const RawColumn& column : mesh.vertexColumns)
    {
      this->Chunk.columns.push_back({ column.spec, {} });
    }
    this->IdColumn = findColumn(this->Chunk.columns, OriginalIdSpec);
    if (this->IdColumn < 0)
    {
      this->Chunk.columns.push_back({ OriginalIdSpec, {} });
    }
    this->resize(ChunkVertices);
  }

  /** Reads the next vertex. */
  void read(bool wanted)
  {
    Real position[3];
    this->Positions.get(position);
    for (std::size_t c = 0; c < this->Tuples.size(); ++c)
    {
      // Read in any case, as the file is sequential: unwanted tuples are overwritten by the next
      // ones.
      Column& column = this->Chunk.columns[c];
      const std::size_t bytes = column.spec.tupleBytes();
      this->Tuples[c].read(std::span(column.bytes).subspan(this->Count * bytes, bytes));
    }
    if (wanted)
    {
      std::copy_n(position, 3, &this->Chunk.positions[3 * this->Count]);
      this->Chunk.ids[this->Count] = this->id();
      if (++this->Count == ChunkVertices)
      {
        this->flush();
      }
    }
    ++this->Number;
  }

  /** Passes on the collected vertices. */
  void flush()
  {
    if (this->Count > 0)
    {
      this->resize(this->Count);
      this->Take(this->Chunk);
      this->resize(ChunkVertices);
      this->Count = 0;
    }
  }

private:
  void resize(std::size_t count)
  {
    this->Chunk.ids.resize(count);
    this->Chunk.positions.resize(3 * count);
    for (Column& column : this->Chunk.columns)
    {
      column.resize(count);
    }
  }

  /** The original number of the current vertex; added to a column without it. */
  std::int64_t id()
  {
    if (this->IdColumn < 0)
    {
      this->Chunk.columns.back().template as<std::int64_t>()[this->Count] = this->Number;
      return this->Number;
    }
    const std::int64_t id = this->Chunk.columns[static_cast<std::size_t>(this->IdColumn)]
                              .template as<std::int64_t>()[this->Count];
    // A negative number is not an index in a file: the container gets the number in this file
    // instead.
    return id < 0 ? this->Number : id;
  }

  const TakeVertices& Take;
  BucketFile::Reader Positions;
  std::vector<BucketFile::Reader> Tuples; ///< of each column of the mesh
  IsolatedVertices Chunk;
  std::size_t Count = 0;        ///< vertices of the chunk
  std::ptrdiff_t IdColumn = -1; ///< of the mesh's OriginalId; -1: there is none
  std::int64_t Number = 0;      ///< of the next vertex in the file
};

template <class Real>
void takeUnused(const RawMesh& mesh, Workspace& workspace, const TakeVertices& take)
{
  VertexCollector<Real> collector(mesh, workspace, take);
  UsedVertices used(mesh, workspace, workspace.available() / 2);
  for (std::uint32_t vertex = 0; vertex < mesh.vertices; ++vertex)
  {
    collector.read(!used.contains(vertex));
  }
  collector.flush();
}

} // namespace

void takeIsolatedVertices(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, const TakeVertices& take)
{
  // Otherwise there are none, and nothing needs to be read.
  if (layout.vertexCount < mesh.vertices)
  {
    mesh.doublePositions ? takeUnused<double>(mesh, workspace, take)
                         : takeUnused<float>(mesh, workspace, take);
  }
}

} // namespace smg
