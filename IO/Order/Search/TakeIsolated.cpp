// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/TakeIsolated.h"

#include "IO/Order/Pages/RankedVertices.h"
#include "Solver/Mesh/AddedColumn.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The vertices of no cell, which are not part of the stream: one pass over the vertices of the file
// with their columns, in chunks, and a bit per vertex that tells which are used.

namespace smg
{

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
