// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace smg
{

/** An array that grows at its end, in memory that the pool of the workspace accounts for. */
template <class T>
class GrowingArray
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  /** The workspace must outlive the array. */
  explicit GrowingArray(Workspace& workspace)
    : Space(&workspace)
  {
  }

  std::size_t size() const { return this->Size; }
  bool empty() const { return this->Size == 0; }
  T* data() { return reinterpret_cast<T*>(this->Memory.data()); }
  const T* data() const { return reinterpret_cast<const T*>(this->Memory.data()); }
  T& operator[](std::size_t i)
  {
    assert(i < this->Size);
    return this->data()[i];
  }
  const T& operator[](std::size_t i) const
  {
    assert(i < this->Size);
    return this->data()[i];
  }
  std::span<T> all() { return { this->data(), this->Size }; }
  std::span<const T> all() const { return { this->data(), this->Size }; }

  /** Throws Error if the pool has no memory left. */
  void push(const T& value)
  {
    if (this->Size == this->Memory.size() / sizeof(T))
    {
      this->reserve(std::max<std::size_t>(16, this->Size + this->Size / 2));
    }
    this->data()[this->Size++] = value;
  }
  void reserve(std::size_t count)
  {
    if (count > this->Memory.size() / sizeof(T))
    {
      this->Memory.grow(this->Space->pool(), count * sizeof(T));
    }
  }
  /** Removes the elements, but keeps the memory. */
  void clear() { this->Size = 0; }

private:
  Workspace* Space;
  Buffer Memory;
  std::size_t Size = 0;
};

/** Numbers of 1 to 5 bytes, seven bits per byte, the lowest first: small differences are short. */
namespace varint
{

inline std::byte* put(std::byte* to, std::uint32_t value)
{
  for (; value >= 0x80; value >>= 7)
  {
    *to++ = static_cast<std::byte>(value | 0x80);
  }
  *to++ = static_cast<std::byte>(value);
  return to;
}

inline const std::byte* get(const std::byte* from, std::uint32_t& value)
{
  value = static_cast<std::uint32_t>(*from++);
  if (value >= 0x80)
  {
    value &= 0x7f;
    for (int shift = 7;; shift += 7)
    {
      const auto digit = static_cast<std::uint32_t>(*from++);
      value |= (digit & 0x7f) << shift;
      if (digit < 0x80)
      {
        break;
      }
    }
  }
  return from;
}

/** A difference modulo 2^32 as a number that is small if the difference is small, whatever its
 * sign. */
inline std::uint32_t zigzag(std::uint32_t difference)
{
  return (difference << 1) ^ (0u - (difference >> 31));
}
inline std::uint32_t unzigzag(std::uint32_t value)
{
  return (value >> 1) ^ (0u - (value & 1));
}

} // namespace varint

/**
 * A view of a page of vertices in memory, or of its adjacency part. The format: for each vertex the
 * offset of its list (16 bits, or 32 if necessary); the lists, each a degree and the differences of
 * the ranks of the neighbours to that of the vertex, as varints; then the places, the numbers in
 * the raw mesh, and the coordinates. Each part begins at a multiple of 4.
 */
class PageView
{
public:
  /** Lists of more bytes than this have 32-bit offsets. */
  static constexpr std::uint32_t MaxNarrowBytes = 65532;

  static constexpr std::uint32_t rounded(std::uint32_t bytes) { return (bytes + 3) / 4 * 4; }
  static constexpr std::uint32_t narrowOffsetBytes(std::uint32_t vertices)
  {
    return rounded(2 * vertices);
  }

  /** `adjacency`: bytes of the adjacency part, which determine the width of the offsets. */
  PageView(
    std::byte* bytes, std::uint32_t firstRank, std::uint32_t vertices, std::uint32_t adjacency)
    : Bytes(bytes)
    , FirstRank(firstRank)
    , Vertices(vertices)
    , Adjacency(adjacency)
    , Wide(adjacency > narrowOffsetBytes(vertices) + MaxNarrowBytes)
  {
  }

  std::uint32_t firstRank() const { return this->FirstRank; }
  std::uint32_t vertices() const { return this->Vertices; }

  /** Calls visit(rank) for each neighbour of the page's vertex number `vertex`. */
  template <class Visit>
  void neighbours(std::uint32_t vertex, Visit&& visit) const
  {
    const std::uint32_t rank = this->FirstRank + vertex;
    std::uint32_t degree, difference;
    const std::byte* at = varint::get(this->list(vertex), degree);
    for (std::uint32_t i = 0; i < degree; ++i)
    {
      at = varint::get(at, difference);
      visit(rank + varint::unzigzag(difference));
    }
  }

  /** The rest is available only for whole pages. */
  std::span<std::uint32_t> places() const { return { this->numbers(0), this->Vertices }; }
  std::span<const std::uint32_t> ids() const { return { this->numbers(1), this->Vertices }; }
  /** The consecutive coordinates of a vertex: floats or doubles, unaligned. */
  const std::byte* position(std::uint32_t vertex, std::size_t positionBytes) const
  {
    return this->Bytes + this->Adjacency + std::size_t(8) * this->Vertices + vertex * positionBytes;
  }

private:
  const std::byte* list(std::uint32_t vertex) const
  {
    if (this->Wide)
    {
      std::uint32_t begin;
      std::memcpy(&begin, this->Bytes + std::size_t(4) * vertex, 4);
      return this->Bytes + std::size_t(4) * this->Vertices + begin;
    }
    std::uint16_t begin;
    std::memcpy(&begin, this->Bytes + std::size_t(2) * vertex, 2);
    return this->Bytes + narrowOffsetBytes(this->Vertices) + begin;
  }
  std::uint32_t* numbers(std::size_t which) const
  {
    return reinterpret_cast<std::uint32_t*>(this->Bytes + this->Adjacency) + which * this->Vertices;
  }

  std::byte* Bytes;
  std::uint32_t FirstRank, Vertices, Adjacency;
  bool Wide;
};

/**
 * The vertices of a mesh in pages of `pageVertices` along a space-filling curve, in an unnamed
 * scratch file, each page with the adjacency of its vertices. A vertex is known by its *rank*, its
 * number along the curve; page p has the ranks from p * pageVertices on.
 *
 * A page has an adjacency part, which searches read, and behind it the places (32 bits a vertex,
 * NoIndex at first), the numbers in the raw mesh (32 bits a vertex) and the coordinates: see
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
  void close()
  {
    this->flush();
    this->Collecting = Buffer();
  }

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

  /** The number of vertices of the page that have no place yet. */
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
  /** Writes the places of a page, given the bytes of the whole page. */
  void writePlaces(std::int64_t page, std::span<const std::byte> bytes);
  /** A view of the bytes of a page, aligned to 4, or of its adjacency part. */
  PageView view(std::int64_t page, std::byte* bytes) const
  {
    return this->view(page, bytes, this->Directory[std::size_t(page)].adjacency);
  }
  /** The same for a caller that knows adjacencyBytes(page). */
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
