// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace smg
{

/** What the cells, boundary facets and edges of a vertex contribute to the results. These are sums
 * over them: what the parts of a mesh contribute to a vertex of several parts adds up. */
class VertexTerms
{
public:
  /** The number of numbers. */
  static std::size_t size(std::size_t columns) { return OfColumns + 4 * columns; }

  /** A view of this many numbers. */
  explicit VertexTerms(double* numbers)
    : Numbers(numbers)
  {
  }

  double& mass() { return this->Numbers[0]; }
  double& screening() { return this->Numbers[1]; } ///< of the diagonal
  double& transfer() { return this->Numbers[2]; }  ///< likewise, of Robin conditions
  /** The magnitudes of the weights of all edges, if the problem has facets. */
  double& edges() { return this->Numbers[3]; }

  // Of column k:

  double& source(std::size_t k) { return this->at(k, 0); } ///< of the right-hand side
  double& inflow(std::size_t k) { return this->at(k, 1); } ///< likewise, of facets
  /** What flows out of the condition along the edges of a Dirichlet vertex, and the magnitudes of
   * the terms of its differences. */
  double& outflow(std::size_t k) { return this->at(k, 2); }
  double& outflowTerms(std::size_t k) { return this->at(k, 3); }

private:
  static constexpr std::size_t OfColumns = 4;

  double& at(std::size_t k, std::size_t place) { return this->Numbers[OfColumns + 4 * k + place]; }

  double* Numbers;
};

} // namespace smg
