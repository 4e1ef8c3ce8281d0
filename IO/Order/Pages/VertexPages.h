// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Order/Pages/GrowingArray.h"
#include "IO/Order/Pages/PageView.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/**
 * The vertices of a mesh in pages of `pageVertices` along a space filling curve, in a scratch file
 * without a name, each page with the adjacency of its vertices. A vertex is known by its *rank*,
 * its number along the curve; page p has the ranks from p * pageVertices on.
 *
 * A page has an adjacency part, which searches read, and after it the places (32 bits a vertex,
 * NoIndex at first), the numbers in the raw mesh (32 bits a vertex), and the coordinates: see
 * PageView.
 */
class VertexPages
{
public:
  /** The workspace must outlive the pages. */
  VertexPages(Workspace& workspace, int pageVertices, bool doublePositions);

  /** The data of a vertex when its page is made. */
  struct Vertex
  {
    double position[3];
    std::uint32_t id;                          ///< number in the raw mesh
    std::uint32_t place;                       ///< NoIndex: none yet
    std::span<const std::uint32_t> neighbours; ///< ranks
  };

  /** Appends the next page: pageVertices vertices, the last page fewer. Throws Error. */
  void append(std::span<const Vertex> vertices);
  /** To be called after the last append(). */
  void close();

  int pageVertices() const { return static_cast<int>(this->PageVertices); }
  bool doublePositions() const { return this->DoublePositions; }
  std::size_t positionBytes() const
  {
    return 3 * (this->DoublePositions ? sizeof(double) : sizeof(float));
  }
  std::int64_t vertices() const { return this->Vertices; }
  std::int64_t pages() const { return static_cast<std::int64_t>(this->Directory.size()); }
  std::uint32_t pageOf(std::uint32_t rank) const { return rank / this->PageVertices; }
  std::uint32_t firstRank(std::int64_t page) const
  {
    return static_cast<std::uint32_t>(page) * this->PageVertices;
  }

  /** The number of vertices of the page without a position. */
  std::uint32_t& unplaced(std::int64_t page) { return this->Directory[std::size_t(page)].unplaced; }
  std::uint32_t verticesOf(std::int64_t page) const
  {
    return static_cast<std::uint32_t>(std::min<std::int64_t>(
      this->PageVertices, this->Vertices - page * std::int64_t(this->PageVertices)));
  }
  /** Bytes of the adjacency part, and of the whole page: multiples of 4. */
  std::size_t adjacencyBytes(std::int64_t page) const
  {
    return this->Directory[std::size_t(page)].adjacency;
  }
  std::size_t bytes(std::int64_t page) const
  {
    return this->adjacencyBytes(page) +
           this->verticesOf(page) * (2 * sizeof(std::uint32_t) + this->positionBytes());
  }
  /** Bytes of the largest page. */
  std::size_t largestPage() const { return this->LargestPage; }
  /** Bytes of all pages, and of their adjacency parts. */
  std::int64_t allBytes() const { return this->FileEnd + std::int64_t(this->Collected); }
  std::int64_t allAdjacencyBytes() const { return this->AllAdjacencyBytes; }

  /** Reads a page, or its adjacency part, into a span of its size. Throws Error, Cancelled. */
  void read(std::int64_t page, std::span<std::byte> bytes);
  /** Writes the positions of a page, given the bytes of the whole page. */
  void writePlaces(std::int64_t page, std::span<const std::byte> bytes);
  /** A view of the bytes of a page, aligned to 4, or of its adjacency part. */
  PageView view(std::int64_t page, std::byte* bytes) const
  {
    return this->view(page, bytes, this->Directory[std::size_t(page)].adjacency);
  }
  /** The same for a caller who remembers adjacencyBytes(page). */
  PageView view(std::int64_t page, std::byte* bytes, std::uint32_t adjacencyBytes) const
  {
    return { bytes, this->firstRank(page), this->verticesOf(page), adjacencyBytes };
  }

private:
  struct Page
  {
    std::int64_t offset;
    std::uint32_t adjacency; ///< bytes
    std::uint32_t unplaced;
    std::uint64_t sums[3]; ///< checksums of the adjacency, the places, the rest
  };

  std::size_t placesBytes(std::int64_t page) const
  {
    return this->verticesOf(page) * sizeof(std::uint32_t);
  }
  void makeRoom(std::size_t bytes);
  void flush();

  Workspace* Space;
  std::uint32_t PageVertices;
  bool DoublePositions;
  std::int64_t Vertices = 0;
  std::size_t LargestPage = 0;
  std::int64_t AllAdjacencyBytes = 0;
  FileDescriptor File;
  std::int64_t FileEnd = 0;
  std::size_t Unpolled = 0; ///< bytes read since the workspace was polled
  Buffer Collecting;        ///< pages not yet in the file
  std::size_t Collected = 0;
  GrowingArray<Page> Directory;
};

} // namespace smg
