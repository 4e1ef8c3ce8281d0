// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedComponents.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

// The connected components of a mesh in parts. Each process finds the components of its own cells;
// labels that two processes have at the same vertex belong together.
//
// Only labels that meet others are known to all processes ("split"): their pairs are gathered, and
// every process joins them in the same order, so all have the same sets. The components that lie
// within one process ("whole") stay there. Memory and messages grow with the number of labels at
// the interfaces, not with the number of vertices.

namespace smg
{

SharedComponents::SharedComponents(const SharedVertices& vertices,
  std::span<const std::int32_t> labels, std::int32_t count, int columns)
  : Vertices(vertices)
  , Columns(columns)
  , Whole(columns)
  , Split(columns)
  , WholeLabels(static_cast<std::size_t>(count), -1)
{
  this->findSplit(this->namesOf(labels, count));
}

/** Numbers the labels of all processes consecutively, process by process, so that each has a name
 * of its own. */
std::vector<std::int64_t> SharedComponents::namesOf(
  std::span<const std::int32_t> labels, std::int32_t count)
{
  Team& team = this->Vertices.team();
  const std::vector<std::int32_t> counts = team.gather(std::vector<std::int32_t>{ count });
  for (int p = 0; p < team.rank(); ++p)
  {
    this->FirstName += counts[static_cast<std::size_t>(p)];
  }
  std::vector<std::int64_t> names(labels.size());
  std::ranges::transform(labels, names.begin(),
    [this](std::int32_t label) { return label < 0 ? -1 : this->FirstName + label; });
  return names;
}

/** Joins the labels that processes have at the same vertex, as seen by its owner. */
void SharedComponents::findSplit(const std::vector<std::int64_t>& names)
{
  using Pair = std::array<std::int64_t, 2>;
  this->Names.assign(names.begin() + this->Vertices.begin(), names.begin() + this->Vertices.end());
  std::vector<Pair> pairs;
  this->Vertices.collect(std::span<const std::int64_t>(names),
    [&](std::int64_t vertex, std::int64_t name)
    {
      if (name < 0)
      {
        return;
      }
      // The cells of the owner may have no weight, so that it has no label there: then the vertex
      // belongs to the component of another process.
      std::int64_t& own = this->Names[static_cast<std::size_t>(vertex - this->Vertices.begin())];
      own = own < 0 ? name : own;
      const Pair pair{ std::min(own, name), std::max(own, name) };
      // Neighbouring vertices mostly repeat the same pair.
      if (pairs.empty() || pairs.back() != pair)
      {
        pairs.push_back(pair);
      }
    });
  const auto removeCopies = [](auto& items)
  {
    std::ranges::sort(items);
    items.erase(std::unique(items.begin(), items.end()), items.end());
  };
  removeCopies(pairs);
  // From here on all processes have the same list.
  pairs = this->Vertices.team().gather(pairs);
  for (const Pair& pair : pairs)
  {
    this->SplitNames.insert(this->SplitNames.end(), pair.begin(), pair.end());
  }
  removeCopies(this->SplitNames);
  // The labels of Split are the places in SplitNames.
  for (std::size_t k = 0; k < this->SplitNames.size(); ++k)
  {
    this->Split.add();
  }
  const auto labelOf = [this](std::int64_t name)
  {
    return static_cast<std::int32_t>(
      std::ranges::lower_bound(this->SplitNames, name) - this->SplitNames.begin());
  };
  for (const Pair& pair : pairs)
  {
    this->Split.join(labelOf(pair[0]), labelOf(pair[1]));
  }
}

SharedComponents::Place SharedComponents::of(std::int64_t k)
{
  const std::int64_t name = this->Names[static_cast<std::size_t>(k)];
  if (name < 0)
  {
    return {};
  }
  const auto place = std::ranges::lower_bound(this->SplitNames, name);
  if (place != this->SplitNames.end() && *place == name)
  {
    return { &this->Split,
      this->Split.root(static_cast<std::int32_t>(place - this->SplitNames.begin())) };
  }
  // Labels of Whole are given out when a vertex first asks for them.
  std::int32_t& label = this->WholeLabels[static_cast<std::size_t>(name - this->FirstName)];
  label = label < 0 ? this->Whole.add() : label;
  return { &this->Whole, label };
}

/** Whole is complete on this process. Split has the same labels on all processes, so its sums over
 * the vertices of each are added label by label. */
void SharedComponents::combine()
{
  this->Whole.anchorHeld();
  this->Split.combine([this](std::span<double> sums) { this->Vertices.team().sum(sums); });
  this->Split.anchorHeld();
}

std::int64_t SharedComponents::components() const
{
  std::int64_t count = this->Whole.components();
  this->Vertices.team().sum({ &count, 1 });
  return count + this->Split.components();
}

std::int64_t SharedComponents::freeComponents() const
{
  std::int64_t count = this->Whole.freeComponents();
  this->Vertices.team().sum({ &count, 1 });
  return count + this->Split.freeComponents();
}

std::int64_t SharedComponents::floatingComponents() const
{
  std::int64_t count = this->Whole.floatingComponents();
  this->Vertices.team().sum({ &count, 1 });
  return count + this->Split.floatingComponents();
}

double SharedComponents::incompatibility() const
{
  double share = std::max(this->Whole.incompatibility(), this->Split.incompatibility());
  this->Vertices.team().largest({ &share, 1 });
  return share;
}

std::vector<double> SharedComponents::shiftedSums() const
{
  std::vector<double> sums = this->Whole.shiftedSums();
  this->Vertices.team().sum(sums);
  const std::vector<double> shared = this->Split.shiftedSums();
  std::ranges::transform(sums, shared, sums.begin(), std::plus<>());
  return sums;
}

/** The vertex with the smallest stream index of each such component: of a split one by a reduction,
 * after which only the process that owns the vertex takes it. */
std::vector<std::int64_t> SharedComponents::representatives(
  const std::function<bool(std::int64_t)>& chosen)
{
  constexpr std::int64_t None = std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> ofWhole(static_cast<std::size_t>(this->Whole.labels()), None);
  std::vector<std::int64_t> ofSplit(static_cast<std::size_t>(this->Split.labels()), None);
  const std::int64_t own = this->Vertices.end() - this->Vertices.begin();
  const auto nameOf = [this](std::int64_t k)
  { return this->Vertices.id(this->Vertices.begin() + k); };
  for (std::int64_t k = 0; k < own; ++k)
  {
    const Place place = this->of(k);
    if (place.components && place.components->hasConstantsInKernel(place.label) && chosen(k))
    {
      std::int64_t& least =
        (place.components == &this->Whole ? ofWhole
                                          : ofSplit)[static_cast<std::size_t>(place.label)];
      least = std::min(least, nameOf(k));
    }
  }
  this->Vertices.team().least(ofSplit);
  std::vector<std::int64_t> found;
  for (const auto* ids : { &ofWhole, &ofSplit })
  {
    for (const std::int64_t id : *ids)
    {
      const std::int64_t vertex = id == None ? -1 : this->Vertices.find(id);
      if (vertex >= 0 && this->Vertices.isOwn(vertex))
      {
        found.push_back(vertex - this->Vertices.begin());
      }
    }
  }
  return found;
}

SharedComponents::Shifts SharedComponents::rightSideShifts() const
{
  return { &this->Whole, this->Whole.rightSideShifts(), this->Split.rightSideShifts() };
}

SharedComponents::Shifts SharedComponents::initialMeans() const
{
  return { &this->Whole, this->Whole.initialMeans(), this->Split.initialMeans() };
}

SharedComponents::Shifts SharedComponents::meanShifts(
  const std::function<double(std::int64_t, int)>& value)
{
  // Sums over the own vertices; for split components they are completed over the processes.
  const auto columns = static_cast<std::size_t>(this->Columns);
  std::vector<double> ofWhole(static_cast<std::size_t>(this->Whole.labels()) * columns);
  std::vector<double> ofSplit(static_cast<std::size_t>(this->Split.labels()) * columns);
  for (std::int64_t k = 0; k < static_cast<std::int64_t>(this->Names.size()); ++k)
  {
    const Place place = this->of(k);
    if (place.components && place.components->isFloating(place.label))
    {
      double* sums = (place.components == &this->Whole ? ofWhole : ofSplit).data() +
                     static_cast<std::size_t>(place.label) * columns;
      for (int column = 0; column < this->Columns; ++column)
      {
        sums[column] += value(k, column);
      }
    }
  }
  this->Vertices.team().sum(ofSplit);
  return { &this->Whole, this->Whole.meanShifts(ofWhole), this->Split.meanShifts(ofSplit) };
}

} // namespace smg
