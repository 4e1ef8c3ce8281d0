// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Memory/Pool.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The boundary edges of a surface, smoothed as curves. A step solves (M_k + t L) x_{k+1} = M_k x_k
 * with linear finite elements on the edges: L has their lengths at rest, M_k those before step k.
 * Everything is in memory and accounted for.
 */
class BoundaryCurves
{
public:
  explicit BoundaryCurves(Pool& pool)
    : Memory(pool)
  {
  }
  ~BoundaryCurves() { this->Memory.release(this->Acquired); }
  BoundaryCurves(const BoundaryCurves&) = delete;
  BoundaryCurves& operator=(const BoundaryCurves&) = delete;

  /** Adds a boundary edge by its stream indices. */
  void add(std::int64_t low, std::int64_t high);
  /** After the last edge: takes the positions at rest of the vertices. */
  void begin(const VertexFile& positions);
  /** Fixes boundary vertices: `held` is 1 for those to be fixed, from stream index `first` on. */
  void hold(std::int64_t first, std::span<const std::uint8_t> held);

  bool isEmpty() const { return this->Vertices.empty(); }
  /** Performs a step. Throws Error if the memory does not suffice. */
  void step(double t);

  /** Calls visit(i, position) for each boundary vertex first + i with 0 <= i < count. */
  template <class Visit>
  void forVertices(std::int64_t first, std::int64_t count, Visit&& visit) const
  {
    for (std::size_t k = this->place(first);
         k < this->Vertices.size() && this->Vertices[k] < first + count; ++k)
    {
      visit(static_cast<std::size_t>(this->Vertices[k] - first), this->Positions[k]);
    }
  }

private:
  /** The index of the first boundary vertex from a stream index on. */
  std::size_t place(std::int64_t vertex) const;
  double length(std::size_t edge) const;
  std::vector<double> masses() const;

  Pool& Memory;
  std::int64_t Acquired = 0;
  /** The ends of each edge: stream indices until begin(), then places in `Vertices`. */
  std::vector<std::array<std::int64_t, 2>> Edges;
  std::vector<double> RestLengths;    ///< of the edges
  std::vector<std::int64_t> Vertices; ///< ascending
  std::vector<std::array<double, 3>> Positions;
  std::vector<std::uint8_t> Held;
};

} // namespace smg
