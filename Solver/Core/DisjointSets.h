// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace smg
{

/** Disjoint sets of the numbers 0 ... size - 1, each alone at first (union and find with path
 * halving). A set is represented by its smallest number, so the result does not depend on the
 * order of join(). */
template <class Index>
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : Up(size)
  {
    std::iota(this->Up.begin(), this->Up.end(), Index(0));
  }

  /** The first number of the set of i. */
  Index first(Index i)
  {
    while (this->Up[i] != i)
    {
      i = this->Up[i] = this->Up[this->Up[i]];
    }
    return i;
  }

  void join(Index a, Index b)
  {
    a = this->first(a);
    b = this->first(b);
    this->Up[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<Index> Up; ///< a number of the same set that is not larger
};

} // namespace smg
