// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Import/RawMeshBuilder.h"

#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <utility>

namespace smg
{

/**
 * Makes one vertex of all corners with the same coordinates, out of core. Vertices are numbered by
 * their first corners. T: the type of the coordinates, float or double.
 *
 * The corners are sorted by their coordinates, where equal ones form a group. The groups' first
 * corners, sorted, give the vertices; the corners, sorted back, name their groups, for which the
 * builder puts the vertices in the end.
 */
template <class T>
class CornerWelder
{
public:
  using Point = std::array<T, 3>;

  explicit CornerWelder(RawMeshBuilder& builder)
    : Builder(builder)
    , Memory(builder.workspace().available())
    , Corners(builder.workspace(), this->Memory * 3 / 10)
    , Firsts(builder.workspace(), this->Memory / 10)
    , Members(builder.workspace(), this->Memory * 3 / 10)
  {
  }

  /** Adds the next corner. Throws MeshError if a coordinate is not finite. */
  void corner(Point point)
  {
    for (T& coordinate : point)
    {
      if (!std::isfinite(coordinate))
      {
        throw MeshError("a coordinate is not finite");
      }
      coordinate += T(0); // -0 becomes 0
    }
    Corner corner;
    corner.bits = std::bit_cast<Bits>(point);
    corner.number = { static_cast<std::uint32_t>(this->CornerCount >> 32),
      static_cast<std::uint32_t>(this->CornerCount) };
    ++this->CornerCount;
    this->Corners.put(corner);
  }

  /** To be called after the last corner: passes the vertices to the builder, and the relation to
   * the numbers returned by next(). */
  void makeVertices()
  {
    this->makeGroups();
    this->Firsts.sort();
    Relabelling vertices(this->Builder.workspace(), this->Groups, this->Memory / 2);
    for (First first; this->Firsts.next(first);)
    {
      vertices.put(first.group, static_cast<std::uint32_t>(this->Builder.vertices()));
      const Point point = std::bit_cast<Point>(first.bits);
      this->Builder.vertex(point[0], point[1], point[2]);
    }
    this->Builder.relabelCorners(std::move(vertices));
    this->Members.sort();
  }

  /** The number of the next corner, in the order of the corners; to be called once for each. */
  std::int64_t next()
  {
    Member member{};
    this->Members.next(member);
    return member.group;
  }

private:
  /** The number of a corner, in two parts to avoid padding in records. */
  struct CornerNumber
  {
    std::uint32_t high, low;
    auto operator<=>(const CornerNumber&) const = default;
  };
  /** The bits of the coordinates of a point. */
  using Bits = std::array<std::uint32_t, sizeof(Point) / sizeof(std::uint32_t)>;
  struct Corner
  {
    Bits bits;
    CornerNumber number;
    auto operator<=>(const Corner&) const = default;
  };
  /** The first corner of a group. */
  struct First
  {
    CornerNumber number;
    std::uint32_t group;
    Bits bits;
    auto operator<=>(const First&) const = default;
  };
  /** A corner and its group. */
  struct Member
  {
    CornerNumber number;
    std::uint32_t group;
    auto operator<=>(const Member&) const = default;
  };

  void makeGroups()
  {
    this->Corners.sort();
    Bits bits{};
    for (Corner corner; this->Corners.next(corner);)
    {
      if (this->Groups == 0 || corner.bits != bits)
      {
        if (this->Groups == NoIndex - 1)
        {
          throw MeshError("the mesh has more than 4294967294 vertices, which are too many");
        }
        bits = corner.bits;
        this->Firsts.put({ corner.number, this->Groups++, bits });
      }
      this->Members.put({ corner.number, this->Groups - 1 });
    }
  }

  RawMeshBuilder& Builder;
  std::int64_t Memory;
  std::uint64_t CornerCount = 0;
  std::uint32_t Groups = 0;
  ExternalSort<Corner> Corners;
  ExternalSort<First> Firsts;
  ExternalSort<Member> Members;
};

} // namespace smg
