// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/StiffRows.h"
#include "Solver/Problem/AssembledRows.h"
#include "Solver/Problem/CellWeights.h"
#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Problem/Components.h"
#include "Solver/Problem/OpenEdges.h"
#include "Solver/Problem/OwnWeights.h"
#include "Solver/Problem/Problem.h"
#include "Solver/Problem/RowListener.h"
#include "Solver/Stream/StreamCheck.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/**
 * Turns the mesh stream into the rows of the finest level: weights are summed per edge while cells
 * come; when a vertex is final its row, right-hand side and initial value go to `rows`.
 * Constrained vertices are nodes with an empty row; their neighbours carry them in alpha and b.
 */
class Assembly
{
public:
  /** What finds the stiff rows of a level of a problem on such cells. */
  static StiffRows stiffRows(CellType type, Weights weights)
  {
    const bool may = weights == Weights::Cotangent && type == CellType::Triangle;
    return may ? StiffRows(StiffRows::Triangles) : StiffRows();
  }

  /** `listener`, if given, is told what the rows do not keep. */
  Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
    Components& components, ComponentLabels& labels, RowListener* listener = nullptr);

  /** Takes a block; makes the rows final that it finalises. Throws Error on a bad block. */
  void add(const MeshBlock& block);
  /** Makes the rest final. */
  void finish();

  std::int64_t vertices() const { return this->Vertices; }
  std::int64_t openVertices() const { return this->Vertices - this->Final; }
  std::int64_t cells() const { return this->Cells; }
  std::int64_t prescribed() const { return this->PrescribedCount; }
  std::int64_t held() const { return this->Held; }
  std::int64_t degenerateCells() const { return this->Degenerate; }
  std::int64_t clampedWeights() const { return this->Clamped / 2; }
  /** With raw cotangent weights: cells whose weights were limited, rows that were raised. */
  std::int64_t limitedCells() const { return this->Limited; }
  std::int64_t raisedRows() const { return this->Raised; }
  /** ||b - A x_0||^2, and the same of the terms that it is the difference of. */
  double initialSquares() const { return this->InitialSquares; }
  double termSquares() const { return this->TermSquares; }

private:
  struct Neighbour
  {
    std::int64_t to;
    float weight;
  };

  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  void addCell(const std::int64_t* corners, unsigned flags);
  void connect(const std::int64_t* corners, const CellWeights& cell);
  bool hasLength(std::int64_t a, std::int64_t b) const;
  void finalize(std::int64_t end);
  void collectRow(std::int64_t i);
  void applyEdgeTargets(std::int64_t begin);
  void closeRow(
    std::int64_t i, const Neighbour* neighbours, std::size_t count, const double* target);

  CellType Type;
  StreamCheck Check;
  Problem& Given;
  int Columns;
  Weights Kind;
  bool ConnectsFlat;
  AssembledRows& Out;
  Components& Parts;
  ComponentLabels& PartLabels;
  RowListener* Listener;
  StiffRows Stiff;

  // By open vertex.
  Ring<double> Points, Values, Sources, Screening, Mass;
  Ring<std::uint8_t> Prescribed;
  Ring<std::int32_t> Labels;
  Ring<std::int64_t> Reach; // largest neighbour of vertices 0 .. i, of final rows
  OpenEdges Edges;
  std::optional<OwnWeights> Own;
  VertexConditions Conditions;

  // The rows of the current batch.
  std::vector<OpenEdge> Row;
  std::vector<Neighbour> Neighbours;
  std::vector<std::size_t> RowEnds;
  std::vector<double> Targets, FromPoints, ToPoints;
  std::vector<double> Constraint; // of a row: what of b is not of edges to unknowns
  std::vector<std::int64_t> From, To;
  std::vector<std::int32_t> LabelBatch;

  std::int64_t Vertices = 0, Cells = 0, Final = 0, Done = 0;
  std::int64_t PrescribedCount = 0, Held = 0, Degenerate = 0, Clamped = 0;
  std::int64_t Limited = 0, Raised = 0;
  std::int64_t LastReach = 0;
  double InitialSquares = 0.0, TermSquares = 0.0;
};

} // namespace smg
