// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/WeightedGraph.h"

#include <functional>
#include <vector>

namespace smg
{

/**
 * Improves an approximation of a graph's Fiedler vector: LOBPCG for one vector, preconditioned by
 * the Laplacian's diagonal, among the vectors whose mean by mass is 0.
 */
class ConjugateIteration
{
public:
  /** The graph must outlive it. */
  ConjugateIteration(const WeightedGraph& graph, std::vector<double> start);

  /**
   * Iterates until the eigenvalue hardly falls any more, and gives the vector. Calls `poll`, which
   * may throw, in each iteration on a large graph.
   */
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
  /** Makes a direction orthogonal to another one, both of norm 1. False: nothing is left of it. */
  bool orthogonalise(Direction& direction, const Direction& against) const;
  bool normalise(Direction& direction) const;
  /** The next preconditioned residual as a direction. False: there is none. */
  bool residual(double eigenvalue);
  /** Goes to the least Rayleigh quotient of the search space, and gives it. */
  double minimise(bool withPrevious);

  const WeightedGraph& Graph;
  std::vector<double> Diagonal; ///< of the Laplacian
  double Mass = 0;
  Direction Current, Residual, Previous;
};

} // namespace smg
