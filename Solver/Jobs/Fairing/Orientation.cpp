// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/Orientation.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Vector.h"
#include "Solver/Mesh/VisitCells.h"
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
//
// Closed bodies that may lie in others need winding numbers. They are counted in a second reading,
// by a ray from each body, as the mesh is wound; only then, the links are read again.

namespace smg
{
namespace
{

std::filesystem::path inFolder(const std::filesystem::path& folder, const char* name)
{
  return (folder.empty() ? std::filesystem::temp_directory_path() : folder) / name;
}

/** Of an edge, the same for all its triangles; the sum of those that run along it from its lower
 * vertex on and the negative ones of the others is 0, but by chance, only if they cancel. */
std::uint64_t hashOf(std::int64_t low, std::int64_t high)
{
  constexpr std::uint64_t Factor = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = static_cast<std::uint64_t>(low) * Factor;
  hash = ((hash ^ hash >> 32) + static_cast<std::uint64_t>(high)) * Factor;
  hash = (hash ^ hash >> 29) * Factor;
  return hash ^ hash >> 32;
}

} // namespace

Orientation::Orientation(Pool& pool, const std::filesystem::path& folder)
  : Memory(pool)
  , Links(inFolder(folder, "links"), this->Traffic)
  , Marks(inFolder(folder, "turned"), this->Traffic)
{
}

void Orientation::find(const std::function<void(const Visit& visit)>& read)
{
  read([this](const MeshBlock& block) { this->add(block); });
  this->finish();
  if (this->mayNest())
  {
    this->beginNesting();
    read([this](const MeshBlock& block) { this->nest(block); });
  }
  this->decide();
  this->resolve();
  this->Written = {};
  this->Bodies = {};
  this->Rays.reset();
  this->Reserved.resize(0);
  this->Points = Ring<double>(this->Memory, 3);
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
  this->OpenEdges.extend(end);
  forAllCells(CellType::Triangle, block,
    [this](const std::int64_t* corners, unsigned flags, std::size_t /*c*/)
    { this->addCell(corners, flags); });
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
    if (point[0] == sums.high[0])
    {
      sums.farthest = { point[1], point[2] };
    }
    this->addEdge(corners[k], corners[(k + 1) % 3], cell);
  }
  sums.volume = dot(points[0], cross(points[1], points[2]));
}

void Orientation::addEdge(std::int64_t a, std::int64_t b, std::int64_t cell)
{
  const std::int64_t low = std::min(a, b), high = std::max(a, b);
  const std::int32_t fresh = this->Edges.take();
  const std::int32_t slot = this->OpenEdges.join(low, high, 0, fresh);
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
  this->Members[cell].sums.rim += a == low ? hashOf(low, high) : -hashOf(low, high);
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
      this->Members[this->rootOf(this->cellOf(edge.cell[0])).cell].sums.hasBoundary = true;
    }
  };
  for (; this->Final < end; ++this->Final)
  {
    this->OpenEdges.take(this->Final, finishEdge);
  }
  this->OpenEdges.release(end);
}

Orientation::Root Orientation::rootOf(std::int64_t cell)
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
  const Root a = this->rootOf(this->cellOf(edge.cell[0]));
  const Root b = this->rootOf(this->cellOf(edge.cell[1]));
  const std::uint8_t areTurned = edge.ascends[0] == edge.ascends[1] ? 1 : 0;
  const auto opposite = static_cast<std::uint8_t>(a.opposite ^ b.opposite ^ areTurned);
  if (a.cell == b.cell)
  {
    this->Members[a.cell].sums.hasContradiction |= opposite != 0;
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
  sums.rim += opposite ? -part.sums.rim : part.sums.rim;
  sums.hasBoundary |= part.sums.hasBoundary;
  sums.hasContradiction |= part.sums.hasContradiction;
  if (part.sums.high[0] > sums.high[0])
  {
    sums.farthest = part.sums.farthest;
  }
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
    return Leave;
  }
  if (sums.hasContradiction)
  {
    ++this->Unorientable;
    return Leave;
  }
  this->keepBody(cell, sums);
  if (sums.rim != 0)
  {
    this->Branched += sums.hasBoundary ? 0 : 1;
    return Open | (2 * sums.opposite > sums.cells ? 1U : 0U);
  }
  // Which of the two ways may depend on other bodies: see decide().
  return 0;
}

void Orientation::keepBody(std::int64_t cell, const Sums& sums)
{
  // Unwelded triangles are bodies, too.
  constexpr std::int64_t Large = 16;
  const bool isClosed = sums.rim == 0;
  if (!isClosed && sums.cells < Large)
  {
    return;
  }
  this->Bodies.push_back(
    { cell, sums.volume, isClosed, sums.opposite == 0, sums.low, sums.high, sums.farthest });
  if (this->Bodies.size() % 1024 == 0)
  {
    this->Reserved.resize(static_cast<std::int64_t>(this->Bodies.capacity() * sizeof(Body)));
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
  this->OpenEdges = OpenFacets(this->Memory);
  this->Edges = FreeList<Edge>(this->Memory);
  this->Members = Ring<Member>(this->Memory);
}

/** Whether closed bodies that may have to be turned may lie in others, or others in them. */
bool Orientation::mayNest() const
{
  return std::ranges::count_if(this->Bodies, &Body::isClosed) > 1 &&
         std::ranges::any_of(this->Bodies,
           [](const Body& body) { return body.isInwards() || (body.isClosed && !body.isAlike); });
}

/** Finds which triangles count, and how they are wound: those of closed bodies as in the mesh, or
 * outwards. */
void Orientation::beginNesting()
{
  this->Rays.emplace();
  for (const Body& body : this->Bodies)
  {
    if (body.isClosed)
    {
      this->Rays->addPoint({ body.high[0], body.farthest[0], body.farthest[1] });
    }
    if (body.isInwards() && !body.isAlike)
    {
      this->TurnedBodies.push_back(body.cell);
    }
  }
  this->Rays->sort();
  this->Reserved.resize(static_cast<std::int64_t>(this->Bodies.capacity()) *
                        (static_cast<std::int64_t>(sizeof(Body)) + WindingRays::RayBytes));
  this->resolve();
  this->TurnedBodies.clear();
  this->Points = Ring<double>(this->Memory, 3);
}

/** Counts the triangles of a block of the second reading. */
void Orientation::nest(const MeshBlock& block)
{
  this->Points.extendRaw(block.firstVertex + block.vertices());
  std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
  std::vector<std::uint8_t> states(block.corners.size() / 3);
  this->readStates(block.firstCell, states);
  const auto point = [this](std::int64_t vertex)
  {
    const double* values = this->Points.at(vertex);
    return Vector{ values[0], values[1], values[2] };
  };
  for (std::size_t c = 0; c < states.size(); ++c)
  {
    if ((states[c] & (Leave | Open)) == 0)
    {
      const std::int64_t* corners = block.corners.data() + 3 * c;
      const bool turns = (states[c] & 1) != 0;
      this->Rays->count(
        point(corners[0]), point(corners[turns ? 2 : 1]), point(corners[turns ? 1 : 2]));
    }
  }
  this->Points.release(block.finalized);
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

/** Which way the closed bodies are to be wound. */
void Orientation::decide()
{
  // Of thousands, a large one contains most: these come first.
  std::vector<const Body*> open, closed;
  for (const Body& body : this->Bodies)
  {
    (body.isClosed ? closed : open).push_back(&body);
  }
  const auto sizeOf = [](const Body* body) { return body->high[0] - body->low[0]; };
  std::ranges::sort(open, std::ranges::greater(), sizeOf);
  std::ranges::sort(closed, std::ranges::greater(), sizeOf);
  const auto isIn = [](const Body& body, const std::vector<const Body*>& others)
  {
    return std::ranges::any_of(
      others, [&body](const Body* other) { return other->contains(body); });
  };
  std::size_t ray = 0;
  for (const Body& body : this->Bodies)
  {
    if (!body.isClosed)
    {
      continue;
    }
    // Bodies that overlap are not in each other.
    std::int64_t outside = this->Rays ? this->Rays->around(ray++) : 0;
    outside = outside != 0 && isIn(body, closed) ? outside : 0;
    bool isCavity = false;
    if (!body.isAlike)
    {
      this->Ambiguous += outside != 0 ? 1 : 0;
    }
    else if (outside != 0)
    {
      const std::int64_t inside = outside + (body.volume < 0.0 ? -1 : 1);
      isCavity = (outside + inside < 0) != body.isInwards();
    }
    else
    {
      // What is inside of an open body is not known.
      isCavity = body.isInwards() && isIn(body, open);
    }
    if (body.isInwards() != isCavity)
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
  this->Turned = 0;
  // The states of the triangles ahead, as far as links reach, in a ring.
  std::size_t size = 1;
  while (size <= this->Longest)
  {
    size *= 2;
  }
  const Reservation ring(this->Memory,
    static_cast<std::int64_t>(size) + BlockCells * static_cast<std::int64_t>(sizeof(Link) + 1));
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
        state = (other & Leave) != 0 ? Leave : other ^ link.state;
      }
      else if (std::ranges::binary_search(this->TurnedBodies, cell))
      {
        state = 1;
      }
      states[static_cast<std::size_t>(cell) % size] = static_cast<std::uint8_t>(state);
      marks[k] = static_cast<std::uint8_t>(state);
      this->Turned += state & 1U;
    }
    this->Marks.write(block, std::as_bytes(std::span(marks)));
  }
}

void Orientation::read(std::int64_t first, std::span<std::uint8_t> marks)
{
  this->readStates(first, marks);
  for (std::uint8_t& mark : marks)
  {
    mark &= 1;
  }
}

void Orientation::readStates(std::int64_t first, std::span<std::uint8_t> states)
{
  std::vector<std::uint8_t> block;
  while (!states.empty())
  {
    const std::int64_t number = first / BlockCells, begin = number * BlockCells;
    block.resize(static_cast<std::size_t>(std::min(BlockCells, this->Cells - begin)));
    this->Marks.read(number, std::as_writable_bytes(std::span(block)));
    const auto from = static_cast<std::size_t>(first - begin);
    const std::size_t count = std::min(states.size(), block.size() - from);
    std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(from), count, states.begin());
    states = states.subspan(count);
    first += static_cast<std::int64_t>(count);
  }
}

} // namespace smg
