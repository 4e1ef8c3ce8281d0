// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/Loads.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/WeightedCells.h"
#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** A cell that connects its corners, with the weights of its edges; these are 0 if it is flat. */
struct ElementMatrix
{
  std::int64_t corners[4]; ///< 3 of a triangle
  CellWeights weights;
  double scale; ///< of these, see ProblemCells::scale()
};

/** Consecutive cells of a mesh stream that connect their corners. */
struct ElementMatrices
{
  std::vector<ElementMatrix> cells;
  std::int64_t vertices = 0;  ///< the end of those that the stream has had so far
  std::int64_t finalized = 0; ///< no later cell uses a vertex below

  /** Forgets all. */
  void clear()
  {
    this->cells.clear();
    this->vertices = this->finalized = 0;
  }
};

/** The contributions of cells to their vertices and edges, summed for open vertices: weights,
 * masses, loads and components. Assembly turns them into rows in stream order. */
struct SMG_EXPORT CellAssembly
{
  /** `scale` is set to the size of the weights of the problem, see AssembledRows::weightScale;
   * `labels` receives the component of each closed vertex; `solution`: see Assembly. */
  CellAssembly(Pool& pool, CellType type, Problem& problem, double& scale, Components& components,
    ComponentLabels& labels, Solution* solution = nullptr);

  /** Adds the vertices, cells and facets of a block. Throws Error if the problem returns invalid
   * data. */
  void add(const MeshBlock& block);

  // The same in two steps on two threads: connect() of the cells of a block may run at the same
  // time as weigh() of the next block, if room has been reserved for it. Not if the problem has
  // data on facets: weighing would add facets while the other thread takes the facets of final
  // vertices.

  bool mayPipeline() const { return !this->loads.facets(); }
  /** Provides room for this many more vertices. */
  void reserve(std::int64_t vertices);
  /** Adds the vertices of a block and the loads of its cells. `to` receives the cells that connect
   * their corners. Throws Error if the problem returns invalid data. */
  void weigh(const MeshBlock& block, ElementMatrices& to);
  /** Connects the corners of the cells. */
  void connect(const ElementMatrices& cells);

  /** Adds what couples vertex i, the lowest open one, to others, all cells of which have been
   * added, and returns the mass of its unknown; 0 if it is tied. */
  double couple(std::int64_t i);

  /** The largest scale of the weights of a cell over the smallest one; 1 if there is none. */
  double contrast() const
  {
    return this->LeastScale > 0.0 ? this->MostScale / this->LeastScale : 1.0;
  }

  WeightedCells cells;
  CellCounts counts;
  OpenVertices vertices;
  OpenComponents parts;
  EdgeStiffness edges;
  RowLoads loads;

private:
  void addVertices(const MeshBlock& block);
  void extend(std::int64_t vertices);
  void weigh(
    const MeshBlock& block, std::size_t begin, std::size_t end, std::vector<ElementMatrix>& to);
  void weigh(const WeightedCell& cell, std::vector<ElementMatrix>& to);
  void connect(std::span<const ElementMatrix> cells);
  void connect(const ElementMatrix& cell);

  double& Scale;
  bool Scaled = false;                      // Scale is known
  double LeastScale = 0.0, MostScale = 0.0; // of all cells
  std::vector<ElementMatrix> Weighed;       // a batch of add()
};

} // namespace smg
