// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Components.h"

#include "Solver/Core/Error.h"

#include <cmath>
#include <limits>
#include <utility>

namespace smg
{

std::int32_t Components::add()
{
  if (this->Of.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw Error("the mesh falls into too many parts: convert it with the order bfs");
  }
  if (this->Account)
  {
    this->Account->acquire(static_cast<std::int64_t>(sizeof(Component)) +
                           3 * this->Columns * static_cast<std::int64_t>(sizeof(double)));
  }
  const auto label = static_cast<std::int32_t>(this->Of.size());
  this->Of.push_back({ label, false, 1, 0 });
  this->Sums.resize(this->Sums.size() + 3 * static_cast<std::size_t>(this->Columns));
  return label;
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
  // The smaller component goes into the larger one, which keeps the paths to the roots short.
  if (this->Of[static_cast<std::size_t>(a)].labels < this->Of[static_cast<std::size_t>(b)].labels)
  {
    std::swap(a, b);
  }
  Component& whole = this->Of[static_cast<std::size_t>(a)];
  Component& part = this->Of[static_cast<std::size_t>(b)];
  part.parent = a;
  whole.anchored = whole.anchored || part.anchored;
  whole.labels += part.labels;
  whole.unknowns += part.unknowns;
  for (int k = 0; k < 3 * this->Columns; ++k)
  {
    this->sums(a)[k] += this->sums(b)[k];
  }
  return a;
}

void Components::count(std::int32_t label, const double* b, const double* x0)
{
  const std::int32_t whole = this->root(label);
  ++this->Of[static_cast<std::size_t>(whole)].unknowns;
  double* sum = this->sums(whole);
  for (int k = 0; k < this->Columns; ++k)
  {
    sum[k] += b[k];
    sum[this->Columns + k] += std::fabs(b[k]);
    sum[2 * this->Columns + k] += x0[k];
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
    count += this->isRoot(label) && !this->Of[label].anchored ? 1 : 0;
  }
  return count;
}

std::vector<double> Components::rightSideShifts() const
{
  std::vector<double> shifts(this->Of.size() * static_cast<std::size_t>(this->Columns));
  for (std::size_t label = 0; label < this->Of.size(); ++label)
  {
    if (!this->isRoot(label) || this->Of[label].anchored)
    {
      continue;
    }
    const double* sum = this->sums(static_cast<std::int32_t>(label));
    for (int k = 0; k < this->Columns; ++k)
    {
      if (std::fabs(sum[k]) > 1e-12 * sum[this->Columns + k])
      {
        shifts[label * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)] =
          sum[k] / static_cast<double>(this->Of[label].unknowns);
      }
    }
  }
  return shifts;
}

double Components::incompatibleSquares() const
{
  double squares = 0.0;
  const std::vector<double> shifts = this->rightSideShifts();
  for (std::size_t k = 0; k < shifts.size(); ++k)
  {
    const std::size_t label = k / static_cast<std::size_t>(this->Columns);
    squares += shifts[k] * shifts[k] * static_cast<double>(this->Of[label].unknowns);
  }
  return squares;
}

std::vector<double> Components::meanShifts(std::span<const double> sums) const
{
  std::vector<double> shifts(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    const std::size_t label = k / static_cast<std::size_t>(this->Columns);
    if (this->isRoot(label) && !this->Of[label].anchored)
    {
      const double initial = this->sums(static_cast<std::int32_t>(
        label))[2 * this->Columns + static_cast<int>(k % static_cast<std::size_t>(this->Columns))];
      shifts[k] = (sums[k] - initial) / static_cast<double>(this->Of[label].unknowns);
    }
  }
  return shifts;
}

} // namespace smg
