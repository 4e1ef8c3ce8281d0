// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/Orientation.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Vector.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

// The winding of a surface in its stream. Triangles that share an edge are wound alike if they run
// along it in opposite directions. Open triangles are sets, joined by edges as they become final,
// with a bit that says whether a triangle is wound the other way than the one that represents its
// set: union and find with parity. The last triangle of a set represents it, so that a triangle,
// when its edges are final, refers to a later one, or is the last one of its body, of which all is
// known then.
//
// These links go to a file, which is read backwards once: each refers to a triangle that has been
// decided. The memory has the open triangles and edges, the closed bodies, and bytes as far as
// links reach; the time is nearly linear.

namespace smg
{
namespace
{

std::filesystem::path inFolder(const std::filesystem::path& folder, const char* name)
{
  return (folder.empty() ? std::filesystem::temp_directory_path() : folder) / name;
}

} // namespace

Orientation::Orientation(Pool& pool, const std::filesystem::path& folder)
  : Memory(pool)
  , Points(pool, 3)
  , Open(pool)
  , Edges(pool)
  , Members(pool)
  , Links(inFolder(folder, "links"), this->Traffic)
  , Marks(inFolder(folder, "turned"), this->Traffic)
  , Kept(pool)
{
}

void Orientation::add(const MeshBlock& block)
{
  if (block.firstVertex == 0 && block.vertices() > 0)
  {
    std::copy_n(block.positions.begin(), 3, this->Origin.begin());
  }
  const std::int64_t end = block.firstVertex + block.vertices();
  this->Points.extendRaw(end);
  std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
  this->Open.extend(end);
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < block.corners.size() / 3; ++c)
  {
    this->addCell(
      block.corners.data() + 3 * c, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
  }
  this->finishVertices(block.finalized);
  this->closeCells(block.finalized, false);
}

/** Duplicates and triangles that use a vertex twice are in no body. */
void Orientation::addCell(const std::int64_t* corners, unsigned flags)
{
  const std::int64_t cell = this->Cells++;
  if (this->Cells - this->Members.first() > INT32_MAX)
  {
    throw Error("too many cells are open at once: convert the mesh with the order bfs");
  }
  this->Members.extend(this->Cells);
  Member& member = this->Members[cell];
  std::int64_t sorted[3] = { corners[0], corners[1], corners[2] };
  std::ranges::sort(sorted);
  member.reach = static_cast<std::uint32_t>(sorted[1]);
  if (!isDistinctCell(corners, 3, flags))
  {
    return;
  }
  Sums& sums = member.sums;
  sums.cells = 1;
  Vector points[3];
  constexpr double Far = std::numeric_limits<double>::infinity();
  sums.low = { Far, Far, Far };
  sums.high = { -Far, -Far, -Far };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double* point = this->Points.at(corners[k]);
    points[k] = difference(point, this->Origin.data());
    for (std::size_t d = 0; d < 3; ++d)
    {
      sums.low[d] = std::min(sums.low[d], point[d]);
      sums.high[d] = std::max(sums.high[d], point[d]);
    }
    this->addEdge(corners[k], corners[(k + 1) % 3], cell);
  }
  sums.volume = dot(points[0], cross(points[1], points[2]));
}

void Orientation::addEdge(std::int64_t a, std::int64_t b, std::int64_t cell)
{
  const std::int64_t low = std::min(a, b), high = std::max(a, b);
  const std::int32_t fresh = this->Edges.take();
  const std::int32_t slot = this->Open.join(low, high, 0, fresh);
  Edge& edge = this->Edges[slot];
  if (slot == fresh)
  {
    edge = {};
  }
  else
  {
    this->Edges.give(fresh);
  }
  if (edge.count < 2)
  {
    edge.cell[edge.count] = static_cast<std::uint32_t>(cell);
    edge.ascends[edge.count] = a == low ? 1 : 0;
  }
  edge.count = static_cast<std::uint8_t>(std::min(3, edge.count + 1));
}

/** The open triangle with these low bits of its number. */
std::int64_t Orientation::cellOf(std::uint32_t low) const
{
  const std::int64_t first = this->Members.first();
  return first + (low - static_cast<std::uint32_t>(first));
}

/** Finishes the edges whose lower vertex is final. */
void Orientation::finishVertices(std::int64_t end)
{
  const auto finishEdge = [this](std::int64_t /*high*/, std::int64_t /*none*/, std::int32_t slot)
  {
    const Edge edge = this->Edges[slot];
    this->Edges.give(slot);
    if (edge.count == 2)
    {
      this->relate(edge);
    }
    else if (edge.count == 1)
    {
      ++this->Members[this->find(this->cellOf(edge.cell[0])).cell].sums.boundary;
    }
  };
  for (; this->Final < end; ++this->Final)
  {
    this->Open.take(this->Final, finishEdge);
  }
  this->Open.release(end);
}

Orientation::Root Orientation::find(std::int64_t cell)
{
  std::uint8_t opposite = 0;
  while (this->Members[cell].up != 0)
  {
    Member& member = this->Members[cell];
    // Halves the path.
    if (const Member& next = this->Members[cell + member.up]; next.up != 0)
    {
      member.opposite ^= next.opposite;
      member.up += next.up;
    }
    opposite ^= member.opposite;
    cell += member.up;
  }
  return { cell, opposite };
}

/** Joins the sets of two triangles that share an edge. */
void Orientation::relate(const Edge& edge)
{
  const Root a = this->find(this->cellOf(edge.cell[0])), b = this->find(this->cellOf(edge.cell[1]));
  const std::uint8_t areTurned = edge.ascends[0] == edge.ascends[1] ? 1 : 0;
  const auto opposite = static_cast<std::uint8_t>(a.opposite ^ b.opposite ^ areTurned);
  if (a.cell == b.cell)
  {
    this->Members[a.cell].sums.contradictions += opposite;
    return;
  }
  const std::int64_t low = std::min(a.cell, b.cell), high = std::max(a.cell, b.cell);
  Member& part = this->Members[low];
  part.up = static_cast<std::uint32_t>(high - low);
  part.opposite = opposite;
  Sums& sums = this->Members[high].sums;
  sums.volume += opposite ? -part.sums.volume : part.sums.volume;
  sums.opposite += opposite ? part.sums.cells - part.sums.opposite : part.sums.opposite;
  sums.cells += part.sums.cells;
  sums.boundary += part.sums.boundary;
  sums.contradictions += part.sums.contradictions;
  for (std::size_t d = 0; d < 3; ++d)
  {
    sums.low[d] = std::min(sums.low[d], part.sums.low[d]);
    sums.high[d] = std::max(sums.high[d], part.sums.high[d]);
  }
}

/** Closes the first triangles all of whose edges are final: those whose second corner is; in the
 * end all. */
void Orientation::closeCells(std::int64_t finalized, bool all)
{
  const auto before = static_cast<std::uint32_t>(finalized);
  std::int64_t cell = this->Members.first();
  for (; cell < this->Cells; ++cell)
  {
    const Member& member = this->Members[cell];
    // Open vertices differ by less than 2^31.
    if (!all && static_cast<std::int32_t>(member.reach - before) >= 0)
    {
      break;
    }
    this->Longest = std::max(this->Longest, member.up);
    this->write(member.up != 0 ? Link{ member.up, member.opposite }
                               : Link{ 0, this->closeBody(cell, member.sums) });
  }
  this->Members.release(cell);
  this->Points.release(finalized);
}

/** What becomes of the triangle that represents a body. */
std::uint32_t Orientation::closeBody(std::int64_t cell, const Sums& sums)
{
  if (sums.cells == 0)
  {
    return 0;
  }
  if (sums.contradictions > 0)
  {
    ++this->Unorientable;
    return Leave;
  }
  this->keepBody(cell, sums);
  if (sums.boundary > 0)
  {
    ++this->OpenBodies;
    return 2 * sums.opposite > sums.cells ? 1 : 0;
  }
  // Which of the two ways may depend on other bodies: see decideCavities().
  return 0;
}

void Orientation::keepBody(std::int64_t cell, const Sums& sums)
{
  // Unwelded triangles are bodies, too.
  constexpr std::int64_t Large = 16;
  const bool isClosed = sums.boundary == 0;
  if (!isClosed && sums.cells < Large)
  {
    return;
  }
  this->Bodies.push_back({ cell, sums.volume, isClosed,
    isClosed && sums.volume < 0.0 && sums.opposite == 0, sums.low, sums.high });
  if (this->Bodies.size() % 1024 == 0)
  {
    this->Kept.resize(static_cast<std::int64_t>(this->Bodies.capacity() * sizeof(Body)));
  }
}

void Orientation::write(Link link)
{
  this->Written.push_back(link);
  if (this->Written.size() == static_cast<std::size_t>(BlockCells))
  {
    this->flush();
  }
}

void Orientation::flush()
{
  this->Links.write(this->Block++, std::as_bytes(std::span(this->Written)));
  this->Written.clear();
}

void Orientation::finish()
{
  this->finishVertices(this->Points.end());
  this->closeCells(this->Points.end(), true);
  if (!this->Written.empty())
  {
    this->flush();
  }
  this->decideCavities();
  this->resolve();
}

/** Whether another body, which is closed, lies within the bounds of this one, a larger one. */
bool Orientation::Body::contains(const Body& other) const
{
  bool isInside = !this->isClosed || std::fabs(this->volume) > std::fabs(other.volume);
  for (std::size_t d = 0; d < 3; ++d)
  {
    isInside = isInside && this->low[d] < other.low[d] && other.high[d] < this->high[d];
  }
  return isInside;
}

/** Closed bodies are to be wound outwards, but for those that may be cavities: they were wound
 * inwards throughout, and lie within the bounds of a larger one. */
void Orientation::decideCavities()
{
  // Of thousands, a large one contains most: these come first.
  std::vector<const Body*> bySize;
  for (const Body& body : this->Bodies)
  {
    bySize.push_back(&body);
  }
  const auto sizeOf = [](const Body* body) { return body->high[0] - body->low[0]; };
  std::ranges::sort(bySize, std::ranges::greater(), sizeOf);
  for (const Body& body : this->Bodies)
  {
    if (!body.isClosed)
    {
      continue;
    }
    const bool isCavity = body.mayBeCavity && std::ranges::any_of(bySize, [&body](const Body* other)
                                                { return other->contains(body); });
    if (body.volume < 0.0 && !isCavity)
    {
      this->TurnedBodies.push_back(body.cell);
    }
    this->Volume += (isCavity ? -1.0 : 1.0) * std::fabs(body.volume) / 6.0;
    this->Cavities += isCavity ? std::fabs(body.volume) / 6.0 : 0.0;
  }
  std::ranges::sort(this->TurnedBodies);
}

/** Reads the links backwards: what they refer to has been decided. */
void Orientation::resolve()
{
  // The states of the triangles ahead, as far as links reach, in a ring.
  std::size_t size = 1;
  while (size <= this->Longest)
  {
    size *= 2;
  }
  this->Kept.resize(this->Kept.bytes() + static_cast<std::int64_t>(size) +
                    BlockCells * static_cast<std::int64_t>(sizeof(Link) + 1));
  std::vector<std::uint8_t> states(size);
  std::vector<std::uint8_t> marks;
  for (std::int64_t block = (this->Cells + BlockCells - 1) / BlockCells - 1; block >= 0; --block)
  {
    const std::int64_t first = block * BlockCells;
    const auto count = static_cast<std::size_t>(std::min(BlockCells, this->Cells - first));
    this->Written.resize(count);
    this->Links.read(block, std::as_writable_bytes(std::span(this->Written)));
    marks.resize(count);
    for (std::size_t k = count; k-- > 0;)
    {
      const std::int64_t cell = first + static_cast<std::int64_t>(k);
      const Link link = this->Written[k];
      std::uint32_t state = link.state;
      if (link.up != 0)
      {
        const std::uint8_t other = states[static_cast<std::size_t>(cell + link.up) % size];
        state = other == Leave ? Leave : other ^ link.state;
      }
      else if (std::ranges::binary_search(this->TurnedBodies, cell))
      {
        state = 1;
      }
      states[static_cast<std::size_t>(cell) % size] = static_cast<std::uint8_t>(state);
      marks[k] = state == 1 ? 1 : 0;
      this->Turned += marks[k];
    }
    this->Marks.write(block, std::as_bytes(std::span(marks)));
  }
  this->Written = {};
  this->Bodies = {};
  this->Kept.resize(0);
  this->Points = Ring<double>(this->Memory, 3);
  this->Open = OpenFacets(this->Memory);
  this->Edges = Slots<Edge>(this->Memory);
  this->Members = Ring<Member>(this->Memory);
}

void Orientation::read(std::int64_t first, std::span<std::uint8_t> marks)
{
  std::vector<std::uint8_t> block;
  while (!marks.empty())
  {
    const std::int64_t number = first / BlockCells, begin = number * BlockCells;
    block.resize(static_cast<std::size_t>(std::min(BlockCells, this->Cells - begin)));
    this->Marks.read(number, std::as_writable_bytes(std::span(block)));
    const auto from = static_cast<std::size_t>(first - begin);
    const std::size_t count = std::min(marks.size(), block.size() - from);
    std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(from), count, marks.begin());
    marks = marks.subspan(count);
    first += static_cast<std::int64_t>(count);
  }
}

} // namespace smg
