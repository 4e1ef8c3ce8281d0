// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ProblemCells.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Mesh/VisitCells.h"
#include "smg/CellWeights.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace smg
{

/** A cell of a block with its weights, and what the problem says of it. */
struct WeightedCell
{
  std::size_t number; ///< in its block
  const std::int64_t* corners;
  std::int64_t nodes[4];   ///< the vertices whose unknowns its corners have, see VertexTies
  const double* jumps[4];  ///< of its corners, see VertexTies; null: none
  unsigned flags;          ///< bits of CellFlag
  const double* points[4]; ///< the positions of its corners
  /** Those of finite elements or of the problem. Measure 0: it has none, since it is flat, flagged
   * or uses a vertex twice, or by the problem's choice. */
  CellWeights weights;
  /** The factor by which a solve scales the weights down, see flatnessFactor(); 1 unless
   * Weights::Cotangent. */
  double flatness;
  double scale;             ///< of its weights, see ProblemCells::scale()
  bool connects;            ///< its corners, even if it has no weights
  const ProblemCells* data; ///< of the problem in this cell; null: it has none

  /** The weights that it contributes to its edges. One factor for all of them keeps the stiffness
   * positive semidefinite. */
  CellWeights stiffness() const
  {
    CellWeights stiffness = this->weights;
    if (this->flatness < 1.0)
    {
      for (double& weight : stiffness.weight)
      {
        weight *= this->flatness;
      }
    }
    return stiffness;
  }
};

/** The cells of a mesh stream with their weights and the data of a problem, as all that is computed
 * of a problem sees them: its rows, its results and its discretisation error. */
class WeightedCells
{
public:
  /** `conductivities`: whether K is queried, too. */
  WeightedCells(CellType type, Problem& problem, bool conductivities = false)
    : Type(type)
    , Kind(problem.weights())
    , ConnectsFlat(problem.connectsFlatCells())
  {
    if (problem.hasCells())
    {
      this->Data.emplace(problem, type, conductivities);
    }
  }

  CellType type() const { return this->Type; }
  Weights kind() const { return this->Kind; }
  /** Whether the problem has data in its cells. */
  bool hasData() const { return this->Data.has_value(); }

  /** Calls visit(cell) for the cells [begin, end) of a block, which are to be visited in ascending
   * order; `vertices` are all open ones. Throws Error if a value of the problem
   * is invalid. */
  template <class Visit>
  void forRange(const MeshBlock& block, std::size_t begin, std::size_t end,
    const OpenVertices& vertices, Visit&& visit)
  {
    WeightedCell cell{};
    cell.data = this->Data ? &*this->Data : nullptr;
    forCellRange(this->Type, block, begin, end,
      [&](const std::int64_t* corners, unsigned flags, std::size_t c)
      {
        // Also of a cell without weights: the data come in batches.
        if (this->Data)
        {
          this->Data->prepare(block, c, vertices.points);
        }
        cell.number = c;
        cell.corners = corners;
        cell.flags = flags;
        this->weigh(cell, vertices);
        visit(std::as_const(cell));
      });
  }
  /** The same for all cells of the block. */
  template <class Visit>
  void forEach(const MeshBlock& block, const OpenVertices& vertices, Visit&& visit)
  {
    this->forRange(block, 0, cellsOf(this->Type, block), vertices, visit);
  }

private:
  /** Of a cell with its corners and flags, sets the rest. */
  void weigh(WeightedCell& cell, const OpenVertices& vertices) const;

  CellType Type;
  Weights Kind;
  bool ConnectsFlat;
  std::optional<ProblemCells> Data;
};

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

/** What an assembly counts of its cells. */
struct CellCounts
{
  void add(CellType type, const WeightedCell& cell);

  std::int64_t degenerate = 0; ///< cells without weights
  std::int64_t coincident = 0; ///< those of distinct corners of which some lie at the same place
  std::int64_t limited = 0;    ///< cells whose stiffness was scaled down
  double minFlatness = 1.0;    ///< the least factor of these
  MeasureRange measures;
};

/** Adds the integral of q . grad phi_c over a cell, which must have data and weights, to `load[c]`,
 * `columns` numbers for each corner c; scaled like the stiffness of the cell, so that the field
 * K grad g yields g. */
void addFieldLoads(const WeightedCell& cell, CellType type, int columns, double* const* load);

} // namespace smg
