// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Import/RawMeshBuilder.h"

#include <array>
#include <compare>
#include <cstdint>

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

  explicit CornerWelder(RawMeshBuilder& builder);

  /** Adds the next corner. Throws MeshError if a coordinate is not finite. */
  void corner(Point point);

  /** To be called after the last corner: passes the vertices to the builder, and the relation to
   * the numbers returned by next(). */
  void makeVertices();

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

  void makeGroups();

  RawMeshBuilder& Builder;
  std::int64_t Memory;
  std::uint64_t CornerCount = 0;
  std::uint32_t Groups = 0;
  ExternalSort<Corner> Corners;
  ExternalSort<First> Firsts;
  ExternalSort<Member> Members;
};

extern template class CornerWelder<float>;
extern template class CornerWelder<double>;

} // namespace smg
