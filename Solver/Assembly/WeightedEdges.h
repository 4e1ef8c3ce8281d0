// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/FlatCells.h"
#include "Solver/Assembly/OpenEdges.h"
#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace smg
{

/** A neighbour of a vertex, and the weight of their edge, which is also finite in single precision.
 */
using RowNeighbour = OpenEdge;

/** The weight of an edge to a prescribed vertex in the system, where it contributes to alpha and b;
 * for finite elements it is not rounded. */
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
class SMG_EXPORT WeightedEdges
{
public:
  /** The weight of an edge that take() leaves out: another process has it. */
  static constexpr double Elsewhere = -std::numeric_limits<double>::infinity();

  /** What the cells of an edge sum up to. */
  struct Sum
  {
    double weight;
    double scale; ///< the smallest one; 0: only of cells without measure, or not used
  };

  WeightedEdges(Pool& pool, const Problem& problem, CellType type);

  void extend(std::int64_t vertices);
  void release(std::int64_t first);

  /**
   * Adds the weights of a cell to the edges with wanted(a, b). `scale` is that of the weights of
   * the cell (see ProblemCells). Edges of a cell without measure are also added, without a weight,
   * if they have a length.
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

  /** Calls visit(to, sum) for the edges of vertex `from` to higher vertices, in any order; what it
   * sets in the Sum takes the place of the sum over the cells. */
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

  /** Adds what other cells of the edge sum up to. */
  void join(Sum& sum, const Sum& other) const
  {
    sum.weight = this->Kind == Weights::Uniform ? 1.0 : sum.weight + other.weight;
    sum.scale = leastScale(sum.scale, other.scale);
  }

  /** Appends the neighbours of vertex `from`, the lowest open one, in ascending order; `points` are
   * the positions of open vertices. Throws Error if a weight is too large for single precision. */
  void take(std::int64_t from, const Ring<double>& points, std::vector<RowNeighbour>& neighbours);

  /** The number of edges raised to the floor. */
  std::int64_t clamped() const { return this->Clamped / 2; }

private:
  /** Whether an edge has a weight even in a cell without weight. */
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

  static double leastScale(double a, double b)
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
      least = leastScale(least, scale);
    }
  }

  CellType Type;
  Weights Kind;
  OpenEdges Edges;
  std::optional<OpenEdges> Scales; // minimum over the cells of each edge
  std::vector<OpenEdge> RowScales;
  std::int64_t Clamped = 0; // each edge counts twice
};

} // namespace smg
