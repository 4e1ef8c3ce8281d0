// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Search/WeightedGraph.h"

#include <functional>
#include <vector>

namespace smg
{

/**
 * The Fiedler vector of a connected graph: the eigenvector of the smallest nonzero eigenvalue of
 * L x = lambda M x, where L is the graph's Laplacian and M has the masses; approximately, as an
 * order needs it. Its mean by mass is 0 and its norm by mass 1; zeros for fewer than two nodes.
 *
 * The graph is coarsened until it is small enough for a dense solver; the vector is carried back
 * and improved on each graph by LOBPCG (Knyazev 2001) with a Jacobi preconditioner. The same graph
 * gives the same vector.
 *
 * @param poll called now and then, if the graph is large; it may throw
 */
std::vector<double> fiedlerVector(
  const WeightedGraph& graph, const std::function<void()>& poll = {});

} // namespace smg
