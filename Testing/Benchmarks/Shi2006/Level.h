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

/** The edges of all nodes of a level, node by node. Other data of an edge are at the same index of
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

namespace smg::shi2006
{

/** The data of the equation of a node except for its edges and its values. */
struct Node
{
  double alpha;             ///< alpha_i: the weights to constrained vertices, and the screening
  double diagonal;          ///< alpha_i + sum_j w_ij
  double pull = 0.0;        ///< Z_i of a retained node: alpha_i + sum of w_ij over lifted j
  std::int64_t parent = -1; ///< number of its node on the next level; -1: retained

  bool lifted() const { return this->parent >= 0; }
};

/**
 * A level of the hierarchy of the paper, in memory: equation (2), with its vectors g on the edges.
 * For the unknowns v_i,
 *
 *   sum_j w_ij (v_i - v_j - d_ij) + alpha_i v_i = xi0_i.
 *
 * On the finest level v is the solution and d the edge targets of the problem; on the others v is
 * the correction Delta, initially zero, and d and xi0 are the g and xi of the restriction. Their
 * remainders for the current v are g_ij = d_ij - (v_i - v_j) and xi_i = xi0_i - alpha_i v_i.
 *
 * Constrained vertices are nodes of the finest level without edges, so that a node is a vertex;
 * they contribute only to alpha and xi0 of their neighbours, and do not occur on coarser levels.
 */
struct Level
{
  Level(Pool& pool, int columns)
    : edges(pool)
    , target(pool, columns)
    , node(pool)
    , constraint(pool, columns)
    , rightSide(pool, columns)
    , value(pool, columns)
  {
  }

  std::int64_t nodes() const { return this->node.end(); }
  int columns() const { return this->value.lanes(); }
  /** The number of entries of the matrix of the level, including diagonals. */
  std::int64_t nonzeros() const { return this->edges.start(this->nodes()) + this->nodes(); }

  EdgeRows edges;      ///< by node, by ascending neighbour
  Ring<double> target; ///< d_ij of every edge, in the order of `edges`
  Ring<Node> node;
  Ring<double> constraint; ///< xi0_i
  Ring<double> rightSide;  ///< b_i = xi0_i + sum_j w_ij d_ij
  Ring<double> value;      ///< v_i
};

} // namespace smg::shi2006
