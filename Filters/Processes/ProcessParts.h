// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{

/**
 * The arrays, the kind of cells and the field data of the input, on every process: a mesh of one
 * cell with the arrays of the first process that has cells. Called on all processes, within
 * Team::run(). Throws Error if no process has cells.
 */
vtkSmartPointer<vtkPointSet> sampleOf(
  vtkPointSet& piece, Team& team, vtkMultiProcessController& controller);

/** The piece of a process as its part of the mesh. */
struct PiecePart
{
  MeshPart part;
  std::vector<std::int64_t> places; ///< the vertex of the part of each point of the piece
};

/**
 * Makes parts of the pieces of all processes: points with the same GlobalId are one vertex, and
 * duplicate cells are omitted. Called on all processes, within Team::run().
 * @param piece that of this process, perhaps without cells or points
 * @param sample what sampleOf() returns
 * @param names those of the arrays that become columns
 * @param team the processes
 * @throws Error if the piece has other cells, has no GlobalIds, or lacks an array
 */
PiecePart partOfPiece(
  vtkPointSet& piece, vtkPointSet& sample, const std::set<std::string>& names, Team& team);

/** MPI_COMM_NULL: the processes do not communicate by MPI. */
MPI_Comm communicatorOf(vtkMultiProcessController* controller);

/** The pieces that the processes of a controller have, as the parts of a mesh that they solve on.
 * The constructor is called on all processes. */
class ProcessParts
{
public:
  /** Prepares what is to be solved, given a mesh with the arrays of the input (see sampleOf()), and
   * returns the names of those that become columns. */
  using Begin = std::function<std::set<std::string>(vtkPointSet& sample)>;

  /** Throws Error on all processes if one fails. */
  ProcessParts(vtkPointSet& piece, vtkMultiProcessController* controller, const Begin& begin);

  const MeshPart& part() const { return this->Piece.part; }
  DistributedSolver& solver() { return *this->Solver; }

  /** Throws Error on all processes unless each has the same `value`; `what` names it. */
  void requireSame(const std::string& what, const std::string& value);

  /**
   * Ends a solve. Called on all processes; throws Error on all of them if one fails.
   * @param report that of the solve, which gets the notes
   * @param notes those of the task
   * @param values the solution at the vertices of the part, `columns` numbers each
   * @param atPoints set to those at all points of the piece, duplicate ones included
   */
  SolveSummary summarize(Report& report, const std::vector<std::string>& notes,
    const std::vector<double>& values, int columns, std::vector<double>& atPoints);

private:
  Team Processes;
  PiecePart Piece;
  std::optional<DistributedSolver> Solver;
};

/** The options of the distributed engine that those of a solve name. */
DistributedOptions distributedOptions(
  const SolveOptions& options, const ProgressFunction& progress);

/** Throws Error if the options ask for what the distributed engine does not have. */
void checkForProcesses(const SolveOptions& options);

} // namespace smg
