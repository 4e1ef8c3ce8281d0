// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Storage/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The vertices of a mesh in pages of `pageVertices` along a space filling curve, in a scratch file
 * without a name, each page with the adjacency of its vertices. A vertex is known by its *rank*,
 * its number along the curve; page p has the ranks from p * pageVertices on.
 *
 * A page has an adjacency part, which searches read, and after it the places (32 bits a vertex,
 * NoIndex at first), the numbers in the raw mesh (32 bits a vertex), and the coordinates.
 */
class VertexPages
{
public:
  VertexPages(Workspace& workspace, int pageVertices, bool doublePositions);

  /** What is known of a vertex when its page is made. */
  struct Vertex
  {
    double position[3];
    std::uint32_t id;                          ///< number in the raw mesh
    std::uint32_t place;                       ///< NoIndex: has none yet
    std::span<const std::uint32_t> neighbours; ///< ranks
  };

  /** Appends the next page: pageVertices vertices, the last page fewer. */
  void append(std::span<const Vertex> vertices);
  /** Ends the appending. */
  void close();

  int pageVertices() const { return this->PageVertices; }
  bool doublePositions() const { return this->DoublePositions; }
  std::int64_t vertices() const { return this->Vertices; }
  std::int64_t pages() const { return static_cast<std::int64_t>(this->Directory.size()); }

  /** Vertices of the page that have no place. */
  std::uint32_t& unplaced(std::int64_t page) { return this->Directory[std::size_t(page)].unplaced; }
  std::uint32_t verticesOf(std::int64_t page) const;
  /** Bytes of the adjacency part, and of the whole page. */
  std::size_t adjacencyBytes(std::int64_t page) const;
  std::size_t bytes(std::int64_t page) const;

  /** Reads the beginning of a page, as many bytes as the span has. */
  void read(std::int64_t page, std::span<std::byte> bytes);
  /** Writes the places of a page, which stand in the bytes of the whole page. */
  void writePlaces(std::int64_t page, std::span<const std::byte> bytes);

  /** Appends the neighbours (ranks) of a vertex of the page to `ranks`. */
  void neighbours(std::int64_t page, std::span<const std::byte> bytes, std::uint32_t vertex,
    std::vector<std::uint32_t>& ranks) const;
  std::span<std::uint32_t> places(std::int64_t page, std::span<std::byte> bytes) const;
  std::span<const std::uint32_t> ids(std::int64_t page, std::span<const std::byte> bytes) const;
  /** Coordinates of the page's vertices, floats or doubles as doublePositions() says. */
  std::span<const std::byte> positions(std::int64_t page, std::span<const std::byte> bytes) const;

private:
  struct Page
  {
    std::int64_t offset;
    std::uint32_t adjacency; ///< bytes
    std::uint32_t unplaced;
  };

  Workspace& Space;
  int PageVertices;
  bool DoublePositions;
  std::int64_t Vertices = 0;
  FileDescriptor File;
  std::int64_t FileEnd = 0;
  std::vector<Page> Directory;
};

} // namespace smg
