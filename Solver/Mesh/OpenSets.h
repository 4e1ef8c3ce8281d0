// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>

namespace smg
{

/**
 * Disjoint sets of the open vertices of a mesh stream, each alone at first, with sums over their
 * members (union and find with path halving). A set is represented by its highest vertex, and
 * complete when that is closed. So only open vertices are in memory, however many sets there are,
 * and sums are added in the order of the calls of join(), for any size of blocks.
 *
 * `Sums` is trivially copyable, is nothing if all its bytes are 0, and has `+=`.
 */
template <class Sums>
class OpenSets
{
public:
  explicit OpenSets(Pool& pool)
    : Members(pool)
  {
  }

  /** Adds the vertices up to before `end`. Throws Error if too many are open. */
  void extend(std::int64_t end)
  {
    if (end - this->Members.first() > INT32_MAX)
    {
      throw Error("too many vertices are open at once: convert the mesh with the order bfs");
    }
    this->Members.extend(end);
  }

  /** The vertex that represents the set of an open vertex. */
  std::int64_t find(std::int64_t i)
  {
    while (this->Members[i].up != 0)
    {
      std::uint32_t& up = this->Members[i].up;
      up += this->Members[i + up].up;
      i += up;
    }
    return i;
  }

  /** Joins the sets of two open vertices; returns the vertex that represents the union. */
  std::int64_t join(std::int64_t a, std::int64_t b)
  {
    a = this->find(a);
    b = this->find(b);
    if (a != b)
    {
      Member& low = this->Members[std::min(a, b)];
      low.up = static_cast<std::uint32_t>(std::max(a, b) - std::min(a, b));
      this->Members[std::max(a, b)].sums += low.sums;
    }
    return std::max(a, b);
  }

  /** The sums of the set that this vertex represents. */
  Sums& sums(std::int64_t root) { return this->Members[root].sums; }

  /** Closes the vertices up to before `end`, and calls complete(sums) for each set that ends there,
   * in the order of their highest vertices. */
  template <class Complete>
  void close(std::int64_t end, Complete&& complete)
  {
    for (std::int64_t i = this->Members.first(); i < end; ++i)
    {
      if (const Member& member = this->Members[i]; member.up == 0)
      {
        complete(member.sums);
      }
    }
    this->Members.release(end);
  }
  /** Closes all vertices. */
  template <class Complete>
  void closeAll(Complete&& complete)
  {
    this->close(this->Members.end(), complete);
  }

private:
  struct Member
  {
    std::uint32_t up; ///< distance to a higher vertex of the set; 0: this is the highest
    Sums sums;
  };

  Ring<Member> Members;
};

} // namespace smg
