// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/CellAssembly.h"
#include "Solver/Assembly/Edges.h"
#include "Solver/Distributed/HypreObjects.h"
#include "Solver/Distributed/SharedComponents.h"
#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Multigrid/Engine/AssemblyReport.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The equations of the vertices that a process owns, after the elimination of prescribed values.
 * Each vector has an element for each of these vertices. */
struct PartSystem
{
  std::unique_ptr<HypreMatrix> matrix;
  std::vector<std::vector<double>> x, b;  ///< by column: initial values, right-hand side
  std::vector<double> share;              ///< see commonShare()
  std::vector<double> mass;               ///< as the weight of Components::count()
  std::vector<std::int64_t> undetermined; ///< own vertices, from 0, that nothing determines
  // By column, of all processes: see InitialResidual.
  std::vector<double> termSquares, roundingSquares;
  /** By column, of all processes: what the residual is measured against, the residual of the best
   * constant, of all components the same one. */
  std::vector<double> references;
  std::unique_ptr<SharedComponents> components;
  AssemblyCounts counts;     ///< of all processes
  std::int64_t unknowns = 0; ///< of all processes
  std::int64_t nonzeros = 0; ///< of the matrix, without rows that are no unknowns
};

/** Assembles the equations of the whole mesh from the cells of the parts, as Assembly does from a
 * stream. Each process adds what its cells contribute, also to rows of others, and completes the
 * rows that it owns. Called on all processes. */
class PartAssembly
{
public:
  /** `pool` accounts for the memory. */
  PartAssembly(Pool& pool, const SharedVertices& vertices, const MeshPart& part, Problem& problem);

  /** `matrix`: the complete matrix of a problem with the same weights and prescribed vertices,
   * which is not changed; or null: the matrix is assembled. */
  PartSystem assemble(std::unique_ptr<HypreMatrix> matrix = nullptr);

private:
  /** The numbers of a vertex that are summed over the parts. The right-hand sides follow them. */
  enum Lane
  {
    Mass,
    RowSum,   ///< the part of the diagonal that is not from edges
    Diagonal, ///< sum of the weights of all edges
    Terms,    ///< magnitudes of the weights of all edges
    Ordinary, ///< the same with weights as of regular cells, see commonShare()
    Edges,    ///< their number
    Load
  };

  void joinScales();
  void addEdges(std::vector<double>& sums);
  void addRow(std::int64_t i, double* sums);
  void close(const std::vector<double>& sums, PartSystem& system);
  void closeUnknown(std::int64_t k, const double* sums, PartSystem& system);
  void finish(PartSystem& system);
  void add(std::int64_t row, std::span<const HYPRE_BigInt> columns, std::span<const double> values);
  void measure(PartSystem& system) const;
  void count(PartSystem& system) const;
  double regularWeight(std::int64_t i, std::int64_t to) const;
  int lanes() const { return Load + this->Columns; }
  bool isKnown(std::int64_t i) const { return this->Cells.vertices.dirichlet[i] >= 0; }

  const SharedVertices& Vertices;
  const MeshPart& Part;
  int Columns;
  Weights Kind;
  double Scale = 1.0;
  Components Labels;
  ComponentLabels Closed;
  CellAssembly Cells;
  EdgeTargets Targets;
  HypreMatrix* Incomplete = nullptr; ///< the matrix to add to; null: it is complete
  std::vector<std::int32_t> LabelOf; ///< of the vertices of the part
  std::vector<float> Scales;         ///< of the vertices of the part, see OpenVertices
  std::vector<double> Diagonals;     ///< of own vertices
  std::vector<double> RowSums;       ///< of own vertices
  std::vector<char> IsUnknown;       ///< of own vertices
  std::int64_t Prescribed = 0, Raised = 0, Entries = 0;
  bool AnyTerm = false;
  // A row.
  std::vector<RowNeighbour> Neighbours;
  std::vector<HYPRE_BigInt> Places;
  std::vector<double> Values;
};

} // namespace smg
