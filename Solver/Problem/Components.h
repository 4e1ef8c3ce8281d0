// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The connected components of the mesh while it streams by: each vertex carries a label, and labels
 * whose vertices turn out to be connected are joined. A component without a constrained vertex (a
 * free component) determines its solution up to a constant only, and only if its right-hand side
 * sums to zero; what that takes is summed here.
 */
class Components
{
public:
  /** `pool`, if given, accounts for the memory. */
  explicit Components(int columns, Pool* pool = nullptr)
    : Columns(columns)
    , Account(pool)
  {
  }

  /** A new label, of a component of its own. */
  std::int32_t add();
  /** Joins two components; answers the label of the whole. */
  std::int32_t join(std::int32_t a, std::int32_t b);
  std::int32_t root(std::int32_t label) const;

  /** Counts an unknown of the component with its right-hand side and its initial value. */
  void count(std::int32_t label, const double* b, const double* x0);
  /** The component has a constraint. */
  void anchor(std::int32_t label) { this->Of[static_cast<std::size_t>(label)].anchored = true; }

  std::int64_t components() const;
  std::int64_t freeComponents() const;

  /** Per column and free component, the mean of b; 0 for those that are not free, or if b sums to
   * zero up to rounding. */
  std::vector<double> rightSideShifts() const;
  /** Sum over free components of (sum of b)^2 / unknowns: what the shifts take from ||r_0||^2. */
  double incompatibleSquares() const;
  /** Per column and free component: the mean of the values less the mean of the initial values,
   * given the sums of the values (label-major). */
  std::vector<double> meanShifts(std::span<const double> sums) const;
  std::int64_t labels() const { return static_cast<std::int64_t>(this->Of.size()); }
  bool isFree(std::int32_t root) const
  {
    return !this->Of[static_cast<std::size_t>(root)].anchored;
  }

private:
  struct Component
  {
    std::int32_t parent;
    bool anchored;
    std::int64_t labels; ///< labels joined in it
    std::int64_t unknowns;
  };

  double* sums(std::int32_t label)
  {
    return this->Sums.data() + 3 * this->Columns * static_cast<std::ptrdiff_t>(label);
  }
  const double* sums(std::int32_t label) const
  {
    return this->Sums.data() + 3 * this->Columns * static_cast<std::ptrdiff_t>(label);
  }
  bool isRoot(std::size_t label) const
  {
    return this->Of[label].parent == static_cast<std::int32_t>(label);
  }

  int Columns;
  Pool* Account;
  std::vector<Component> Of;
  std::vector<double> Sums; // a label: sums of b, |b| and x0, a column each
};

} // namespace smg
