// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

class vtkMultiProcessController;
class vtkPointSet;
template <class T>
class vtkSmartPointer;

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

} // namespace smg
