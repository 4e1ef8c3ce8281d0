// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Components.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

// The connected components of the mesh, found while it is read, and what makes components without a
// constraint solvable.
//
// Labels are joined by a union-find structure: by size, so that paths to the roots have logarithmic
// length, and without path compression, so that root() is const. Sums (of right-hand sides, initial
// values, residuals, masses) are kept by the label that a vertex had, and are added to the sums of
// the root only in settle(), in ascending order of the labels. So their bits do not depend on when
// labels were joined, and one thread may sum while another one joins.
//
// On a component without a constraint the matrix is singular, with constants in its null space:
// there is a solution if b sums to 0, and it is unique up to a constant. The mean source is
// subtracted from b (rightSideShifts()), and the constant is chosen such that the solution has the
// same mean as the initial values (meanShifts()).
//
// On a component that is held loosely the same is done with the row sums as weights: with w = S 1
// and c = sum of b / sum of w, y = x - c satisfies (L + S) y = b - c w, and the product of w with
// both sides says that w . y = 0. Nothing is neglected; the iteration only has less to represent,
// and the constant, which V-cycles determine worst, is known beforehand. It begins at x0 minus its
// mean, which may be as large as c.
//
// Memory: a few numbers per label and column.

namespace smg
{

std::int32_t Components::add()
{
  if (this->Of.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw Error("the mesh falls into too many parts: convert it with the order bfs");
  }
  this->account(1);
  const auto label = static_cast<std::int32_t>(this->Of.size());
  this->Of.push_back({ label, false, 1, 0.0, 0.0 });
  return label;
}

/** Accounts for the memory of this many more labels. */
void Components::account(std::int64_t labels)
{
  if (this->Account)
  {
    this->Account->acquire(
      labels * (static_cast<std::int64_t>(sizeof(Component) + sizeof(Unknowns)) +
                 this->Columns * static_cast<std::int64_t>(sizeof(Sums))));
  }
}

void Components::load(StateReader& state)
{
  state(this->Of, this->Counted, this->Summed);
  state.require(this->Of.size() < static_cast<std::size_t>(INT32_MAX) &&
                this->Counted.size() == this->Of.size() &&
                this->Summed.size() == this->Of.size() * static_cast<std::size_t>(this->Columns));
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    // A label has been joined to one of at least as many labels, which then counts both. This also
    // excludes cycles, in which root() would not end.
    const auto parent = static_cast<std::size_t>(this->Of[label].parent);
    state.require(parent < this->Of.size() &&
                  (parent == label || this->Of[parent].labels > this->Of[label].labels));
  }
  this->account(this->labels());
}

std::int32_t Components::root(std::int32_t label) const
{
  while (this->Of[static_cast<std::size_t>(label)].parent != label)
  {
    label = this->Of[static_cast<std::size_t>(label)].parent;
  }
  return label;
}

std::int32_t Components::join(std::int32_t a, std::int32_t b)
{
  a = this->root(a);
  b = this->root(b);
  if (a == b)
  {
    return a;
  }
  // The smaller component is joined to the larger one, which keeps the paths to the roots short.
  if (this->Of[static_cast<std::size_t>(a)].labels < this->Of[static_cast<std::size_t>(b)].labels)
  {
    std::swap(a, b);
  }
  Component& whole = this->Of[static_cast<std::size_t>(a)];
  Component& part = this->Of[static_cast<std::size_t>(b)];
  part.parent = a;
  whole.anchored = whole.anchored || part.anchored;
  whole.labels += part.labels;
  return a;
}

/** Makes room for the sums of the first `labels` labels. Not in add(), which another thread may
 * call during count(). */
void Components::extendCounts(std::size_t labels)
{
  if (labels > this->Counted.size())
  {
    this->Counted.resize(labels);
    this->Summed.resize(labels * static_cast<std::size_t>(this->Columns));
  }
}

void Components::count(
  std::int32_t label, const double* b, const double* x0, const double* residual, double weight)
{
  const auto of = static_cast<std::size_t>(label);
  this->extendCounts(of + 1);
  Unknowns& all = this->Counted[of];
  const double mass = std::max(weight, 0.0), rowSum = std::max(-weight, 0.0);
  ++all.number;
  all.mass += mass;
  all.massSquares += mass * mass;
  all.rowSum += rowSum;
  all.rowSumSquares += rowSum * rowSum;
  for (int k = 0; k < this->Columns; ++k)
  {
    Sums& sum = this->sums(of, k);
    sum.b += b[k];
    sum.absolute += std::fabs(b[k]);
    sum.initial += x0[k];
    sum.weighed += mass * x0[k];
    sum.residual += residual[k];
    sum.residuals += mass * residual[k];
    sum.held += rowSum * x0[k];
    sum.heldResiduals += rowSum * residual[k];
  }
}

void Components::hold(std::int32_t label, double rowSum, double weights)
{
  Component& of = this->Of[static_cast<std::size_t>(label)];
  of.rowSum += rowSum;
  of.weights += weights;
}

/** A component of n vertices that is held by S beside weights that sum to W is about a constant, c,
 * if n S / W is small: that is s L^2 / K or more, with the size L of the component. */
void Components::anchorHeld()
{
  constexpr double Loose = 1e-3;
  this->settle();
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    Component& of = this->Of[label];
    const auto number = static_cast<double>(this->Counted[label].number);
    of.anchored = of.anchored || (this->isRoot(label) && number * of.rowSum > Loose * of.weights);
  }
}

bool Components::hasConstantsInKernel(std::int32_t root) const
{
  constexpr double Rounding = 1e-10;
  const auto label = static_cast<std::size_t>(root);
  const Component& of = this->Of[label];
  const auto number = static_cast<double>(this->Counted[label].number);
  return !of.anchored && number * of.rowSum <= Rounding * of.weights;
}

void Components::restartCounts()
{
  std::ranges::fill(this->Counted, Unknowns{});
  std::ranges::fill(this->Summed, Sums{});
}

void Components::settle()
{
  this->extendCounts(this->Of.size());
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    if (this->isRoot(label))
    {
      continue;
    }
    const auto root = static_cast<std::size_t>(this->root(static_cast<std::int32_t>(label)));
    // What is moved is zeroed, so that another settle() adds nothing.
    Unknowns& whole = this->Counted[root];
    const Unknowns part = std::exchange(this->Counted[label], {});
    whole.number += part.number;
    whole.mass += part.mass;
    whole.massSquares += part.massSquares;
    whole.rowSum += part.rowSum;
    whole.rowSumSquares += part.rowSumSquares;
    Component& held = this->Of[label];
    this->hold(static_cast<std::int32_t>(root), std::exchange(held.rowSum, 0.0),
      std::exchange(held.weights, 0.0));
    for (int k = 0; k < this->Columns; ++k)
    {
      Sums& to = this->sums(root, k);
      const Sums from = std::exchange(this->sums(label, k), {});
      to.b += from.b;
      to.absolute += from.absolute;
      to.initial += from.initial;
      to.weighed += from.weighed;
      to.residual += from.residual;
      to.residuals += from.residuals;
      to.held += from.held;
      to.heldResiduals += from.heldResiduals;
    }
  }
}

/** All numbers are passed as doubles in one array: a single exchange between processes. Counts are
 * exact in them up to 2^53. */
void Components::combine(const std::function<void(std::span<double>)>& add)
{
  this->settle();
  std::vector<double> sums;
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    const Unknowns& all = this->Counted[label];
    const Component& of = this->Of[label];
    sums.insert(
      sums.end(), { of.anchored ? 1.0 : 0.0, of.rowSum, of.weights, static_cast<double>(all.number),
                    all.mass, all.massSquares, all.rowSum, all.rowSumSquares });
  }
  for (const Sums& sum : this->Summed)
  {
    sums.insert(sums.end(), { sum.b, sum.absolute, sum.initial, sum.weighed, sum.residual,
                              sum.residuals, sum.held, sum.heldResiduals });
  }
  add(sums);
  const double* next = sums.data();
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    Unknowns& all = this->Counted[label];
    Component& of = this->Of[label];
    // The order is that in which the numbers were packed above.
    of.anchored = *next++ > 0.0;
    of.rowSum = *next++;
    of.weights = *next++;
    all.number = static_cast<std::int64_t>(*next++);
    for (double* value : { &all.mass, &all.massSquares, &all.rowSum, &all.rowSumSquares })
    {
      *value = *next++;
    }
  }
  for (Sums& sum : this->Summed)
  {
    for (double* value : { &sum.b, &sum.absolute, &sum.initial, &sum.weighed, &sum.residual,
           &sum.residuals, &sum.held, &sum.heldResiduals })
    {
      *value = *next++;
    }
  }
}

std::int64_t Components::components() const
{
  std::int64_t count = 0;
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    count += this->isRoot(label) ? 1 : 0;
  }
  return count;
}

std::int64_t Components::freeComponents() const
{
  std::int64_t count = 0;
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    count += this->floats(label) && !this->isHeld(label) ? 1 : 0;
  }
  return count;
}

std::int64_t Components::floatingComponents() const
{
  std::int64_t count = 0;
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    count += this->floats(label) ? 1 : 0;
  }
  return count;
}

/** Whether a sum of right-hand sides that cancel is one of rounding. */
bool Components::isRounding(double sum, std::size_t label, int column) const
{
  constexpr double Rounding = 1e-12;
  return std::fabs(sum) <= Rounding * this->sums(label, column).absolute;
}

/** The sum of b on a component that is held. One of rounding counts as 0: divided by row sums that
 * may be as small as one likes, it would be any number. */
double Components::heldSum(std::size_t label, int column) const
{
  const double sum = this->sums(label, column).b;
  return this->isRounding(sum, label, column) ? 0.0 : sum;
}

Components::Weighed Components::weighed(std::size_t label, int column) const
{
  const Unknowns& all = this->Counted[label];
  const Sums& sum = this->sums(label, column);
  if (this->isHeld(label))
  {
    return { all.rowSum, all.rowSumSquares, sum.held, sum.heldResiduals,
      this->heldSum(label, column) - sum.held };
  }
  if (all.mass > 0.0)
  {
    return { all.mass, all.massSquares, sum.weighed, sum.residuals, sum.b };
  }
  const auto number = static_cast<double>(all.number);
  return { number, number, sum.initial, sum.residual, sum.b };
}

/** Calls f(label, column) for floating components in which b does not sum to zero; a compatible
 * right-hand side does so up to rounding, which is not to be reported as a source. */
template <class F>
void Components::forShifts(F&& f) const
{
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    for (int k = 0; this->floats(label) && k < this->Columns; ++k)
    {
      if (!this->isRounding(this->weighed(label, k).b, label, k))
      {
        f(label, k);
      }
    }
  }
}

/** Calls f(label, column, place) for components that are held loosely. */
template <class F>
void Components::forHeld(F&& f) const
{
  const auto columns = static_cast<std::size_t>(this->Columns);
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    for (int k = 0; this->floats(label) && this->isHeld(label) && k < this->Columns; ++k)
    {
      f(label, k, label * columns + static_cast<std::size_t>(k));
    }
  }
}

std::vector<double> Components::rightSideShifts() const
{
  std::vector<double> shifts(this->Summed.size());
  this->forShifts(
    [&](std::size_t label, int k)
    {
      const Weighed all = this->weighed(label, k);
      shifts[label * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)] =
        all.b / all.weights;
    });
  this->forHeld([&](std::size_t label, int k, std::size_t place)
    { shifts[place] = this->heldSum(label, k) / this->weighed(label, k).weights; });
  return shifts;
}

bool Components::hasCancellingSums() const
{
  bool any = false;
  this->forHeld([&](std::size_t label, int k, std::size_t)
    { any = any || this->heldSum(label, k) != this->sums(label, k).b; });
  return any;
}

bool Components::shiftsRightSide() const
{
  bool any = false;
  this->forShifts([&](std::size_t, int) { any = true; });
  return any;
}

std::vector<double> Components::shiftedSums() const
{
  std::vector<double> sums(static_cast<std::size_t>(this->Columns));
  this->forShifts(
    [&](std::size_t label, int k)
    {
      const double sum = this->isHeld(label) ? 0.0 : this->sums(label, k).b;
      sums[static_cast<std::size_t>(k)] += sum;
    });
  return sums;
}

double Components::incompatibility() const
{
  double largest = 0.0;
  this->forShifts(
    [&](std::size_t label, int k)
    {
      const Sums& sum = this->sums(label, k);
      largest = std::max(largest, this->isHeld(label) ? 0.0 : std::fabs(sum.b) / sum.absolute);
    });
  return largest;
}

std::vector<double> Components::shiftedSquares() const
{
  std::vector<double> squares(static_cast<std::size_t>(this->Columns));
  this->forShifts(
    [&](std::size_t label, int k)
    {
      // ||r - s w||^2 - ||r||^2 with the shift s and the weights w.
      const Weighed all = this->weighed(label, k);
      const double shift = all.b / all.weights;
      squares[static_cast<std::size_t>(k)] +=
        shift * shift * all.squares - 2.0 * shift * all.residual;
    });
  return squares;
}

std::vector<double> Components::initialMeans() const
{
  std::vector<double> means;
  this->forHeld(
    [&](std::size_t label, int k, std::size_t place)
    {
      const Weighed all = this->weighed(label, k);
      if (all.initial != 0.0)
      {
        means.resize(this->Summed.size());
        means[place] = all.initial / all.weights;
      }
    });
  return means;
}

std::vector<double> Components::constantShifts() const
{
  std::vector<double> shifts;
  if (!this->anyHeldLoosely())
  {
    return shifts;
  }
  const std::vector<double> constants = this->rightSideShifts();
  shifts.resize(constants.size());
  this->forHeld([&](std::size_t, int, std::size_t place) { shifts[place] = -constants[place]; });
  return shifts;
}

std::vector<double> Components::meanShifts(std::span<const double> sums) const
{
  std::vector<double> shifts = this->constantShifts();
  shifts.resize(sums.size());
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    for (int k = 0; this->floats(label) && k < this->Columns; ++k)
    {
      const std::size_t place =
        label * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k);
      const Weighed all = this->weighed(label, k);
      shifts[place] += (sums[place] - (this->isHeld(label) ? 0.0 : all.initial)) / all.weights;
    }
  }
  return shifts;
}

} // namespace smg
