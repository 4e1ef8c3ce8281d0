// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Problem/Components.h"
#include "Solver/Problem/OpenComponents.h"
#include "Solver/Problem/OpenVertices.h"
#include "Solver/Problem/RowLoads.h"
#include "Solver/Problem/WeightPolicy.h"
#include "Solver/Problem/WeightedEdges.h"
#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstdint>

namespace smg
{

/** What cells contribute to their vertices and edges, summed for open vertices: weights, masses,
 * loads and components. Assembly makes rows of it in stream order. */
struct SMG_EXPORT CellAssembly
{
  /** `scale`: see WeightPolicy; `labels` receives the component of each closed vertex. */
  CellAssembly(Pool& pool, CellType type, Problem& problem, double& scale, Components& components,
    ComponentLabels& labels);

  /** Adds the vertices, cells and facets of a block. Throws Error if the problem returns invalid
   * data. */
  void add(const MeshBlock& block);

  WeightPolicy policy;
  OpenVertices vertices;
  OpenComponents parts;
  WeightedEdges edges;
  RowLoads loads;

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);
  void addCell(const std::int64_t* corners, unsigned flags);
  void connect(const std::int64_t* corners, const double* const* points, const CellWeights& cell);

  CellType Type;
};

} // namespace smg
