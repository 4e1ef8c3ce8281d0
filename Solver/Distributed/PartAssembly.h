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
 * Vectors have a number, or one for each column, for each of these. */
struct PartSystem
{
  std::unique_ptr<HypreMatrix> matrix;
  std::vector<std::vector<double>> x, b; ///< by column: initial values, right-hand side
  std::vector<double> share;             ///< see commonShare()
  std::vector<double> mass;
  std::vector<std::int64_t> undetermined; ///< own vertices, from 0, that nothing determines
  std::vector<double> termSquares;        ///< by column, of all processes: see InitialResidual
  std::unique_ptr<SharedComponents> components;
  AssemblyCounts counts;     ///< of all processes
  std::int64_t unknowns = 0; ///< of all processes
  std::int64_t nonzeros = 0; ///< of the matrix, without rows that are no unknowns
};

/**
 * Assembles the equations of the whole mesh from the cells of the parts, as Assembly does from a
 * stream: each process adds what its cells contribute, to the rows of others as well, and completes
 * the rows that it owns. Called on all processes.
 */
class PartAssembly
{
public:
  /** `pool` accounts for the memory. */
  PartAssembly(Pool& pool, const SharedVertices& vertices, const MeshPart& part, Problem& problem);

  /** `matrix`: null, or that of a problem with the same weights and prescribed vertices, which is
   * taken as it is. */
  PartSystem assemble(std::unique_ptr<HypreMatrix> matrix = nullptr);

private:
  /** Numbers of a vertex that are summed over the parts; the right-hand side follows. */
  enum Lane
  {
    Mass,
    RowSum,   ///< the part of the diagonal that no edge has
    Diagonal, ///< of all edges
    Terms,    ///< magnitudes of the weights of all edges
    Ordinary, ///< likewise of regular cells, see commonShare()
    Edges,    ///< number of these
    Load
  };

  void joinScales();
  void addEdges(std::vector<double>& sums);
  void addRow(std::int64_t i, double* sums);
  void close(const std::vector<double>& sums, PartSystem& system);
  void closeUnknown(std::int64_t k, const double* sums, PartSystem& system);
  void finish(PartSystem& system);
  void add(std::int64_t row, std::span<const HYPRE_BigInt> columns, std::span<const double> values);
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
  HypreMatrix* Incomplete = nullptr; ///< null: the matrix is taken as it is
  std::vector<std::int32_t> LabelOf; ///< of the vertices of the part
  std::vector<float> Scales;         ///< likewise, see OpenVertices
  std::vector<double> Diagonals;     ///< of own vertices
  std::vector<char> IsUnknown;       ///< likewise
  std::int64_t Prescribed = 0, Raised = 0, Entries = 0;
  // A row.
  std::vector<RowNeighbour> Neighbours;
  std::vector<HYPRE_BigInt> Places;
  std::vector<double> Values;
};

} // namespace smg
