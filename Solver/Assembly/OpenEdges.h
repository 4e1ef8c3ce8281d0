// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Lanes.h"
#include "Solver/Memory/Reservation.h"
#include "Solver/Memory/Ring.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace smg
{

/** An edge of a vertex to the neighbour `to`, with the summed weight of its cells. */
struct OpenEdge
{
  std::int64_t to;
  double weight;
};

/**
 * The edges of the vertices that are not final yet. The lower vertex of an edge stores it; when
 * that vertex is taken, the edge is passed to the upper one, which thus has its edges to lower
 * vertices in ascending order, and searches only among those to higher vertices. Each vertex has
 * room for a usual number of neighbours; additional ones are stored in a separate table.
 */
class OpenEdges
{
public:
  /** The maximum number of neighbours in a usual mesh. */
  static constexpr int usual(CellType type) { return type == CellType::Triangle ? 12 : 24; }

  /** `usual` is the number of neighbours that a vertex has room for, 4 to 255. */
  OpenEdges(Pool& pool, int usual)
    : To(pool, usual)
    , Weight(pool, usual)
    , Counts(pool)
    , Searched(usual > 2 * Group ? 2 * Group : Group)
    , MoreMemory(pool)
  {
  }

  /** Throws Error if more vertices are open than their low 32 bits distinguish. */
  void extend(std::int64_t vertices)
  {
    if (vertices - this->To.first() > INT32_MAX)
    {
      throw Error("too many vertices are open at once: convert the mesh with the order bfs");
    }
    this->To.extendRaw(vertices);
    this->Weight.extendRaw(vertices);
    this->Counts.extend(vertices);
  }
  void release(std::int64_t first)
  {
    this->To.release(first);
    this->Weight.release(first);
    this->Counts.release(first);
    this->MoreMemory.resize(this->moreBytes());
  }

  /** The weight of the edge between two open vertices, which is created with 0 if it does not
   * exist. */
  double& weight(std::int64_t a, std::int64_t b)
  {
    const std::int64_t from = std::min(a, b);
    const std::int64_t to = std::max(a, b);
    const auto low = static_cast<std::uint32_t>(to);
    std::uint32_t* list = this->To.at(from);
    Count& count = this->Counts[from];
    for (int first = 0; first < count.upper; first += this->Searched)
    {
      const std::uint32_t found = this->matches(list + first, low, count.upper - first);
      if (found != 0)
      {
        return this->Weight.at(from)[first + std::countr_zero(found)];
      }
    }
    if (this->hasRoom(count))
    {
      double& weight = this->Weight.at(from)[count.upper];
      list[count.upper++] = low;
      return weight = 0.0;
    }
    return this->aside(from, to);
  }

  /** Calls visit(to, weight) for the edges of vertex `from` to higher vertices, in any order; the
   * weight may be changed. */
  template <class Visit>
  void visit(std::int64_t from, Visit&& visit)
  {
    const std::uint32_t* list = this->To.at(from);
    for (int e = 0; e < this->Counts[from].upper; ++e)
    {
      visit(from + (list[e] - static_cast<std::uint32_t>(from)), this->Weight.at(from)[e]);
    }
    if (const auto more = this->More.find(from); more != this->More.end())
    {
      for (auto& [to, weight] : more->second)
      {
        if (to > from)
        {
          visit(to, weight);
        }
      }
    }
  }

  /** Moves the edges of vertex `from`, the lowest open one, to the end of `edges`, by ascending
   * neighbour. */
  void take(std::int64_t from, std::vector<OpenEdge>& edges)
  {
    const Count count = this->Counts[from];
    if (this->hasRoom(count))
    {
      this->takeListed(from, count, edges);
      return;
    }
    const auto before = static_cast<std::ptrdiff_t>(edges.size());
    const int lanes = this->To.lanes();
    for (int e = 0; e < lanes; ++e)
    {
      // The list has no gap. Distances may be negative.
      const auto distance =
        static_cast<std::int32_t>(this->To.at(from)[e] - static_cast<std::uint32_t>(from));
      edges.push_back({ from + distance, this->Weight.at(from)[e] });
    }
    if (const auto more = this->More.find(from); more != this->More.end())
    {
      for (const auto& [to, aside] : more->second)
      {
        edges.push_back({ to, aside });
      }
      this->MoreEdges -= static_cast<std::int64_t>(more->second.size());
      this->More.erase(more);
    }
    const auto taken = std::ranges::subrange(edges.begin() + before, edges.end());
    std::ranges::sort(taken, {}, &OpenEdge::to);
    for (const OpenEdge& edge : taken)
    {
      if (edge.to > from)
      {
        this->handOn(from, edge);
      }
    }
  }

private:
  struct Count
  {
    std::uint8_t upper; ///< to higher vertices, from the begin of a list
    std::uint8_t lower; ///< to lower vertices, from the end of a list
  };

  static constexpr int Group = 8;

  /** The positions of `low` among the first `count` values, as bits of the first `Searched` of
   * them. All of these are compared: the end of a search is unpredictable for branches. */
  std::uint32_t matches(const std::uint32_t* list, std::uint32_t low, int count) const
  {
    std::uint32_t bits = matches(list, low);
    if (this->Searched > Group)
    {
      bits |= matches(list + Group, low) << Group;
    }
    return count < this->Searched ? bits & ((1U << count) - 1U) : bits;
  }
  static std::uint32_t matches(const std::uint32_t* list, std::uint32_t low)
  {
    using Half = Lanes<std::uint32_t, Group / 2>;
    constexpr Half::Vector Low = { 1, 2, 4, 8 }, High = { 16, 32, 64, 128 };
    const auto lower = (Half::Vector)(Half::load(list) == low) & Low;
    const auto upper = (Half::Vector)(Half::load(list + Group / 2) == low) & High;
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lower | upper);
    const std::uint64_t pair = halves[0] | halves[1];
    return static_cast<std::uint32_t>(pair | pair >> 32);
  }

  bool hasRoom(Count count) const { return count.upper + count.lower < this->To.lanes(); }

  /** take() for a vertex all of whose edges are in its list: the lower ones are sorted, and the
   * place of an upper one is the number of smaller ones, which needs no unpredictable branches. */
  void takeListed(std::int64_t from, Count count, std::vector<OpenEdge>& edges)
  {
    const std::size_t before = edges.size();
    edges.resize(before + count.lower + count.upper);
    const std::uint32_t* list = this->To.at(from);
    const double* weight = this->Weight.at(from);
    const auto low = static_cast<std::uint32_t>(from);
    OpenEdge* out = edges.data() + before;
    const int last = this->To.lanes() - 1;
    for (int e = 0; e < count.lower; ++e)
    {
      *out++ = { from - (low - list[last - e]), weight[last - e] };
    }
    for (int e = 0; e < count.upper; ++e)
    {
      const std::uint32_t distance = list[e] - low;
      int place = 0;
      for (int other = 0; other < count.upper; ++other)
      {
        place += list[other] - low < distance ? 1 : 0;
      }
      out[place] = { from + distance, weight[e] };
      this->handOn(from, { from + distance, weight[e] });
    }
  }

  /** Passes the edge to its upper vertex. */
  void handOn(std::int64_t from, const OpenEdge& edge)
  {
    Count& count = this->Counts[edge.to];
    if (this->hasRoom(count))
    {
      const int place = this->To.lanes() - ++count.lower;
      this->To.at(edge.to)[place] = static_cast<std::uint32_t>(from);
      this->Weight.at(edge.to)[place] = edge.weight;
      return;
    }
    this->aside(edge.to, from) = edge.weight;
  }

  /** The weight of an edge in the separate table, which is created with 0 if it does not exist. */
  double& aside(std::int64_t from, std::int64_t to)
  {
    const auto [edge, isNew] = this->More[from].try_emplace(to, 0.0);
    this->MoreEdges += isNew ? 1 : 0;
    if (isNew && this->moreBytes() > this->MoreMemory.bytes())
    {
      this->MoreMemory.resize(this->moreBytes());
    }
    return edge->second;
  }

  /** The bytes of the separate table, rounded up: a node and buckets for each edge, and a table for
   * each vertex. */
  std::int64_t moreBytes() const
  {
    constexpr std::int64_t Edge = 64, Vertex = 256, Step = std::int64_t(32) << 10;
    const std::int64_t bytes =
      Edge * this->MoreEdges + Vertex * static_cast<std::int64_t>(this->More.size());
    return (bytes + Step - 1) / Step * Step;
  }

  Ring<std::uint32_t> To; ///< by their low 32 bits
  Ring<double> Weight;
  Ring<Count> Counts;
  /** Neighbours are searched in groups of this size, which few vertices exceed: the number of
   * groups is unpredictable, too. A group may extend beyond the end of a list, into the next one of
   * the ring. */
  int Searched;
  std::unordered_map<std::int64_t, std::unordered_map<std::int64_t, double>> More;
  std::int64_t MoreEdges = 0; ///< in it
  Reservation MoreMemory;
};

} // namespace smg
