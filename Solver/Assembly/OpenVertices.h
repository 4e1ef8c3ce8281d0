// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/VertexTies.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** A datum of a problem per area or volume, which it may give at vertices and in cells. */
struct Density
{
  const char* name;
  std::vector<double> VertexConditions::*atVertices;
  std::span<double> CellBatch::*inCells;
  bool isPerColumn; ///< whether there is a number for each column, else one
  bool mayBeNegative;

  int numbers(int columns) const { return this->isPerColumn ? columns : 1; }
  /** The first of its numbers, of which there are `count`, that is not valid; -1: none. */
  std::ptrdiff_t findInvalid(const double* numbers, std::size_t count) const;
  /** What is wrong with an invalid number, for messages. */
  const char* complaint() const
  {
    return this->mayBeNegative ? " is not a finite number"
                               : " must be a finite number that is not negative";
  }
};

/** All densities: asked for, checked and kept alike. Loads.cpp says what each contributes. */
inline constexpr std::array Densities{
  Density{ "screening", &VertexConditions::screening, &CellBatch::screening, false, false },
  Density{ "source", &VertexConditions::source, &CellBatch::source, true, true },
};
enum DensityIndex : std::size_t
{
  ScreeningDensity,
  SourceDensity
};

/** The data of the mesh stream and the problem at open vertices, those that later cells may still
 * use or whose data rows of neighbours still need. */
struct OpenVertices
{
  /** With a solution, its values take the place of those of the problem. */
  OpenVertices(Pool& pool, Problem& problem, Solution* solution = nullptr);

  /** Adds the vertices of a block and queries the problem for them. Throws Error if a value is
   * invalid. */
  void add(const MeshBlock& block);
  std::int64_t end() const { return this->points.end(); }
  /** Whether the values are those of a solution. */
  bool isSolved() const { return this->Solved != nullptr; }
  bool hasRest() const { return this->HasRest; }
  /** The value of vertex i in column k less that of vertex j, to the digits that these have. */
  double difference(std::int64_t i, std::int64_t j, std::size_t k) const
  {
    const double step = this->values.at(i)[k] - this->values.at(j)[k];
    return this->HasRest ? step + (this->rest.at(i)[k] - this->rest.at(j)[k]) : step;
  }
  /** Provides room for this many more vertices: while these are added, other threads may use the
   * data of earlier ones. */
  void reserve(std::int64_t more);
  /**
   * Releases vertices below `done`, and the data of those below `final` that no neighbour needs.
   */
  void release(std::int64_t done, std::int64_t final);

  /** Sets `source` to what the sources at the vertices of a node contribute to its right-hand side,
   * `columns` numbers, and returns what their screening contributes to the diagonal. A tied vertex
   * contributes to its node, and has 0 itself. */
  double sumDensities(std::int64_t node, std::span<double> source) const;

  /** A number less the value of vertex i in column k, to the digits that this has. */
  double below(double number, std::int64_t i, std::size_t k) const
  {
    const double step = number - this->values.at(i)[k];
    return this->HasRest ? step - this->rest.at(i)[k] : step;
  }

  VertexTies ties;
  Ring<double> points;          ///< 3 per vertex
  Ring<double> values;          ///< `columns` per vertex: VertexConditions::value
  Ring<double> rest;            ///< `columns` per vertex, if the solution has it: see Solution
  Ring<std::int32_t> dirichlet; ///< see VertexConditions
  std::array<Ring<double>, Densities.size()> densities; ///< in the order of Densities
  Ring<double> mass;                                    ///< lumped area or volume; initially zero
  /** The largest scale of the weights of its cells, if the problem has weights of its own; or zero.
   */
  Ring<float> scale;

private:
  void ask(const MeshBlock& block);
  /** Calls visit(ring, numbers) with what the stream and the problem give of the block. */
  void forGiven(const MeshBlock& block, auto visit);

  void readSolution(std::int64_t begin, std::int64_t end);

  Problem& Given;
  Solution* Solved;
  bool HasRest;
  std::vector<double> Read; // of the solution
  Reservation Reserved;     ///< what the problem itself keeps of open vertices
  int Columns;
  int DirichletCount;
  VertexConditions Conditions;
};

} // namespace smg
