// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/SourcePlan.h"

#include "Solver/Storage/Buffer.h"

#include <algorithm>
#include <array>
#include <limits>

namespace smg
{

namespace
{

using Levels = std::span<std::int32_t>;

constexpr std::int32_t MostBins = 150;
/** Single candidates that plans are begun with. */
constexpr std::size_t Beginnings = 4;
constexpr std::size_t MostSources = 9;
/** Start levels that are tried for one more source. */
constexpr int LevelSteps = 12;
/** What one more source, and a change of a level, must gain to be worth it. */
constexpr double SourceGain = 0.993, LevelGain = 0.999;

/** Estimates the cost of a search from the levels of the samples. */
class LevelCost
{
public:
  LevelCost(std::size_t samples, std::int64_t vertices)
    : VerticesPerSample(double(vertices) / double(samples))
    , Samples(samples)
  {
  }

  /** The levels are not negative. */
  double operator()(std::span<const std::int32_t> levels)
  {
    const std::int32_t last = *std::ranges::max_element(levels);
    const std::int32_t width = std::max(1, (last + MostBins) / MostBins);
    const auto bins = static_cast<std::size_t>(last / width) + 1;
    std::fill_n(this->Bins.begin(), bins, 0);
    const float scale = 1.0f / static_cast<float>(width);
    for (const std::int32_t level : levels)
    {
      ++this->Bins[static_cast<std::size_t>((static_cast<float>(level) + 0.5f) * scale)];
    }
    return this->costOfBins(bins, this->VerticesPerSample / width);
  }

private:
  double costOfBins(std::size_t bins, double verticesPerCount) const
  {
    double squares = 0, peak = 0;
    for (std::size_t i = 0; i < bins; ++i)
    {
      const double count = this->Bins[i];
      squares += count * count;
      // Smoothed, for a bin has few samples; the last one is not full.
      const bool isInside = bins > 4 && i > 0 && i + 1 < bins;
      const double smooth = isInside
                              ? 0.25 * this->Bins[i - 1] + 0.5 * count + 0.25 * this->Bins[i + 1]
                              : (i + 1 < bins ? count : 0);
      peak = std::max(peak, smooth);
    }
    return searchCost(squares / double(this->Samples), peak) * verticesPerCount;
  }

  double VerticesPerSample;
  std::size_t Samples;
  std::array<std::int32_t, MostBins + 2> Bins;
};

class Planner
{
public:
  Planner(const SourceDistances& distances, std::int64_t vertices, Workspace& workspace)
    : Distances(distances)
    , Cost(distances.samples(), vertices)
    , Memory(workspace.pool(), 2 * distances.samples() * sizeof(std::int32_t))
    , Current(reinterpret_cast<std::int32_t*>(this->Memory.data()), distances.samples())
    , Tried(this->Current.data() + distances.samples(), distances.samples())
  {
  }

  SourcePlan single(std::size_t candidate)
  {
    return { { { candidate, 0 } }, this->Cost(this->Distances[candidate]) };
  }

  /** Joins sources to a plan while that helps. */
  void extend(SourcePlan& plan)
  {
    this->evaluate(plan, this->Current);
    while (plan.sources.size() < MostSources && this->addSource(plan))
    {
      this->evaluate(plan, this->Current);
      this->adjustLevels(plan);
      this->adjustLevels(plan);
    }
  }

private:
  /** The levels that the search of a plan gives the samples. */
  void evaluate(const SourcePlan& plan, Levels levels) const
  {
    std::ranges::fill(levels, std::numeric_limits<std::int32_t>::max());
    for (const PlannedSource& source : plan.sources)
    {
      join(levels, levels, source.level, this->Distances[source.candidate]);
    }
  }
  static void join(std::span<const std::int32_t> levels, Levels joined, std::int32_t level,
    std::span<const std::int32_t> distances)
  {
    for (std::size_t i = 0; i < joined.size(); ++i)
    {
      joined[i] = std::min(levels[i], level + distances[i]);
    }
  }

  bool addSource(SourcePlan& plan)
  {
    double best = plan.cost * SourceGain;
    PlannedSource added{ this->Distances.candidates(), 0 };
    for (std::size_t candidate = 0; candidate < this->Distances.candidates(); ++candidate)
    {
      const std::span<const std::int32_t> distances = this->Distances[candidate];
      std::int64_t latest = 0; // a source that begins later is reached before
      for (std::size_t i = 0; i < distances.size(); ++i)
      {
        latest = std::max<std::int64_t>(latest, this->Current[i] - distances[i]);
      }
      for (int step = 0; step < LevelSteps && latest > 1; ++step)
      {
        const auto level = static_cast<std::int32_t>(latest * step / LevelSteps);
        join(this->Current, this->Tried, level, distances);
        if (const double cost = this->Cost(this->Tried); cost < best)
        {
          best = cost;
          added = { candidate, level };
        }
      }
    }
    if (added.candidate == this->Distances.candidates())
    {
      return false;
    }
    plan.sources.push_back(added);
    plan.cost = best;
    return true;
  }

  /** Moves the level of each source to and fro, and keeps what is better. */
  void adjustLevels(SourcePlan& plan)
  {
    for (std::size_t i = 0; i < plan.sources.size(); ++i)
    {
      for (const double share : { -0.04, 0.04, -0.015, 0.015 })
      {
        const std::int32_t range = *std::ranges::max_element(this->Current);
        SourcePlan changed = plan;
        changed.sources[i].level += static_cast<std::int32_t>(share * range);
        const std::int32_t first =
          std::ranges::min_element(changed.sources, {}, &PlannedSource::level)->level;
        for (PlannedSource& source : changed.sources)
        {
          source.level -= first;
        }
        this->evaluate(changed, this->Tried);
        changed.cost = this->Cost(this->Tried);
        if (changed.cost < plan.cost * LevelGain)
        {
          plan = std::move(changed);
          std::swap(this->Current, this->Tried);
        }
      }
    }
  }

  const SourceDistances& Distances;
  LevelCost Cost;
  Buffer Memory;
  Levels Current; ///< of the plan that is being extended
  Levels Tried;
};

} // namespace

SourcePlan planSources(
  const SourceDistances& distances, std::int64_t vertices, Workspace& workspace)
{
  Planner planner(distances, vertices, workspace);
  std::vector<SourcePlan> singles;
  for (std::size_t candidate = 0; candidate < distances.candidates(); ++candidate)
  {
    singles.push_back(planner.single(candidate));
  }
  std::ranges::stable_sort(singles, {}, &SourcePlan::cost);
  singles.resize(std::min(singles.size(), Beginnings));
  for (SourcePlan& plan : singles)
  {
    planner.extend(plan);
  }
  return *std::ranges::min_element(singles, {}, &SourcePlan::cost);
}

} // namespace smg
