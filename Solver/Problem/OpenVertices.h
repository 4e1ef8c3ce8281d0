// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Ring.h"
#include "smg/Problem.h"

#include <cstdint>

namespace smg
{

/** What the mesh stream and the problem have said of the vertices whose cells are not all there. */
struct OpenVertices
{
  OpenVertices(Pool& pool, Problem& problem);

  /** Takes the vertices of a block and asks the problem about them. Throws Error if an answer is
   * not valid. */
  void add(const MeshBlock& block);
  std::int64_t end() const { return this->points.end(); }
  /** Lets go of vertices below `done`; of those below `final` but for what neighbours look at. */
  void release(std::int64_t done, std::int64_t final);

  Ring<double> points;          ///< 3 a vertex
  Ring<double> values;          ///< `columns` a vertex: VertexConditions::value
  Ring<std::int32_t> dirichlet; ///< see VertexConditions
  Ring<double> sources;         ///< `columns` a vertex: density
  Ring<double> screening;       ///< density
  Ring<double> mass;            ///< lumped area or volume; zero when a vertex comes

private:
  void ask(const MeshBlock& block);

  Problem& Given;
  int Columns;
  int DirichletCount;
  VertexConditions Conditions;
};

} // namespace smg
