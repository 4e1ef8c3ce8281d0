// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Memory/Ring.h"
#include "smg/CellWeights.h"
#include "smg/Problem.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/** The factor by which a solve with these weights scales a cell down, see flatnessFactor(). `own`:
 * the problem's data in its cells, if any, with this cell prepared. */
double flatnessOf(Weights kind, const std::optional<ProblemCells>& own, CellType type,
  const double* const* points, const CellWeights& cell);

/** Adds the integral of q . grad phi_c over the prepared cell, which has these corners, to
 * `load[c]`, `columns` numbers for each corner c; scaled like the stiffness of the cell, so that
 * the field K grad g yields g. */
void addFieldLoads(const ProblemCells& own, CellType type, const double* const* points, int columns,
  double* const* load);

/** The sizes of the cells of a mesh, for the question whether squares and inverses of them are
 * numbers. A few cells may be of any size, as cells that have collapsed are. */
struct MeasureRange
{
  double largest = 0.0;    ///< area or volume; 0: no cell has one
  std::int64_t lost = 0;   ///< cells whose measure is not a number or 0, since their edges are
                           ///< beyond the range of lengths
  bool areWeights = false; ///< the weights are those of finite elements, with no other factor

  void addLost(const double* const* corners, int count);
  /** Throws Error if all cells are too small or too large. */
  void check(CellType type) const;
};

/**
 * The weights that a cell contributes to its edges: those of finite elements or of the problem,
 * with Weights::Cotangent scaled down if the cell is too flat. EdgeStiffness sums them over the
 * cells of each edge.
 */
class StiffnessRules
{
public:
  /** `scale` is set to the size of the weights of the problem, see AssembledRows::weightScale. */
  StiffnessRules(CellType type, Problem& problem, double& scale);

  /** Prepares cell `c` of the block; see ProblemCells::prepare(). */
  void prepare(const MeshBlock& block, std::size_t c, const Ring<double>& points)
  {
    if (this->Own)
    {
      this->Own->prepare(block, c, points);
    }
  }

  // Of the prepared cell:

  /** Its weights; measure 0 if it has none. */
  CellWeights weigh(const std::int64_t* corners, const double* const* points, unsigned flags);
  /** Whether its corners are connected even if it is degenerate. */
  bool connectsFlat(const std::int64_t* corners, unsigned flags) const;
  /** The size of its weights; see ProblemCells::scale(). */
  double scale() const { return this->Own ? this->Own->scale() : 1.0; }
  /** The data of the problem in its cells, if any. */
  const std::optional<ProblemCells>& own() const { return this->Own; }

  std::int64_t degenerateCells() const { return this->Degenerate; }
  /** Degenerate cells some of whose distinct corners lie at the same place. */
  std::int64_t coincidentCells() const { return this->Coincident; }
  /** With cotangent weights: the number of cells whose stiffness was scaled down, and the least
   * factor. */
  std::int64_t limitedCells() const { return this->Limited; }
  double minFlatness() const { return this->MinFlatness; }
  const MeasureRange& measures() const { return this->Measures; }

private:
  CellWeights limited(CellWeights cell, double flatness);

  CellType Type;
  Weights Kind;
  bool ConnectsFlat;
  std::optional<ProblemCells> Own;
  double& Scale;
  bool Scaled = false; // Scale is known
  std::int64_t Degenerate = 0, Coincident = 0, Limited = 0;
  double MinFlatness = 1.0;
  MeasureRange Measures;
};

} // namespace smg
