// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Memory/Ring.h"
#include "smg/CellWeights.h"
#include "smg/Problem.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** The data of a problem in its cells, queried and checked in batches. */
class ProblemCells
{
public:
  /** `conductivities`: whether K is also queried. */
  ProblemCells(Problem& problem, CellType type, bool conductivities = false);

  /** Prepares cell `c` of the block, in ascending order; `points` are the positions of all open
   * vertices. Throws Error if a value is invalid. */
  void prepare(const MeshBlock& block, std::size_t c, const Ring<double>& points)
  {
    if (c % BatchCells == 0)
    {
      this->ask(block, c, points);
    }
    this->Current = c % BatchCells;
  }

  // Of the prepared cell:

  /** The weights of the problem; measure 0: none. */
  const CellWeights& weights() const { return this->Cells[this->Current].weights; }
  /** See flatnessFactor(); 1 unless Weights::Cotangent. */
  double flatness() const { return this->Cells[this->Current].flatness; }
  /** The largest weight of the cell, divided by the largest one of finite elements with K = 1. */
  double scale() const { return this->Cells[this->Current].scale; }
  /** Density::numbers() numbers. */
  const double* density(DensityIndex index) const
  {
    return this->Values[index].data() + this->Current * this->numbersOf(Densities[index]);
  }
  /** 3 numbers per column. */
  const double* field() const { return this->Field.data() + 3 * this->Current * this->Columns; }
  /** 6 numbers, if requested. */
  const double* conductivity() const { return this->Conductivity.data() + 6 * this->Current; }
  /** See CellBatch; below ConditionCounts::parts. */
  std::int32_t part() const { return this->Part[this->Current]; }

private:
  static constexpr std::size_t BatchCells = 256;

  struct Cell
  {
    CellWeights weights; // of finite elements, then of the problem
    double flatness, scale;
  };

  void ask(const MeshBlock& block, std::size_t first, const Ring<double>& points);
  void gather(const MeshBlock& block, std::size_t first, const Ring<double>& points);
  void take(std::size_t k, const MeshBlock& block, std::size_t c);
  void takeWeights(std::size_t k, const MeshBlock& block, std::size_t c);
  std::size_t numbersOf(const Density& density) const
  {
    return density.isPerColumn ? this->Columns : 1;
  }
  void requireValid(std::size_t k, const MeshBlock& block, std::size_t c) const;

  Problem& Given;
  CellType Type;
  Weights Kind;
  std::size_t Columns;
  bool Conductivities;
  int Parts;
  std::size_t Current = 0;
  std::vector<Cell> Cells; // of the batch
  std::vector<double> Points, Weight, Measure, Field, Conductivity;
  std::vector<std::int32_t> Part;
  std::array<std::vector<double>, Densities.size()> Values; ///< in the order of Densities
};

} // namespace smg
