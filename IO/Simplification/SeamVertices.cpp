// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SeamVertices.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Files/Checksum.h"
#include "Solver/Mesh/VisitCells.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>
#include <utility>

// The vertices of seams, found by one reading of the stream, and joined in parts of it.
//
// A vertex is on the boundary if its fan of triangles is open: the differences of a hash of the
// neighbours, along each of its triangles, add up to zero around a closed fan. So a number for each
// open vertex suffices. Triangles that are wound against each other do not cancel: such vertices
// count as those of the boundary, which matters only if they coincide with others.
//
// Coordinates are compared by their checksums of 64 bits. Where memory has no room for all, a
// sample is kept that depends on these alone, not on the order of the vertices or on the blocks.

namespace smg
{
namespace
{

std::uint64_t placeOf(const double* point)
{
  // + 0.0 makes -0.0 the same place as 0.0.
  const std::array<double, 3> at{ point[0] + 0.0, point[1] + 0.0, point[2] + 0.0 };
  return checksum(std::as_bytes(std::span(at)));
}

/** A number for each vertex, of which no few have the sum zero. */
std::uint64_t hashOf(std::int64_t vertex)
{
  std::uint64_t hash = static_cast<std::uint64_t>(vertex) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ (hash >> 32)) * 0xd6e8feb86659fd93u;
  return hash ^ (hash >> 32);
}

/** A place of a part: the range of its vertices in a list. */
struct Place
{
  std::size_t begin, end;
  std::size_t first; ///< the one that stands for all: a held one, if there is any
  bool isJoined;     ///< whether all are in the part and none is open
};

/** A vertex that stands for those at its place while seams are joined, and one at it that has
 * triangles. */
using Joined = std::pair<std::uint32_t, std::uint32_t>;

/** All of a part, sorted. */
std::vector<Joined> joinedVertices(const SurfacePart& part, const Poll& poll)
{
  std::vector<Joined> joined;
  for (std::size_t i = 0; i < part.wedges.size(); ++i)
  {
    poll.at(i);
    if (part.joinedIn(part.corners[i]) > 1)
    {
      joined.emplace_back(part.corners[i], part.wedges[i]);
    }
  }
  std::ranges::sort(joined);
  joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
  return joined;
}

/** Calls `visit` for each place of joinedVertices(), with those at it. */
template <class Visit>
void visitPlaces(const std::vector<Joined>& joined, const Visit& visit)
{
  for (std::size_t begin = 0, end = 0; begin < joined.size(); begin = end)
  {
    while (end < joined.size() && joined[end].first == joined[begin].first)
    {
      ++end;
    }
    visit(std::span(joined).subspan(begin, end - begin));
  }
}

/** The vertices of a part that are held or on seams, by their places. */
struct Places
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> vertices;
  std::vector<Place> places;

  Places(const SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll)
  {
    for (std::uint32_t v = 0; v < part.vertices(); ++v)
    {
      poll.at(v);
      if (part.isHeld(v) || part.seamOf(v) > 0)
      {
        this->vertices.emplace_back(placeOf(part.point(v)), v);
      }
    }
    poll.now();
    std::ranges::sort(this->vertices);
    for (std::size_t begin = 0, end = 0; begin < this->vertices.size(); begin = end)
    {
      poll.at(begin);
      Place place{ begin, begin, begin, false };
      std::size_t needed = 0, held = 0;
      bool isOpen = false;
      for (;
           end < this->vertices.size() && this->vertices[end].first == this->vertices[begin].first;
           ++end)
      {
        const std::uint32_t v = this->vertices[end].second;
        needed = std::max<std::size_t>(needed, part.seamOf(v));
        isOpen = isOpen || open[v] != 0;
        place.first = part.isHeld(v) ? end : place.first;
        held += part.isHeld(v) ? 1 : 0;
      }
      place.end = end;
      // One vertex can stand for all: of several that are held each has its own triangles.
      place.isJoined = needed > 0 && needed < SurfacePart::MostOfSeam && !isOpen && held <= 1 &&
                       end - begin >= std::max<std::size_t>(needed, 2);
      this->places.push_back(place);
    }
  }
};

} // namespace

SeamVertices::SeamVertices(Pool& pool, std::int64_t memory)
  : Open(pool, 2)
  , Reserved(pool)
  , Most(static_cast<std::size_t>(memory) / sizeof(Point))
{
}

void SeamVertices::add(const MeshBlock& block)
{
  this->Open.release(this->Final);
  const std::span<std::uint64_t> added = this->Open.append(block.vertices());
  for (std::size_t v = 0; 2 * v < added.size(); ++v)
  {
    added[2 * v + 1] = placeOf(block.positions.data() + 3 * v);
  }
  this->Vertices += block.vertices();
  const Column* flags = block.flags();
  for (std::size_t i = 0; i + 2 < block.corners.size(); i += 3)
  {
    const std::int64_t* c = block.corners.data() + i;
    // As for the parts that are simplified.
    if (isDistinctCell(c, 3, flags ? flags->as<std::uint8_t>()[i / 3] : 0))
    {
      const std::uint64_t hash[3] = { hashOf(c[0]), hashOf(c[1]), hashOf(c[2]) };
      for (std::size_t k = 0; k < 3; ++k)
      {
        *this->Open.at(c[k]) += hash[(k + 1) % 3] - hash[(k + 2) % 3];
      }
    }
  }
  this->close(std::min(block.finalized, this->Vertices));
}

/** Remembers the vertices of the boundary among those that no later cell has. */
void SeamVertices::close(std::int64_t final)
{
  for (; this->Final < final; ++this->Final)
  {
    const std::uint64_t* values = this->Open.at(this->Final);
    if (values[0] != 0 && this->isChosen(values[1]))
    {
      if (this->Boundary.size() == this->Boundary.capacity())
      {
        const std::size_t room = std::max<std::size_t>(1024, 2 * this->Boundary.size());
        this->Reserved.resize(
          static_cast<std::int64_t>(std::min(room, this->Most) * sizeof(Point)));
        this->Boundary.reserve(std::min(room, this->Most));
      }
      this->Boundary.push_back({ values[1], this->Final });
      this->thin();
    }
  }
}

/** Until there is room for one more: all vertices may lie at one place. */
void SeamVertices::thin()
{
  constexpr std::int64_t MaxShift = 62;
  while (this->Boundary.size() >= this->Most && this->Shift < MaxShift)
  {
    ++this->Shift;
    std::erase_if(
      this->Boundary, [this](const Point& point) { return !this->isChosen(point.place); });
  }
  this->Boundary.resize(std::min(this->Boundary.size(), this->Most - 1));
}

void SeamVertices::finish()
{
  this->close(this->Vertices);
  this->Open.restart();
  std::ranges::sort(this->Boundary, [](const Point& a, const Point& b)
    { return a.place != b.place ? a.place < b.place : a.vertex < b.vertex; });
}

std::int64_t SeamVertices::places() const
{
  std::int64_t places = 0;
  for (std::size_t k = 1; k < this->Boundary.size(); ++k)
  {
    // Each place once, at the second of its vertices.
    const std::uint64_t place = this->Boundary[k].place;
    const bool isSecond = place == this->Boundary[k - 1].place;
    places += isSecond && (k == 1 || place != this->Boundary[k - 2].place) ? 1 : 0;
  }
  return places << this->Shift;
}

std::vector<SeamVertices::Seam> SeamVertices::seams() const
{
  std::vector<Seam> seams;
  for (std::size_t begin = 0, end = 0; begin < this->Boundary.size(); begin = end)
  {
    while (end < this->Boundary.size() && this->Boundary[end].place == this->Boundary[begin].place)
    {
      ++end;
    }
    for (std::size_t k = begin; k < end && end - begin > 1; ++k)
    {
      seams.push_back({ this->Boundary[k].vertex, static_cast<std::int64_t>(end - begin) });
    }
  }
  std::ranges::sort(seams, {}, &Seam::vertex);
  return seams;
}

void joinSeams(SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll)
{
  if (!part.marksHeld)
  {
    return;
  }
  const Places all(part, open, poll);
  if (std::ranges::none_of(all.places, &Place::isJoined))
  {
    return;
  }
  std::vector<std::uint32_t> first(part.vertices(), std::numeric_limits<std::uint32_t>::max());
  part.atPlace.assign(part.vertices(), 1);
  for (const Place& place : all.places)
  {
    if (!place.isJoined)
    {
      continue;
    }
    const std::uint32_t one = all.vertices[place.first].second;
    part.atPlace[one] = static_cast<std::uint8_t>(
      std::min<std::size_t>(place.end - place.begin, SurfacePart::MostOfSeam));
    for (std::size_t k = place.begin; k < place.end; ++k)
    {
      const std::uint32_t v = all.vertices[k].second;
      first[v] = one;
      if (v != one && !part.quadrics.empty())
      {
        part.quadrics[one].add(std::exchange(part.quadrics[v], {}));
        part.lacksBoundary[one] |= part.lacksBoundary[v];
      }
    }
  }
  part.wedges = part.corners;
  for (std::size_t i = 0; i < part.corners.size(); ++i)
  {
    poll.at(i);
    const std::uint32_t joined = first[part.corners[i]];
    part.corners[i] = joined < part.vertices() ? joined : part.corners[i];
  }
}

std::size_t weldSeams(SurfacePart& part, std::size_t most, const Poll& poll)
{
  std::size_t gone = 0;
  visitPlaces(joinedVertices(part, poll),
    [&](std::span<const Joined> place)
    {
      const std::uint32_t one = place.front().first;
      if (gone < most)
      {
        part.atPlace[one] = 1;
        part.setSeam(one, 0);
        gone += place.size() - 1;
      }
    });
  for (std::size_t i = 0; i < part.wedges.size(); ++i)
  {
    poll.at(i);
    part.wedges[i] = part.joinedIn(part.corners[i]) == 1 ? part.corners[i] : part.wedges[i];
  }
  return gone;
}

void separateSeams(SurfacePart& part)
{
  if (!part.wedges.empty())
  {
    std::unordered_map<std::uint32_t, std::uint32_t> after;
    visitPlaces(joinedVertices(part, Poll()),
      [&](std::span<const Joined> place)
      {
        // The vertex that stands for the place may have no triangles left itself. If it is held it
        // gets those of another one.
        const auto [one, next] = place.front();
        const bool isUsed = std::ranges::find(place, one, &Joined::second) != place.end();
        if (!isUsed && part.isHeld(one))
        {
          after[next] = one;
        }
        else if (!isUsed && !part.quadrics.empty())
        {
          part.quadrics[next] = part.quadrics[one];
          part.lacksBoundary[next] = part.lacksBoundary[one];
        }
        for (const Joined& each : place)
        {
          if (part.seamOf(each.second) > place.size())
          {
            part.setSeam(each.second, place.size());
          }
        }
      });
    for (std::size_t i = 0; i < part.wedges.size() && !after.empty(); ++i)
    {
      const auto found = after.find(part.wedges[i]);
      part.wedges[i] = found == after.end() ? part.wedges[i] : found->second;
    }
    part.corners = std::move(part.wedges);
    part.wedges.clear();
  }
  part.atPlace.clear();
}

std::vector<std::uint8_t> heldVertices(
  const SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll)
{
  std::vector<std::uint8_t> held(part.vertices(), 0);
  if (!part.marksHeld)
  {
    return held;
  }
  const Places all(part, open, poll);
  for (const Place& place : all.places)
  {
    for (std::size_t k = place.begin; k < place.end; ++k)
    {
      const std::uint32_t v = all.vertices[k].second;
      held[v] = part.isHeld(v) || !place.isJoined ? 1 : 0;
    }
  }
  return held;
}

void forgetSeams(SurfacePart& part, const Poll& poll)
{
  const std::vector<std::uint8_t> none(part.vertices(), 0);
  const Places all(part, none, poll);
  for (const Place& place : all.places)
  {
    Quadric sum;
    for (std::size_t k = place.begin; k < place.end; ++k)
    {
      sum.add(part.quadrics[all.vertices[k].second]);
    }
    for (std::size_t k = place.begin; k < place.end; ++k)
    {
      const std::uint32_t v = all.vertices[k].second;
      if (part.seamOf(v) > 0)
      {
        // Each side has that of the place, which one of them had for all.
        part.quadrics[v] = sum;
        part.setSeam(v, 0);
      }
    }
  }
}

} // namespace smg
