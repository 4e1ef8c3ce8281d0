// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/CellWeights.h"
#include "Solver/Problem/OpenEdges.h"
#include "Solver/Problem/Problem.h"
#include "Solver/Storage/Ring.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * The weights of a problem that has cells(): asks for them, a batch of cells at a time, and knows
 * for each open edge how they scale, so that the floor of the weights scales alike. That is a
 * matter of the edge: at a jump of the conductivity its two sides may differ by orders of
 * magnitude, and the floor of the strong side would conduct through the weak one.
 */
class OwnWeights
{
public:
  OwnWeights(Pool& pool, Problem& problem, CellType type)
    : Given(problem)
    , Type(type)
    , Scales(pool, OpenEdges::usual(type))
  {
  }

  /**
   * Makes ready for cell `c` of the block, asked for in ascending order; `points`: the positions of
   * all open vertices. Throws Error if an answer is not valid.
   */
  void prepare(const MeshBlock& block, std::size_t c, const Ring<double>& points)
  {
    if (c % BatchCells == 0)
    {
      this->ask(block, c, points);
    }
    this->Current = c % BatchCells;
  }

  /** Of the cell that is prepared. */
  const CellWeights& cell() const { return this->Cells[this->Current]; }

  void extend(std::int64_t vertices) { this->Scales.extend(vertices); }
  void release(std::int64_t first) { this->Scales.release(first); }
  /** The cell that is prepared has the edge between a and b. */
  void connect(std::int64_t a, std::int64_t b);
  /** Scales of the edges of vertex `from`, by ascending neighbour; 1 if only flat cells have it. */
  const std::vector<OpenEdge>& takeScales(std::int64_t from);
  /**
   * Throws Error if the weight of edge (i,j) is outside 1e-20 to 1e20: single precision, in which
   * the coarse levels compute, has to hold its products and its inverse.
   */
  static void requireRange(double weight, std::int64_t i, std::int64_t j);

private:
  static constexpr std::size_t BatchCells = 256;

  void ask(const MeshBlock& block, std::size_t first, const Ring<double>& points);
  void gather(const MeshBlock& block, std::size_t first, const Ring<double>& points);
  void take(std::size_t k, std::int64_t cell);

  Problem& Given;
  CellType Type;
  std::vector<CellWeights> Cells; // of the batch; first finite elements, then the problem's own
  std::vector<double> CellScales;
  std::vector<double> Points, Weight, Measure, Screening, Source, Field;
  std::size_t Current = 0;
  OpenEdges Scales; // of each open edge the least one of its cells
  std::vector<OpenEdge> Row;
};

} // namespace smg
