// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/TiedClasses.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace smg
{

TiedClasses::TiedClasses(std::vector<std::int64_t> vertices, std::size_t columns)
  : Columns(columns)
  , Vertices(std::move(vertices))
{
  std::ranges::sort(this->Vertices);
  const auto repeated = std::ranges::unique(this->Vertices);
  this->Vertices.erase(repeated.begin(), repeated.end());
  this->Parents.resize(this->Vertices.size());
  std::iota(this->Parents.begin(), this->Parents.end(), std::size_t(0));
  this->Jumps.resize(this->Vertices.size() * columns);
}

std::size_t TiedClasses::memberOf(std::int64_t vertex) const
{
  return static_cast<std::size_t>(
    std::ranges::lower_bound(this->Vertices, vertex) - this->Vertices.begin());
}

/** The root of the class, which is the parent of the member afterwards. Roots are the lowest
 * members, so that a chain is as long as the directions of periods are many. */
std::size_t TiedClasses::find(std::size_t member)
{
  const std::size_t parent = this->Parents[member];
  if (parent != this->Parents[parent])
  {
    const std::size_t root = this->find(parent);
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      this->jumpOf(member)[k] += this->jumpOf(parent)[k];
    }
    this->Parents[member] = root;
  }
  return this->Parents[member];
}

bool TiedClasses::join(std::int64_t vertex, std::int64_t to, std::span<const double> jump)
{
  const std::size_t one = this->memberOf(vertex), other = this->memberOf(to);
  const std::size_t root = this->find(one), otherRoot = this->find(other);
  // The root of `vertex` has this much more than that of `to`.
  std::vector<double> difference(this->Columns);
  double most = 0.0, error = 0.0;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double a = this->jumpOf(one)[k], b = this->jumpOf(other)[k];
    difference[k] = jump[k] + b - a;
    most = std::max({ most, std::fabs(jump[k]), std::fabs(a), std::fabs(b) });
    error = std::max(error, std::fabs(difference[k]));
  }
  if (root == otherRoot)
  {
    return one != other && error <= 1e-12 * most;
  }
  const std::size_t joined = std::max(root, otherRoot);
  this->Parents[joined] = std::min(root, otherRoot);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->jumpOf(joined)[k] = joined == root ? difference[k] : -difference[k];
  }
  return true;
}

std::int64_t TiedClasses::nodeOf(std::int64_t vertex)
{
  const std::size_t member = this->memberOf(vertex);
  const bool isKnown = member < this->Vertices.size() && this->Vertices[member] == vertex;
  return isKnown ? this->Vertices[this->find(member)] : vertex;
}

void TiedClasses::fill(VertexCouplings& couplings)
{
  for (std::size_t member = 0; member < this->Vertices.size(); ++member)
  {
    const std::size_t root = this->find(member);
    if (root != member)
    {
      couplings.ties.push_back({ this->Vertices[member], this->Vertices[root] });
      const std::span<double> jump = this->jumpOf(member);
      couplings.jumps.insert(couplings.jumps.end(), jump.begin(), jump.end());
    }
  }
  if (std::ranges::all_of(couplings.jumps, [](double jump) { return jump == 0.0; }))
  {
    couplings.jumps = {};
  }
}

} // namespace smg
