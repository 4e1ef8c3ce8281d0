// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexPages.h"

#include "IO/External/Relabelling.h"
#include "Solver/Files/Checksum.h"
#include "smg/Error.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

// The file of pages. A page is written once, when its vertices and their neighbours are known;
// later only its places change. Each of its three parts has a checksum in the directory, so that
// the adjacency can be read and verified without the rest, and the places can be rewritten without
// it.
//
// With coordinates in single precision a vertex takes about 30 bytes on surfaces (42 in solids), of
// which about 10 (22) are its adjacency: neighbours are near on the curve, so the differences of
// ranks are short numbers.

namespace smg
{

namespace
{

constexpr std::size_t MinCollectedBytes = std::size_t(256) << 10;
constexpr std::size_t MaxVarintBytes = 5;
constexpr std::size_t PolledBytes = std::size_t(256) << 10;

/** Writes the lists of neighbours behind their offsets, which are 32 bits at first and become 16
 * bits where all lists together are short enough. Returns the bytes of both. */
std::uint32_t putAdjacency(
  std::byte* to, std::uint32_t firstRank, std::span<const VertexPages::Vertex> vertices)
{
  const auto count = static_cast<std::uint32_t>(vertices.size());
  std::byte* const lists = to + std::size_t(4) * count;
  std::byte* end = lists;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const auto begin = static_cast<std::uint32_t>(end - lists);
    std::memcpy(to + std::size_t(4) * i, &begin, 4);
    end = varint::put(end, static_cast<std::uint32_t>(vertices[i].neighbours.size()));
    for (const std::uint32_t rank : vertices[i].neighbours)
    {
      end = varint::put(end, varint::zigzag(rank - (firstRank + i)));
    }
  }
  // What follows are 32-bit numbers, which are read in place.
  while ((end - lists) % 4 != 0)
  {
    *end++ = std::byte(0);
  }
  const auto bytes = static_cast<std::uint32_t>(end - lists);
  if (bytes > PageView::MaxNarrowBytes)
  {
    return 4 * count + bytes;
  }
  for (std::uint32_t i = 0; i < count; ++i)
  {
    // In place: the narrow offset i does not reach the wide offset i + 1, which is still to be
    // read.
    std::uint32_t begin;
    std::memcpy(&begin, to + std::size_t(4) * i, 4);
    const auto narrow = static_cast<std::uint16_t>(begin);
    std::memcpy(to + std::size_t(2) * i, &narrow, 2);
  }
  // Padding has a fixed value, so that the same mesh has the same bytes.
  const std::uint32_t offsets = PageView::narrowOffsetBytes(count);
  std::memset(to + std::size_t(2) * count, 0, offsets - 2 * count);
  std::memmove(to + offsets, lists, bytes);
  return offsets + bytes;
}

template <class Real>
std::byte* putPositions(std::byte* to, std::span<const VertexPages::Vertex> vertices)
{
  for (const VertexPages::Vertex& vertex : vertices)
  {
    const Real position[3] = { static_cast<Real>(vertex.position[0]),
      static_cast<Real>(vertex.position[1]), static_cast<Real>(vertex.position[2]) };
    std::memcpy(to, position, sizeof position);
    to += sizeof position;
  }
  return to;
}

std::byte* putNumbers(std::byte* to, std::span<const VertexPages::Vertex> vertices,
  std::uint32_t VertexPages::Vertex::*number)
{
  for (const VertexPages::Vertex& vertex : vertices)
  {
    std::memcpy(to, &(vertex.*number), sizeof(std::uint32_t));
    to += sizeof(std::uint32_t);
  }
  return to;
}

} // namespace

VertexPages::VertexPages(Workspace& workspace, int pageVertices, bool doublePositions)
  : Space(&workspace)
  , PageVertices(static_cast<std::uint32_t>(pageVertices))
  , DoublePositions(doublePositions)
  , Directory(workspace)
{
  assert(pageVertices > 0);
}

void VertexPages::append(std::span<const Vertex> vertices)
{
  assert(!vertices.empty() && vertices.size() <= this->PageVertices);
  // Only the last page may have fewer vertices: ranks would otherwise not tell the page.
  assert(this->Vertices % this->PageVertices == 0);
  std::size_t numbers = 2 * vertices.size();
  for (const Vertex& vertex : vertices)
  {
    numbers += vertex.neighbours.size();
  }
  // An upper bound of the bytes, so that the page is encoded straight into the buffer.
  const std::size_t most =
    numbers * MaxVarintBytes + vertices.size() * (8 + this->positionBytes()) + 64;
  if (numbers > std::numeric_limits<std::uint32_t>::max() / MaxVarintBytes - 64)
  {
    throw Error("The mesh cannot be ordered: a few of its vertices have " +
                std::to_string(numbers) + " neighbours; remove the cells around them.");
  }
  this->makeRoom(most);
  std::byte* const begin = this->Collecting.data() + this->Collected;
  const std::uint32_t adjacency =
    putAdjacency(begin, static_cast<std::uint32_t>(this->Vertices), vertices);
  std::byte* end = putNumbers(begin + adjacency, vertices, &Vertex::place);
  end = putNumbers(end, vertices, &Vertex::id);
  end = this->DoublePositions ? putPositions<double>(end, vertices)
                              : putPositions<float>(end, vertices);

  const auto unplaced = std::ranges::count(vertices, NoIndex, &Vertex::place);
  std::byte* const places = begin + adjacency;
  std::byte* const rest = places + vertices.size() * sizeof(std::uint32_t);
  this->Directory.push({ this->FileEnd + std::int64_t(this->Collected), adjacency,
    static_cast<std::uint32_t>(unplaced),
    { checksum({ begin, places }), checksum({ places, rest }), checksum({ rest, end }) } });
  const auto bytes = static_cast<std::size_t>(end - begin);
  this->Collected += bytes;
  this->LargestPage = std::max(this->LargestPage, bytes);
  this->AllAdjacencyBytes += adjacency;
  this->Vertices += static_cast<std::int64_t>(vertices.size());
}

void VertexPages::makeRoom(std::size_t bytes)
{
  // Pages are collected and written together; one of a page that is larger than the buffer replaces
  // it.
  if (this->Collected + bytes <= this->Collecting.size())
  {
    return;
  }
  this->flush();
  if (bytes > this->Collecting.size())
  {
    this->Collecting = Buffer();
    this->Collecting = Buffer(this->Space->pool(), std::max(bytes, MinCollectedBytes));
  }
}

void VertexPages::flush()
{
  if (this->Collected == 0)
  {
    return;
  }
  // Created with the first bytes. A small mesh is written only by close(), since reads go to the
  // file.
  if (!this->File.isOpen())
  {
    this->File = FileDescriptor::createNameless(this->Space->folder());
  }
  this->File.write(this->FileEnd, this->Collecting.bytes().first(this->Collected));
  this->Space->traffic().bytesWritten += std::int64_t(this->Collected);
  this->FileEnd += std::int64_t(this->Collected);
  this->Collected = 0;
}

void VertexPages::read(std::int64_t page, std::span<std::byte> bytes)
{
  const Page& where = this->Directory[std::size_t(page)];
  // The size of the span says whether the page or only its adjacency is wanted.
  const bool isWhole = bytes.size() == this->bytes(page);
  assert((isWhole || bytes.size() == where.adjacency) && this->Collected == 0);
  this->File.read(where.offset, bytes);
  const std::size_t rest = where.adjacency + this->placesBytes(page);
  if (checksum(bytes.first(where.adjacency)) != where.sums[0] ||
      (isWhole && (checksum(bytes.first(rest).subspan(where.adjacency)) != where.sums[1] ||
                    checksum(bytes.subspan(rest)) != where.sums[2])))
  {
    throwDamagedBlock(this->File.path(), page);
  }
  this->Space->traffic().bytesRead += std::int64_t(bytes.size());
  // Pages are small, so progress is not reported after each of them.
  this->Unpolled += bytes.size();
  if (this->Unpolled >= PolledBytes)
  {
    this->Unpolled = 0;
    this->Space->poll();
  }
}

/** Writes only the places. The checksum in the directory changes with them, so that the next read
 * is compared with what was written last. */
void VertexPages::writePlaces(std::int64_t page, std::span<const std::byte> bytes)
{
  Page& where = this->Directory[std::size_t(page)];
  const std::span<const std::byte> places = bytes.subspan(where.adjacency, this->placesBytes(page));
  where.sums[1] = checksum(places);
  this->File.write(where.offset + where.adjacency, places);
  this->Space->traffic().bytesWritten += std::int64_t(places.size());
}

} // namespace smg
