// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Search/PatchGraph.h"

#include <functional>
#include <vector>

namespace smg
{

/**
 * The Fiedler vector of a connected graph: the eigenvector of the smallest nonzero eigenvalue of L
 * x = lambda M x, where L is the Laplacian of the graph and M has the masses; approximate, as far
 * as an order needs it. Its mean by mass is 0 and its norm by mass 1; zeros for fewer than two
 * nodes.
 *
 * The graph is coarsened until it is small enough for a dense solver; the vector is carried back
 * and improved on each graph by LOBPCG (Knyazev 2001) with a Jacobi preconditioner. The same graph
 * gives the same vector.
 *
 * @param poll called now and then if the graph is large; it may throw
 */
std::vector<double> fiedlerVector(
  const WeightedGraph& graph, const std::function<void()>& poll = {});

/** Improves an approximation of a graph's Fiedler vector: LOBPCG for one vector, preconditioned by
 * the diagonal of the Laplacian, in the space of vectors whose mass-weighted mean is 0. */
class Lobpcg
{
public:
  /** The graph must outlive this object. */
  Lobpcg(const WeightedGraph& graph, std::vector<double> start);

  /** Iterates until the eigenvalue hardly decreases any more, and returns the vector. Calls `poll`,
   * which may throw, in each iteration on a large graph. */
  std::vector<double> run(const std::function<void()>& poll = {});

private:
  /** A vector of the search space and its image under the Laplacian. */
  struct Direction
  {
    std::vector<double> values, image;
  };

  double dot(const std::vector<double>& a, const std::vector<double>& b) const;
  void removeMean(std::vector<double>& values) const;
  void applyLaplacian(const std::vector<double>& values, std::vector<double>& image) const;
  /**
   * Makes a direction orthogonal to another one, both of norm 1. Returns false if nothing remains.
   */
  bool orthogonalise(Direction& direction, const Direction& against) const;
  bool normalise(Direction& direction) const;
  /** Computes the next preconditioned residual as a direction. Returns false if there is none. */
  bool residual(double eigenvalue);
  /** Moves to the minimum of the Rayleigh quotient in the search space, and returns it. */
  double minimise(bool withPrevious);

  const WeightedGraph& Graph;
  std::vector<double> Diagonal; ///< of the Laplacian
  double Mass = 0;
  Direction Current, Residual, Previous;
};

} // namespace smg
