// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/BodyFlows.h"

#include <algorithm>
#include <utility>

namespace smg
{

/** The last digit of u and of its neighbours changes a row by about a third of this number of times
 * the sum of its weights: that of values which are rounded at random. */
void BodyFlows::Sums::addResidual(double of, double weights, double u)
{
  const double digit = std::numeric_limits<double>::epsilon() * weights * u;
  this->residual += of;
  this->squares += of * of;
  this->scaled += weights > 0.0 ? of * of / weights : 0.0;
  this->rounding += digit * digit;
}

void BodyFlows::Sums::add(const Sums& other)
{
  this->all += other.all;
  this->given += other.given;
  this->terms += other.terms;
  this->energy += other.energy;
  this->residual += other.residual;
  this->squares += other.squares;
  this->scaled += other.scaled;
  this->rounding += other.rounding;
  this->least = std::min(this->least, other.least);
  this->most = std::min(this->most, other.most);
  this->lowest = std::min(this->lowest, other.lowest);
  this->highest = std::min(this->highest, other.highest);
}

BodyFlows::BodyFlows(const ConditionCounts& counts, int columns)
  : Columns(static_cast<std::size_t>(columns))
  , Dirichlet(counts.dirichlet)
  , Conditions(counts.dirichlet + counts.robin)
  , Last(this->Touched.end())
{
  this->extended(0);
}

BodyFlows::Sums& BodyFlows::extended(std::size_t place)
{
  const std::size_t labels = place / this->Columns + 1;
  this->All.resize(labels * this->Columns);
  this->Screened.resize(labels);
  return this->All[place];
}

void BodyFlows::screen(std::int32_t label, double rowSum)
{
  this->of(label, 0); // makes room
  this->Screened[static_cast<std::size_t>(label)] += rowSum;
}

double BodyFlows::screened(std::int32_t label) const
{
  return this->Screened[static_cast<std::size_t>(label)];
}

/** Facets and vertices of a condition mostly come one after the other. */
void BodyFlows::touch(Place place, double rowSum)
{
  if (this->Last == this->Touched.end() || this->Last->first != place)
  {
    this->Last = this->Touched.try_emplace(place, 0.0).first;
  }
  this->Last->second += rowSum;
}

void BodyFlows::settle(const Components& components)
{
  const auto rootOf = [&](std::int32_t label)
  {
    // A mesh without cells has sums, but no labels.
    return label < components.labels() ? components.root(label) : label;
  };
  for (std::int32_t label = 0; label < this->labels(); ++label)
  {
    const std::int32_t root = rootOf(label);
    for (std::size_t k = 0; root != label && k < this->Columns; ++k)
    {
      // What is moved is emptied, since a body may be joined to one of a larger label.
      const Sums moved = std::exchange(this->of(label, k), Sums());
      this->of(root, k).add(moved);
    }
    if (root != label)
    {
      this->Screened[static_cast<std::size_t>(root)] +=
        std::exchange(this->Screened[static_cast<std::size_t>(label)], 0.0);
    }
  }
  std::map<Place, double> joined;
  for (const auto& [place, rowSum] : this->Touched)
  {
    joined[{ place.first, rootOf(place.second) }] += rowSum;
  }
  this->Touched = std::move(joined);
  this->Last = this->Touched.end();
}

/** Processes without a facet of a condition have its place as well. */
void BodyFlows::appendNumbers(std::vector<double*>& sums, std::vector<double*>& least)
{
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    Sums& of = this->of(0, k);
    sums.insert(sums.end(), { &of.all, &of.given, &of.terms, &of.energy, &of.residual, &of.squares,
                              &of.scaled, &of.rounding });
    least.insert(least.end(), { &of.least, &of.most, &of.lowest, &of.highest });
  }
  sums.push_back(&this->Screened[0]);
  for (std::int32_t condition = 0; condition < this->Conditions; ++condition)
  {
    sums.push_back(&this->Touched.try_emplace({ condition, 0 }, 0.0).first->second);
  }
}

} // namespace smg
