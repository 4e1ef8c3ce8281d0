// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/CellAssembly.h"
#include "Solver/Assembly/CoincidentPoints.h"
#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/NeighbourReach.h"
#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Multigrid/Setup/SliverRows.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/**
 * Converts the mesh stream to the rows of the finest level: weights are summed per edge while cells
 * arrive; when a vertex is final, its row, right-hand side and initial value are appended to
 * `rows`. Constrained vertices are nodes with an empty row; they contribute to rowSum and b of
 * their neighbours.
 */
class SMG_EXPORT Assembly
{
public:
  /** The detection of the stiff rows of a level for a problem on such cells with these `rows`. */
  static SliverRows stiffRows(CellType type, Weights weights, const AssembledRows& rows)
  {
    const bool may = weights == Weights::Cotangent && type == CellType::Triangle;
    return may ? SliverRows(SliverRows::Triangles, rows.weightScale) : SliverRows();
  }

  /** `listener`, if given, receives the data that the rows do not store. With a `solution`, the
   * equations are those of its correction: the right-hand side is what it leaves of the problem's,
   * and all values begin at 0. */
  Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
    Components& components, ComponentLabels& labels, RowListener* listener = nullptr,
    Solution* solution = nullptr);

  /** Adds a block and completes the rows of the vertices that it finalises. Throws Error on an
   * invalid block. */
  void add(const MeshBlock& block);
  /** Completes the remaining rows. Throws Error if the stream ended before the counts of its
   * StreamInfo.
   */
  void finish();

  // The same in steps on several threads: between beginPipelined() and release(), weigh() or
  // weighRest(), connect() and closeRows() may run at the same time, each on what the stage before
  // it made in the previous step.

  /** Begins a step, which may weigh the cells of a block of up to this many vertices. */
  void beginPipelined(std::int64_t vertices);
  /** Adds the vertices of a block and weighs its cells, which asks the problem for their data. */
  void weigh(const MeshBlock& block);
  /** Instead of weigh() after the last block. */
  void weighRest();
  /** Connects the corners of the weighed cells and collects the vertices that become final. If the
   * problem has edge targets or data on facets, weigh() does this instead. */
  void connect();
  /** Completes the rows of collected vertices. */
  void closeRows();
  /** Releases the data that no later row needs. */
  void release();
  /** Whether the rows of all vertices so far are completed. */
  bool isClosed() const { return this->Closed == this->vertices(); }

  std::int64_t vertices() const { return this->Cells.vertices.end(); }
  std::int64_t openVertices() const { return this->vertices() - this->Closed; }
  std::int64_t cells() const { return this->Check.cells(); }
  const CoincidentPoints& coincident() const { return this->Coincident; }
  CellType cellType() const { return this->Info.cellType; }
  /** Whether the equations are those of a correction. */
  bool corrects() const { return this->Cells.vertices.isSolved(); }
  double contrast() const { return this->Cells.contrast(); }
  std::int64_t prescribed() const { return this->Rows.prescribed(); }
  std::int64_t held() const { return this->Rows.held(); }
  std::int64_t clampedWeights() const { return this->Cells.edges.clamped(); }
  const CellCounts& cellCounts() const { return this->Cells.counts; }
  /** With cotangent weights: rows that were raised. */
  std::int64_t raisedRows() const { return this->Rows.raised(); }
  /** See SliverRows. */
  std::int64_t stiffRows() const { return this->Rows.stiff(); }
  /** ||b - A x_0|| of the completed rows. */
  const InitialResidual& residual() const { return this->Rows.residual(); }

private:
  void beginRows();
  void collectBelow(std::int64_t final, bool pipelined);
  void collectBatch(std::int64_t end);
  void collectVertex(std::int64_t i);
  void addJumps(std::int64_t i, double mass);
  void askTargets(std::int64_t begin, std::size_t edge);

  StreamInfo Info;
  StreamCheck Check;
  CoincidentPoints Coincident;
  Components& Parts;
  RowListener* Listener;
  AssembledRows& Out;
  double WeightScale = 1.0; // see AssembledRows

  // By open vertex.
  CellAssembly Cells;
  // One block each. Not accounted for: a constant times the size of a block of the mesh source.
  ElementMatrices Weighed, Connected; // filled by weigh(), emptied by connect()
  NeighbourReach Reach;

  EdgeTargets Targets;
  const bool IsPipelined;
  std::vector<std::size_t> RowEnds; // of a query for edge targets
  FinalVertices Collected, ToClose; // closeRows() completes the arrived ones
  Reservation FinalMemory;          // of both
  RowAssembly Rows;

  std::int64_t Closed = 0; // vertices with completed rows
};

} // namespace smg
