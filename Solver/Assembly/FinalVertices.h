// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/WeightedEdges.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** What the rows of consecutive vertices without missing cells are made of, besides the data of
 * OpenVertices: the edges, and the contributions of sources, screening and boundary. */
class FinalVertices
{
public:
  struct Vertex
  {
    std::size_t end; ///< of its edges in `neighbours`
    double alpha;    ///< contribution to the diagonal
    double mass;
    std::int64_t reach; ///< the largest neighbour of this and all earlier vertices
    float scale;        ///< see OpenVertices
    std::int32_t label; ///< of a component to count the vertex for, if it is an unknown; or -1
  };

  std::int64_t first = 0; ///< the first vertex
  std::vector<Vertex> vertices;
  std::vector<RowNeighbour> neighbours; ///< of each vertex, in ascending order
  std::vector<double> targets;          ///< `columns` per neighbour; empty without edge targets
  std::vector<double> loads;            ///< `columns` per vertex: contribution to b

  std::int64_t end() const
  {
    return this->first + static_cast<std::int64_t>(this->vertices.size());
  }
  /** Where the edges of vertex number k begin. */
  std::size_t begin(std::size_t k) const { return k == 0 ? 0 : this->vertices[k - 1].end; }
  /** The memory that it has. */
  std::int64_t bytes() const
  {
    return static_cast<std::int64_t>(
      this->vertices.capacity() * sizeof(Vertex) +
      this->neighbours.capacity() * sizeof(RowNeighbour) +
      (this->targets.capacity() + this->loads.capacity()) * sizeof(double));
  }
  /** Forgets all; the next vertex is `next`. */
  void clear(std::int64_t next)
  {
    this->first = next;
    this->vertices.clear();
    this->neighbours.clear();
    this->targets.clear();
    this->loads.clear();
  }
};

} // namespace smg
