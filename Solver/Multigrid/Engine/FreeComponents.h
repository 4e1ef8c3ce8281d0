// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Report.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** Says that the sources of free components did not sum to zero: a warning, unless their sum is so
 * small that the discretisation of a balanced source may have left it. `share`: of
 * Components::incompatibility(). */
SMG_EXPORT void noteIncompatibility(Report& report, double share);
/** Notes how many components are free; as a warning if others are not. */
SMG_EXPORT void noteFreeComponents(Report& report);

/** What becomes of a value that nothing determines. */
enum class UndeterminedValues
{
  Stay,       ///< it keeps the initial value
  NotNumbers, ///< it becomes not a number
  RightSide   ///< copied from the right-hand side: the row is that of the identity
};

/**
 * What the equations leave open, or nearly so. A component without any constraint (a free
 * component) has a solution only if its right-hand side sums to zero, and then up to a constant.
 * Its solution is made unique: the mean of its sources is subtracted, and the mean of its initial
 * values is kept, both weighted with the lumped masses. A component that is held loosely is solved
 * like that, too, for what its solution is beside a constant (Components). Values that nothing
 * determines keep the initial value or become not a number, as the problem wants.
 *
 * A State of the finest level provides nodes(), rewriteB(), rewriteX() and readX(), like
 * LevelWindow.
 */
class SMG_EXPORT FreeComponents
{
public:
  FreeComponents(Components& components, ComponentLabels& labels, int columns)
    : Parts(components)
    , Labels(labels)
    , Columns(columns)
  {
  }

  /** Makes the right-hand sides of floating components sum to zero where they do not: subtracts the
   * mean of the source, and notes this in the report if it changes the problem. The iterates of
   * components that are held loosely lose the mean of their initial values. Returns whether this
   * has changed the residual. */
  template <class State>
  bool project(State& level, Report& report);

  /** To be called after the solve: prepares complete(). `report` has the counts of the assembly
   * and gets notes. */
  template <class State>
  void fix(State& level, const Problem& problem, Report& report)
  {
    this->fixMeans(level, report);
    if (report.held > 0 && !problem.keepsUndetermined())
    {
      this->Undetermined = UndeterminedValues::NotNumbers;
    }
  }
  /** The same for equations whose right-hand side is given. */
  template <class State>
  void fix(State& level, Report& report)
  {
    this->fixMeans(level, report);
    this->Undetermined = UndeterminedValues::RightSide;
  }

  UndeterminedValues undetermined() const { return this->Undetermined; }

  /** Completes the values of the vertices [first, first + count): shifts those of floating
   * components, and marks what is undetermined. */
  void complete(std::int64_t first, std::int64_t count, std::span<double> values);
  /** Prepares complete() for the iterate of a pass: components that are held loosely get their
   * constant, nothing else changes. */
  void prepare();
  /** The right-hand side was made with values that were too large by these means, label-major, in
   * components that are held loosely; and so is its solution. */
  void setExcess(std::vector<double> means) { this->Excess = std::move(means); }

private:
  static constexpr auto Block = static_cast<std::int64_t>(ComponentLabels::Block);

  /** Calls f(place, root, weight) for the vertices of a block that belong to floating components:
   * the index in the block, the component, and the weight of the vertex in its means. */
  template <class F>
  void forFree(std::int64_t block, F&& f);
  template <class F>
  void subtract(
    std::span<const double> ofComponents, std::int64_t block, std::span<double> values, F&& factor);
  template <class State>
  void fixMeans(State& level, Report& report);
  void setShifts(std::vector<double> shifts);

  Components& Parts;
  ComponentLabels& Labels;
  int Columns;
  std::vector<double> MeanShifts; ///< of floating components; empty if there is none
  std::vector<double> Excess;     ///< see setExcess(); empty: none
  UndeterminedValues Undetermined = UndeterminedValues::Stay;
};

template <class F>
void FreeComponents::forFree(std::int64_t block, F&& f)
{
  const auto [labels, masses] = this->Labels.block(block);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    const std::int32_t root = labels[i] < 0 ? -1 : this->Parts.root(labels[i]);
    if (root >= 0 && this->Parts.isFloating(root))
    {
      f(i, root, this->Parts.weightOf(root, masses[i]));
    }
  }
}

template <class State>
bool FreeComponents::project(State& level, Report& report)
{
  if (const std::vector<double> means = this->Parts.initialMeans(); !means.empty())
  {
    level.rewriteX([&](std::int64_t block, std::span<double> x)
      { this->subtract(means, block, x, [](double) { return 1.0; }); });
  }
  const std::vector<double> shifts = this->Parts.rightSideShifts();
  if (std::ranges::any_of(shifts, [](double shift) { return shift != 0.0; }))
  {
    level.rewriteB([&](std::int64_t block, std::span<double> b)
      { this->subtract(shifts, block, b, [](double weight) { return weight; }); });
  }
  if (const double share = this->Parts.incompatibility(); share > 0.0)
  {
    report.removed_source = this->Parts.shiftedSums();
    noteIncompatibility(report, share);
  }
  return this->Parts.shiftsRightSide();
}

/** Subtracts of the values of a block those of their component, times factor(weight). */
template <class F>
void FreeComponents::subtract(
  std::span<const double> ofComponents, std::int64_t block, std::span<double> values, F&& factor)
{
  const auto columns = static_cast<std::size_t>(this->Columns);
  this->forFree(block,
    [&](std::size_t i, std::int32_t root, double weight)
    {
      for (std::size_t k = 0; k < columns; ++k)
      {
        values[i * columns + k] -=
          factor(weight) * ofComponents[static_cast<std::size_t>(root) * columns + k];
      }
    });
}

/** Computes by how much the values of free components are to be shifted: one pass over the
 * solution, in node order. */
template <class State>
void FreeComponents::fixMeans(State& level, Report& report)
{
  if (this->Parts.floatingComponents() == 0)
  {
    return;
  }
  const auto columns = static_cast<std::size_t>(this->Columns);
  std::vector<double> sums(static_cast<std::size_t>(this->Parts.labels()) * columns);
  std::vector<double> values(static_cast<std::size_t>(Block) * columns);
  for (std::int64_t first = 0; first < level.nodes(); first += Block)
  {
    level.readX(first, std::min(Block, level.nodes() - first), values.data());
    this->forFree(first / Block,
      [&](std::size_t i, std::int32_t root, double weight)
      {
        for (std::size_t k = 0; k < columns; ++k)
        {
          sums[static_cast<std::size_t>(root) * columns + k] += weight * values[i * columns + k];
        }
      });
  }
  this->setShifts(this->Parts.meanShifts(sums));
  if (report.free_components > 0)
  {
    noteFreeComponents(report);
  }
  if (this->Parts.hasCancellingSums())
  {
    report.notes.emplace_back(
      "sources or fields cancel up to rounding in a component that screening or conditions hold "
      "by less: its mean, weighted with these, is 0");
  }
}

} // namespace smg
