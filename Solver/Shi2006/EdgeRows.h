// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"

#include <cstdint>

namespace smg::shi2006
{

/** An edge of node i to `neighbour`, with w_ij. */
struct Edge
{
  std::int64_t neighbour;
  double weight;
};

/** The edges of all nodes of a level, node by node; other data of an edge are at the same index of
 * separate arrays. */
class EdgeRows
{
public:
  explicit EdgeRows(Pool& pool)
    : Edges(pool)
    , Starts(pool)
  {
    this->Starts.extend(1);
  }

  /** The index of the first edge of the node, which may be the one after the last. */
  std::int64_t start(std::int64_t node) const { return this->Starts[node]; }
  std::int64_t size(std::int64_t node) const { return this->start(node + 1) - this->start(node); }
  Edge* row(std::int64_t node) const { return this->Edges.at(this->start(node)); }

  /** Opens the row of the next node with room for at most `size` edges. */
  Edge* open(std::int64_t size)
  {
    const std::int64_t start = this->Starts[this->Starts.end() - 1];
    this->Edges.extendRaw(start + size);
    return this->Edges.at(start);
  }
  /** Closes the open row with `size` edges. */
  void close(std::int64_t size)
  {
    const std::int64_t end = this->Starts.end();
    this->Starts.extendRaw(end + 1);
    this->Starts[end] = this->Starts[end - 1] + size;
  }

private:
  Ring<Edge> Edges;
  Ring<std::int64_t> Starts;
};

} // namespace smg::shi2006
