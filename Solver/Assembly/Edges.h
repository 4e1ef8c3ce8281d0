// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/SimdPack.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/CellWeights.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
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
    const std::size_t before = edges.size();
    const int lanes = this->To.lanes();
    for (int e = 0; e < lanes; ++e)
    {
      // The list is full: its upper edges, from the front, meet the lower ones, from the back. So
      // distances may be negative.
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
    const std::span<OpenEdge> taken = std::span(edges).subspan(before);
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

  /** Bit k is set if value k is `low`, for the first `Searched` values and k below `count`. All of
   * these are compared, since a processor mispredicts where a search ends. */
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
    using Half = SimdPack<std::uint32_t, Group / 2>;
    constexpr Half::Vector Low = { 1, 2, 4, 8 }, High = { 16, 32, 64, 128 };
    const auto lower = (Half::Vector)(Half::load(list) == low) & Low;
    const auto upper = (Half::Vector)(Half::load(list + Group / 2) == low) & High;
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lower | upper);
    const std::uint64_t pair = halves[0] | halves[1];
    return static_cast<std::uint32_t>(pair | pair >> 32);
  }

  bool hasRoom(Count count) const { return count.upper + count.lower < this->To.lanes(); }

  /** take() for a vertex all of whose edges are in its list. The lower ones are in ascending order
   * already; an upper one is placed by counting the smaller ones, which branches less than sorting.
   */
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

  /** An upper estimate of the bytes of the separate table: a node and buckets for each edge, and a
   * table for each vertex. Rounded up to steps, so that the pool is not asked for every edge. */
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
  /** Neighbours are searched in groups of this size. Few vertices have more, so that the number of
   * groups is predictable, too. A group may extend beyond the end of a list into the next one of
   * the ring; matches() masks what it finds there. */
  int Searched;
  std::unordered_map<std::int64_t, std::unordered_map<std::int64_t, double>> More;
  std::int64_t MoreEdges = 0; ///< in the separate table
  Reservation MoreMemory;
};

/** A neighbour of a vertex and the weight of their edge, which is finite in single precision, too.
 */
using RowNeighbour = OpenEdge;

/** The weight with which an edge to a prescribed vertex contributes to rowSum and b. Finite-element
 * weights keep double precision; others are rounded like the entries of the row. */
inline double knownWeight(Weights weights, const RowNeighbour& neighbour)
{
  return weights == Weights::Cotangent ? neighbour.weight
                                       : static_cast<double>(static_cast<float>(neighbour.weight));
}

/**
 * The weights of the edges of open vertices: sums over the cells in stream order, modified
 * according to Weights.
 *
 * The floor of Weights::Clamped scales with the weights of the problem, edge by edge: at a jump of
 * the conductivity its two sides may differ by orders of magnitude, and the floor of the strong
 * side would conduct through the weak one.
 */
class SMG_EXPORT EdgeStiffness
{
public:
  /** The weight of an edge that take() leaves out: another process has it. */
  static constexpr double Elsewhere = -std::numeric_limits<double>::infinity();

  /** The sums over the cells of an edge. */
  struct Sum
  {
    double weight;
    double scale; ///< the smallest of the cells with a measure; 0: there is none, or it is not used
  };

  EdgeStiffness(Pool& pool, const Problem& problem, CellType type);

  void extend(std::int64_t vertices);
  void release(std::int64_t first);

  /**
   * Adds the weights of a cell to those of its edges for which wanted(a, b) is true. `scale` is the
   * scale of the cell's weights (see ProblemCells::scale()). Edges of a cell without measure are
   * also added, with weight 0, if they have a length.
   */
  template <class Wanted>
  void add(const std::int64_t* corners, const double* const* points, const CellWeights& cell,
    double scale, Wanted&& wanted)
  {
    if (this->Type == CellType::Triangle)
    {
      this->addEdges<CellType::Triangle>(corners, points, cell, scale, wanted);
    }
    else
    {
      this->addEdges<CellType::Tetrahedron>(corners, points, cell, scale, wanted);
    }
  }

  /** Adds a weight that is not of cells to that of an edge, which may be new. */
  void addLink(std::int64_t a, std::int64_t b, double weight) { this->add(a, b, weight, 0.0); }

  /** Calls visit(to, sum) for the edges of vertex `from` to higher vertices, in any order; visit()
   * may change the Sum. */
  template <class Visit>
  void visit(std::int64_t from, Visit&& visit)
  {
    this->Edges.visit(from,
      [&](std::int64_t to, double& weight)
      {
        double none = 0.0;
        double& scale = this->Scales ? this->Scales->weight(from, to) : none;
        Sum sum{ weight, scale };
        visit(to, sum);
        weight = sum.weight;
        scale = sum.scale;
      });
  }

  /** Adds the sums over other cells of the same edge. */
  void join(Sum& sum, const Sum& other) const
  {
    sum.weight = this->Kind == Weights::Uniform ? 1.0 : sum.weight + other.weight;
    sum.scale = minScale(sum.scale, other.scale);
  }

  /** Appends the neighbours of vertex `from`, the lowest open one, in ascending order; `points` are
   * the positions of open vertices. Throws Error if a weight is too large for single precision. */
  void take(std::int64_t from, const Ring<double>& points, std::vector<RowNeighbour>& neighbours);

  /** The number of edges raised to the floor. */
  std::int64_t clamped() const { return this->Clamped / 2; }

private:
  /** Whether an edge gets a positive weight even if all of its cells are flat. */
  bool hasLength(const double* a, const double* b) const
  {
    return this->Kind == Weights::Uniform ||
           static_cast<float>(cotangentFloor(this->Type, a, b)) > 0.0F;
  }

  template <CellType Cells, class Wanted>
  void addEdges(const std::int64_t* corners, const double* const* points, const CellWeights& cell,
    double scale, const Wanted& wanted)
  {
    const bool flat = !(cell.measure > 0.0);
    for (int e = 0; e < edgesOf(Cells); ++e)
    {
      const int* ends = edgeCorners(Cells, e);
      const std::int64_t a = corners[ends[0]];
      const std::int64_t b = corners[ends[1]];
      if (wanted(a, b) && (!flat || this->hasLength(points[ends[0]], points[ends[1]])))
      {
        this->add(a, b, cell.weight[e], flat ? 0.0 : scale);
      }
    }
  }

  /** The smaller positive one: 0 stands for a cell without measure. */
  static double minScale(double a, double b)
  {
    return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
  }

  void add(std::int64_t a, std::int64_t b, double weight, double scale)
  {
    double& sum = this->Edges.weight(a, b);
    sum = this->Kind == Weights::Uniform ? 1.0 : sum + weight;
    if (this->Scales)
    {
      double& least = this->Scales->weight(a, b);
      least = minScale(least, scale);
    }
  }

  CellType Type;
  Weights Kind;
  OpenEdges Edges;
  std::optional<OpenEdges> Scales; // minimum over the cells of each edge
  std::vector<OpenEdge> RowScales;
  std::int64_t Clamped = 0; // each edge counts twice
};

/** The targets of the edges of a batch of rows, queried from a problem with edge targets in one
 * call. */
class SMG_EXPORT EdgeTargets
{
public:
  /** `points`: the positions of all open vertices. */
  EdgeTargets(Problem& problem, const Ring<double>& points)
    : Given(problem)
    , Points(points)
    , Any(problem.hasEdgeTargets())
    , Columns(static_cast<std::size_t>(problem.columns()))
  {
  }

  /** Whether the problem has any. */
  bool any() const { return this->Any; }

  /** Queries the targets of the rows from `first` on, if the problem has any: the neighbours of the
   * k-th row end at ends[k] in `neighbours`. Throws Error if a target is not finite. */
  void ask(std::int64_t first, std::span<const RowNeighbour> neighbours,
    std::span<const std::size_t> ends);

  /** The targets from neighbour number `neighbour` of the batch on, `columns` values each; null
   * without edge targets. */
  const double* at(std::size_t neighbour) const
  {
    return this->Any ? this->Targets.data() + neighbour * this->Columns : nullptr;
  }

private:
  Problem& Given;
  const Ring<double>& Points;
  bool Any;
  std::size_t Columns;
  std::vector<std::int64_t> From, To;
  std::vector<double> FromPoints, ToPoints, Targets;
};

/** The weight of an edge exceeds the range of numbers. */
class EdgeWeightError : public Error
{
public:
  /** The vertices, in the numbering of the cells, and their names in the message. */
  EdgeWeightError(std::int64_t fromVertex, std::int64_t toVertex, const std::string& fromName,
    const std::string& toName)
    : Error("the weight of the edge between vertices " + fromName + " and " + toName +
            " is too large: the cells there are almost flat; use uniform weights")
    , from(fromVertex)
    , to(toVertex)
  {
  }

  std::int64_t from, to;
};

} // namespace smg
