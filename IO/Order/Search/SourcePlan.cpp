// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SourcePlan.h"

#include "Solver/Memory/Buffer.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <limits>

// Choosing the sources of a multi-source breadth-first search and the levels at which they start.
//
// From the distances D_k of the candidates k to a sample of the vertices, the levels of the search
// with sources (k, t_k) follow exactly at the samples: min over k of t_k + D_k. The number of
// vertices of a level is the length of the queue, hence the window of the order there; so a
// histogram of the levels of the samples gives the cost of a plan without a search. Sources are
// added greedily to the best single candidates, their levels varied, and useless ones dropped.
//
// Time is proportional to samples, candidates and trials, and independent of the size of the mesh.
// Everything is deterministic: ties go to the candidate that comes first.

namespace smg
{
namespace
{

using Levels = std::span<std::int32_t>;

constexpr std::int32_t MaxBins = 150;
/** The number of single candidates from which plans are extended. */
constexpr int Beginnings = 4;
constexpr std::size_t MaxSources = 24;
/** The head starts that are tried for a further source, as shares of all levels: how long it begins
 * before the others reach it. Mostly small: such a source straightens the arriving front, whereas
 * one that begins early has a front of its own. */
constexpr double HeadStarts[] = { 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.17, 0.25, 0.35, 0.5, 0.7,
  1.0 };
/** The number of rounds in which the levels are adjusted after each addition, and the changes that
 * are tried, as shares of all levels. */
constexpr int AdjustRounds = 2;
constexpr double Adjustments[] = { -0.1, 0.1, -0.04, 0.04, -0.015, 0.015, -0.005, 0.005 };
/** The factor of the cost that a further source, and a change of a level, must reach: smaller gains
 * are noise of the sample. */
constexpr double SourceGain = 0.998, LevelGain = 0.9997;

/** Estimates the cost of a search from the levels of the samples, by a histogram with at most
 * MaxBins bins. */
class LevelCost
{
public:
  LevelCost(std::size_t samples, std::int64_t vertices)
    : VerticesPerSample(double(vertices) / double(samples))
    , Samples(samples)
  {
  }

  /** The cost of a search whose levels are all from `first` to `last`. */
  double operator()(std::span<const std::int32_t> levels, std::int32_t first, std::int32_t last)
  {
    const std::int32_t width = std::max(1, (last - first + MaxBins) / MaxBins);
    const auto bins = static_cast<std::size_t>((last - first) / width) + 1;
    std::fill_n(this->Bins.begin(), bins, 0);
    // In double precision, so that rounding does not put the last level of a long mesh beyond the
    // bins.
    const double scale = 1.0 / width;
    for (const std::int32_t level : levels)
    {
      ++this->Bins[static_cast<std::size_t>((level - first + 0.5) * scale)];
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
      // The mean window over all vertices: each vertex of a level sees the whole level.
      squares += count * count;
      // The peak is smoothed, since a bin has few samples; the last bin is not full.
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
  std::array<std::int32_t, MaxBins> Bins;
};

/** Extends plans. Two rows of levels suffice: one for the plan, one for the change that is
 * tried. */
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
    const std::span<const std::int32_t> distances = this->Distances[candidate];
    return { { { candidate, 0 } }, this->Cost(distances, 0, *std::ranges::max_element(distances)) };
  }

  /** Adds sources to a plan while this reduces the cost. */
  void extend(SourcePlan& plan)
  {
    // Current has the levels of the plan throughout: a trial adds a source to these by one pass
    // over the samples.
    this->Last = this->evaluate(plan, this->Current);
    for (std::size_t added = 1; added < MaxSources && this->addSource(plan); ++added)
    {
      this->Last = this->evaluate(plan, this->Current);
      for (int round = 0; round < AdjustRounds; ++round)
      {
        this->adjustLevels(plan);
      }
      this->dropSources(plan);
    }
  }

private:
  /** Computes the levels of the samples in the search of a plan; returns the largest of them. */
  std::int32_t evaluate(const SourcePlan& plan, Levels levels) const
  {
    std::ranges::fill(levels, std::numeric_limits<std::int32_t>::max());
    std::int32_t last = 0;
    for (const PlannedSource& source : plan.sources)
    {
      last = join(levels, levels, source.level, this->Distances[source.candidate]);
    }
    return last;
  }
  static std::int32_t join(std::span<const std::int32_t> levels, Levels joined, std::int32_t level,
    std::span<const std::int32_t> distances)
  {
    std::int32_t last = 0;
    for (std::size_t i = 0; i < joined.size(); ++i)
    {
      joined[i] = std::min(levels[i], level + distances[i]);
      last = std::max(last, joined[i]);
    }
    return last;
  }

  bool addSource(SourcePlan& plan)
  {
    double best = plan.cost * SourceGain;
    PlannedSource added{ this->Distances.candidates(), 0 };
    for (std::size_t candidate = 0; candidate < this->Distances.candidates(); ++candidate)
    {
      const std::span<const std::int32_t> distances = this->Distances[candidate];
      std::int32_t reached = 0; // a source that starts later has no effect
      for (std::size_t i = 0; i < distances.size(); ++i)
      {
        reached = std::max(reached, this->Current[i] - distances[i]);
      }
      for (const double share : HeadStarts)
      {
        // May be negative: the source then begins before the first one, and all levels are shifted
        // afterwards.
        const std::int32_t level = reached - 1 - static_cast<std::int32_t>(share * this->Last);
        const std::int32_t last = join(this->Current, this->Tried, level, distances);
        const double cost = this->Cost(this->Tried, std::min(0, level), last);
        if (cost < best)
        {
          best = cost;
          added = { candidate, level };
        }
      }
    }
    // No candidate has reduced the cost by enough.
    if (added.candidate == this->Distances.candidates())
    {
      return false;
    }
    plan.sources.push_back(added);
    beginAtZero(plan);
    plan.cost = best;
    return true;
  }

  /** Shifts the levels so that the earliest source begins at level 0. */
  static void beginAtZero(SourcePlan& plan)
  {
    const std::int32_t first =
      std::ranges::min_element(plan.sources, {}, &PlannedSource::level)->level;
    for (PlannedSource& source : plan.sources)
    {
      source.level -= first;
    }
  }

  /** Varies the level of each source, and keeps improvements. */
  void adjustLevels(SourcePlan& plan)
  {
    for (std::size_t i = 0; i < plan.sources.size(); ++i)
    {
      for (const double share : Adjustments)
      {
        SourcePlan changed = plan;
        changed.sources[i].level += static_cast<std::int32_t>(share * this->Last);
        this->takeIfBetter(plan, std::move(changed), LevelGain);
      }
    }
  }

  /** Removes the sources that others have made useless. */
  void dropSources(SourcePlan& plan)
  {
    // From the last to the first, so that the loop goes on where one was erased.
    for (std::size_t i = plan.sources.size(); i-- > 0 && plan.sources.size() > 1;)
    {
      SourcePlan changed = plan;
      changed.sources.erase(changed.sources.begin() + static_cast<std::ptrdiff_t>(i));
      this->takeIfBetter(plan, std::move(changed), 1.0);
    }
  }

  /** Replaces the plan if the cost of the changed one is at most `gain` times its cost. */
  void takeIfBetter(SourcePlan& plan, SourcePlan changed, double gain)
  {
    beginAtZero(changed);
    const std::int32_t last = this->evaluate(changed, this->Tried);
    changed.cost = this->Cost(this->Tried, 0, last);
    if (changed.cost <= plan.cost * gain)
    {
      plan = std::move(changed);
      std::swap(this->Current, this->Tried);
      this->Last = last;
    }
  }

  const SourceDistances& Distances;
  LevelCost Cost;
  Buffer Memory;
  Levels Current;        ///< of the plan under extension
  std::int32_t Last = 0; ///< the greatest of them
  Levels Tried;
};

/** The share of the extent along an axis that counts as its end. */
constexpr double EndShare = 0.015;

Eigen::Vector3d point(std::span<const float> points, std::uint32_t i)
{
  const float* x = points.data() + std::size_t(3) * i;
  return { x[0], x[1], x[2] };
}

} // namespace

std::int64_t sourcePlanMemory(std::size_t samples, int threads)
{
  const std::int64_t planners = std::min(threads, Beginnings);
  return planners * 2 * static_cast<std::int64_t>(samples * sizeof(std::int32_t));
}

std::vector<SourcePlan> planSources(
  const SourceDistances& distances, std::int64_t vertices, Workspace& workspace)
{
  std::vector<SourcePlan> plans;
  {
    Planner planner(distances, vertices, workspace);
    for (std::size_t candidate = 0; candidate < distances.candidates(); ++candidate)
    {
      plans.push_back(planner.single(candidate));
    }
  }
  std::ranges::stable_sort(plans, {}, &SourcePlan::cost);
  plans.resize(std::min(plans.size(), std::size_t(Beginnings)));
  Workers& workers = workspace.workers();
  const std::int64_t needed = sourcePlanMemory(distances.samples(), workers.threads());
  // Where the memory does not suffice for several planners, they work one after another.
  Workers alone(1);
  runAll(workspace.available() >= needed ? workers : alone, static_cast<int>(plans.size()),
    [&](int i)
    {
      Planner planner(distances, vertices, workspace);
      // Each plan has a planner of its own, so the result does not depend on the thread or the
      // order.
      planner.extend(plans[static_cast<std::size_t>(i)]);
    });
  std::ranges::stable_sort(plans, {}, &SourcePlan::cost);
  return plans;
}

std::vector<std::vector<std::uint32_t>> axisEnds(
  std::span<const float> points, std::span<const std::uint32_t> chosen)
{
  std::vector<std::vector<std::uint32_t>> ends;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen)
  {
    centre += point(points, i) / double(chosen.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen)
  {
    const Eigen::Vector3d x = point(points, i) - centre;
    covariance += x * x.transpose() / double(chosen.size());
  }
  if (!covariance.allFinite())
  {
    return ends; // a coordinate exceeded the range of float
  }
  // Eigenvalues ascend: columns 2 and 1 are the two longest axes.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  for (const int axis : { 2, 1 })
  {
    const Eigen::Vector3d direction = axes.eigenvectors().col(axis);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const std::uint32_t i : chosen)
    {
      const double x = direction.dot(point(points, i) - centre);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    // The extent along this axis is 0, or not a number.
    if (!(low < high))
    {
      break;
    }
    std::vector<std::uint32_t> lowEnd, highEnd;
    for (const std::uint32_t i : chosen)
    {
      const double x = (direction.dot(point(points, i) - centre) - low) / (high - low);
      if (x < EndShare)
      {
        lowEnd.push_back(i);
      }
      else if (x > 1 - EndShare)
      {
        highEnd.push_back(i);
      }
    }
    ends.push_back(std::move(lowEnd));
    ends.push_back(std::move(highEnd));
  }
  std::erase_if(ends, [](const std::vector<std::uint32_t>& end) { return end.size() < 2; });
  return ends;
}

} // namespace smg
