// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Problem.h"

#include <cstdint>

namespace smg
{

/** The data of the mesh stream and the problem at open vertices, those that later cells may still
 * use or whose data rows of neighbours still need. */
struct OpenVertices
{
  OpenVertices(Pool& pool, Problem& problem);

  /** Adds the vertices of a block and queries the problem for them. Throws Error if a value is
   * invalid. */
  void add(const MeshBlock& block);
  std::int64_t end() const { return this->points.end(); }
  /** Provides room for this many more vertices: while these are added, other threads may use the
   * data of earlier ones. */
  void reserve(std::int64_t more);
  /**
   * Releases vertices below `done`, and the data of those below `final` that no neighbour needs.
   */
  void release(std::int64_t done, std::int64_t final);

  Ring<double> points;          ///< 3 per vertex
  Ring<double> values;          ///< `columns` per vertex: VertexConditions::value
  Ring<std::int32_t> dirichlet; ///< see VertexConditions
  Ring<double> sources;         ///< `columns` per vertex: density
  Ring<double> screening;       ///< density
  Ring<double> mass;            ///< lumped area or volume; initially zero
  /** The largest scale of the weights of its cells, if the problem has weights of its own; or zero.
   */
  Ring<float> scale;

private:
  void ask(const MeshBlock& block);

  Problem& Given;
  Reservation Kept; ///< what the problem itself keeps of open vertices
  int Columns;
  int DirichletCount;
  VertexConditions Conditions;
};

} // namespace smg
