// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ConstantFit.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

class Components;

/**
 * The part of a right-hand side b that makes the solution vary: what is left beside A times the
 * best constant, min over c of ||b - A c||, for each body (connected component) and column. A
 * constant has no flow along edges, so A c is c times the row sums. Convergence is measured against
 * it: it depends neither on the initial values nor on a constant that is added to all values.
 *
 * Of a body that nothing holds all row sums are 0; a constant source, which is subtracted there
 * (see Components), takes the place of the constant: b - c m, with the masses m.
 *
 * Memory: 72 bytes and what a vector grows by for each of the first 16,384 labels of components,
 * divided by the columns; later ones count as one body.
 */
class SMG_EXPORT VaryingRightSide
{
public:
  explicit VaryingRightSide(int columns)
    : Columns(static_cast<std::size_t>(columns))
    , Most(MostSums / this->Columns)
  {
  }

  /** Adds the row of an unknown of this component: its row sum, mass (0: none) and right-hand side,
   * a number per column. It counts as `share`, see commonShare(). */
  void add(std::int32_t label, double rowSum, double mass, const double* b, double share);

  /**
   * The norm of each column; 0 of one without a right-hand side. If the mean square over the
   * unknowns of one body is less than over all, the norm is as much less: the solution of each body
   * is to be exact beside its own range, of which the least one counts down to a ten-thousandth of
   * the whole. That is also the norm beside ||b|| of a column whose solution is constant.
   */
  std::vector<double> norms(const Components& components) const;

private:
  static constexpr std::size_t MostSums = 16384;
  static constexpr double LeastShare = 1e-4;

  struct Body
  {
    ConstantFit rowSums, masses;
    double unknowns = 0.0;

    double rest() const
    {
      return this->rowSums.hasConstant() ? this->rowSums.rest() : this->masses.rest();
    }
  };

  double norm(std::span<const Body> bodies) const;

  std::size_t Columns, Most;
  std::vector<Body> Bodies; ///< `Columns` per label
};

} // namespace smg
