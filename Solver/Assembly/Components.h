// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/State.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace smg
{

/**
 * The connected components of the mesh during a pass: each vertex has a label, and labels of
 * connected vertices are joined. On a component without a constrained vertex (a free component),
 * there is a solution only if the right-hand side sums to zero, and it is unique up to a constant;
 * this class accumulates the sums that this takes. Means are weighted by the lumped masses of the
 * vertices, so that it is a constant source that is subtracted; without masses, by 1.
 *
 * A component may be held so loosely, by row sums that are tiny beside its weights, that its
 * solution is a large constant c, the sum of the right-hand side over that of the row sums, plus
 * what varies. In double precision the constant would leave the variation few digits or none. So
 * (L + S) (c + y) = F is solved for y, whose right-hand side F - S c sums to zero, and c is added
 * to the result: as for a free component, with the row sums as weights. The iterates of y begin at
 * the initial values minus their mean, which may be as large as c.
 *
 * One thread may count() while another one adds, joins and anchors labels, since the sums of a
 * label do not depend on when it is joined. settle() ends this.
 */
class SMG_EXPORT Components
{
public:
  /** `pool` accounts for the memory, if not null. */
  explicit Components(int columns, Pool* pool = nullptr)
    : Columns(columns)
    , Account(pool)
  {
  }

  /** Adds a component and returns its label. */
  std::int32_t add();
  /** Joins two components; returns the label of the union. */
  std::int32_t join(std::int32_t a, std::int32_t b);
  std::int32_t root(std::int32_t label) const;

  /** Whether a row with this sum, beside these magnitudes of its weights, constrains its component
   * only loosely: the rounding of the row is more than the usual tolerance of what the sum holds.
   */
  static bool isLoose(double rowSum, double weights) { return rowSum <= LooseRow * weights; }

  /** Counts an unknown with this label, which only floating components need: its right-hand side,
   * initial value and residual b - A x0, `columns` numbers each, and its weight in means: its mass,
   * or, with the opposite sign, its row sum if that is not zero. */
  void count(
    std::int32_t label, const double* b, const double* x0, const double* residual, double weight);
  /** Adds a row with a loose sum to its component, with the magnitudes of its weights. */
  void hold(std::int32_t label, double rowSum, double weights);
  /** Forgets what was counted, for another right-hand side. */
  void restartCounts();
  /** To be called once after all vertices: anchors components whose loose rows together are not
   * loose. */
  void anchorHeld();
  /** Whether a component floats and its row sums are so small that constants are in the kernel of
   * its matrix up to rounding. */
  bool hasConstantsInKernel(std::int32_t root) const;
  /** Marks the component as constrained. */
  void anchor(std::int32_t label) { this->Of[static_cast<std::size_t>(label)].anchored = true; }

  std::int64_t components() const;
  std::int64_t freeComponents() const;
  /** The number of components that are free or held loosely. */
  std::int64_t floatingComponents() const;
  /** Whether any component is held loosely. */
  bool anyHeldLoosely() const { return this->freeComponents() < this->floatingComponents(); }

  /** Whether on one that is held loosely right-hand sides cancel up to rounding, which counts as 0.
   */
  bool hasCancellingSums() const;

  /** Adds the sums of joined labels to those of their roots. The shifts and means below need this.
   */
  void settle();

  /** Per column and component (label-major): the mean source, sum of b / sum of masses; 0 for
   * components that do not float, or if b sums to zero up to rounding. For one that is held
   * loosely: the constant c. */
  std::vector<double> rightSideShifts() const;
  /** Whether any of the shifts changes the residual of the initial values: of c, what differs from
   * their mean does. */
  bool shiftsRightSide() const;
  /** Per column and component: the mean of the initial values of a component that is held loosely,
   * which is to be subtracted from its iterate; 0 for others. Empty if all are 0. */
  std::vector<double> initialMeans() const;
  /** Per column: the sum of b that the shifts subtract from all free components. */
  std::vector<double> shiftedSums() const;
  /** The largest |sum of b| / sum of |b| that the shifts subtract from a free component; 0 without
   * such shifts. */
  double incompatibility() const;
  /** Per column: the change of ||r_0||^2 due to the shifts. */
  std::vector<double> shiftedSquares() const;
  /** Per column and floating component: what is to be subtracted from the values, given the sums of
   * the weighted values (label-major): their mean minus that of the initial values; for a component
   * that is held loosely, minus the constant c. */
  std::vector<double> meanShifts(std::span<const double> sums) const;
  /** The constants -c, to be subtracted from values whose mean is 0; empty if no component is held
   * loosely. */
  std::vector<double> constantShifts() const;
  /** The weight of a vertex in the means of the component, given its weight as of count(). */
  double weightOf(std::int32_t root, double weight) const
  {
    const auto label = static_cast<std::size_t>(root);
    return this->isHeld(label)               ? std::max(-weight, 0.0)
           : this->Counted[label].mass > 0.0 ? weight
                                             : 1.0;
  }
  std::int64_t labels() const { return static_cast<std::int64_t>(this->Of.size()); }
  /** Whether a component has no constraint, or only loose ones. */
  bool isFloating(std::int32_t root) const
  {
    return !this->Of[static_cast<std::size_t>(root)].anchored;
  }

  /** Replaces the sums of all labels by their sums over several processes that use the same labels.
   * `add` replaces an array of numbers by its sum over the processes. */
  void combine(const std::function<void(std::span<double>)>& add);

  void save(StateWriter& state) { state(this->Of, this->Counted, this->Summed); }
  void load(StateReader& state);

private:
  static constexpr double LooseRow = 1e-7;

  struct Component
  {
    std::int32_t parent;
    bool anchored;
    std::int64_t labels;    ///< number of joined labels
    double rowSum, weights; ///< sums of hold()

    template <class State>
    void exchange(State& state)
    {
      state(this->parent, this->anchored, this->labels, this->rowSum, this->weights);
    }
  };
  /** The unknowns of a label and the sums of their masses and row sums. */
  struct Unknowns
  {
    std::int64_t number;
    double mass, massSquares;
    double rowSum, rowSumSquares;
  };
  /** The sums of a column. */
  struct Sums
  {
    double b, absolute;         ///< of b, |b|
    double initial, weighed;    ///< of x0, mass x0
    double residual, residuals; ///< of r0, mass r0
    double held, heldResiduals; ///< of rowSum x0, rowSum r0
  };
  /** The sums of a column with the weights of the component's means. */
  struct Weighed
  {
    double weights, squares; ///< of the weights
    double initial, residual;
    double b; ///< what the right-hand side sums to beside that of the initial values
  };

  void account(std::int64_t labels);
  Sums& sums(std::size_t label, int column)
  {
    return this
      ->Summed[label * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(column)];
  }
  const Sums& sums(std::size_t label, int column) const
  {
    return const_cast<Components*>(this)->sums(label, column);
  }
  bool isHeld(std::size_t label) const { return this->Of[label].rowSum > 0.0; }
  bool floats(std::size_t label) const { return this->isRoot(label) && !this->Of[label].anchored; }
  bool isRounding(double sum, std::size_t label, int column) const;
  double heldSum(std::size_t label, int column) const;
  Weighed weighed(std::size_t label, int column) const;
  void extendCounts(std::size_t labels);
  template <class F>
  void forShifts(F&& f) const;
  template <class F>
  void forHeld(F&& f) const;
  bool isRoot(std::size_t label) const
  {
    return this->Of[label].parent == static_cast<std::int32_t>(label);
  }

  int Columns;
  Pool* Account;
  std::vector<Component> Of;
  // For labels up to the largest one counted so far; for all of them after settle().
  std::vector<Unknowns> Counted;
  std::vector<Sums> Summed; // `Columns` per label
};

} // namespace smg
