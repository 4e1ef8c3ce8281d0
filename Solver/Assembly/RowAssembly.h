// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/AssembledRows.h"
#include "Solver/Assembly/Components.h"
#include "Solver/Assembly/FinalVertices.h"
#include "Solver/Assembly/InitialResidual.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/RowListener.h"
#include "Solver/Multigrid/Setup/StiffRows.h"
#include "smg/Problem.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Makes a row of the finest level, its right-hand side and initial value from the data of the
 * vertex and its neighbours. */
class RowAssembly
{
public:
  RowAssembly(CellType type, const OpenVertices& vertices, Problem& problem, AssembledRows& rows,
    Components& components, StiffRows stiff, RowListener* listener);

  /** Whether a vertex is not an unknown: prescribed, or without any data that determine it. */
  static bool isKnown(std::int32_t dirichlet, std::size_t neighbours, double alpha)
  {
    return dirichlet >= 0 || (neighbours == 0 && alpha == 0.0);
  }

  /** Adds the next row, of vertex number k of `made`. */
  void close(const FinalVertices& made, std::size_t k);

  std::int64_t prescribed() const { return this->Prescribed; }
  /** The number of vertices without any data that determine them. */
  std::int64_t held() const { return this->Held; }
  /** See rowShortfall(). */
  std::int64_t raised() const { return this->Raised; }
  std::int64_t stiff() const { return this->Stiff.found(); }
  /** The residual of the initial values; rows dominated by slivers, screening and the like count as
   * by ordinary edges. */
  const InitialResidual& residual() const { return this->Residual; }

private:
  void closeKnown(std::int64_t i);
  void addNeighbours(
    std::int64_t i, std::span<const RowNeighbour> neighbours, const double* target);
  void addKnown(
    std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target);
  void addUnknown(
    std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target);
  void addTarget(double weight, const double* target);
  void sharpen(std::span<const RowNeighbour> neighbours);
  bool addEdge(std::int64_t i, const RowNeighbour& neighbour, double weight);
  void raise(std::int64_t i);
  void count(std::int64_t i, const FinalVertices::Vertex& vertex);
  std::span<const double> weights() const
  {
    return { this->Weight.data(), static_cast<std::size_t>(this->Size) };
  }

  const OpenVertices& Vertices;
  std::size_t Columns;
  CellType Type;
  Weights Kind;
  AssembledRows& Out;
  Components& Parts;
  StiffRows Stiff;
  RowListener* Listener;

  // The current row.
  RowEntry* Row = nullptr;
  std::int64_t Size = 0;
  double Alpha = 0.0;
  double Scale = 0.0;                 // of the weights of its cells
  double Edges = 0.0, Ordinary = 0.0; // magnitudes of weights, and what regular cells may have
  double Raise = 0.0;
  std::vector<double> Weight;     // of the first `Size` entries, rounded like these ...
  bool AnyPrecise = false;        // ... except for some, which the row needs in double precision
  float Least = 0.0F;             // weight of the entries, at most 0
  std::vector<double> B;          // `Columns` numbers
  std::vector<double> Constraint; // the part of b not from edges to unknowns

  InitialResidual Residual;
  std::int64_t Prescribed = 0, Held = 0, Raised = 0;
};

} // namespace smg
