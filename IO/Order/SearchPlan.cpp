// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/SearchPlan.h"

#include "IO/External/Relabelling.h"
#include "IO/Order/AxisEnds.h"
#include "IO/Order/SourcePlan.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace smg
{

namespace
{

constexpr int MostAxisEnds = 4;
/** The ends of a double sweep. */
constexpr int LeastLandmarks = 2;
/** The minimum distance between landmarks. */
constexpr std::int32_t LeastDistance = 8;
/** The minimum samples of a component for a plan, and for its principal axes. */
constexpr std::size_t LeastSamples = 16, LeastSamplesForAxes = 100;
/** More samples do not make better plans. */
constexpr std::size_t MostSamples = 8192;
/** The number of tested plans. */
constexpr std::size_t MostTrials = 4;

std::size_t sampleCount(const PagedMesh& mesh)
{
  return static_cast<std::size_t>(
    (mesh.pages.vertices() + mesh.sampleStride - 1) / mesh.sampleStride);
}

/** A possible start of a search, a vertex or a set of vertices, and its cost alone. */
struct Candidate
{
  std::vector<SearchSource> sources;
  SearchResult result;

  double cost() const { return searchCost(this->result.meanQueue, double(this->result.peakQueue)); }
};

class Planning
{
public:
  Planning(PagedSearch& search, const PagedMesh& mesh, Workspace& workspace, int landmarks)
    : Search(search)
    , Mesh(mesh)
    , Space(workspace)
    , Landmarks(static_cast<std::size_t>(std::max(landmarks, LeastLandmarks)))
    , LevelMemory(workspace.pool(), sampleCount(mesh) * sizeof(std::uint32_t))
    , Levels(reinterpret_cast<std::uint32_t*>(this->LevelMemory.data()), sampleCount(mesh))
    , Samples(workspace)
    , Nearest(workspace)
  {
  }

  std::vector<SearchSource> plan(std::uint32_t end)
  {
    this->measure({ { 0, end } });
    this->measure({ { 0, this->Candidates[0].result.last } });
    if (this->Samples.size() >= LeastSamples)
    {
      this->measureLandmarks();
      this->measureAxisEnds();
    }
    Candidate best = *std::ranges::min_element(this->Candidates, {}, &Candidate::cost);
    if (this->Samples.size() >= LeastSamples)
    {
      this->tryPlans(best);
    }
    return best.sources;
  }

private:
  SearchSource sample(std::size_t i) const
  {
    return { 0, this->Samples[i] * static_cast<std::uint32_t>(this->Mesh.sampleStride) };
  }

  /** Makes a candidate of a set of vertices. */
  void measure(std::vector<SearchSource> sources)
  {
    const SearchResult result = this->Search.probe(sources, this->Levels, this->Mesh.sampleStride);
    if (this->Candidates.empty())
    {
      this->beginSamples();
    }
    this->Candidates.push_back({ std::move(sources), result });
    std::int32_t* distances = this->Distances->add();
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      distances[i] = static_cast<std::int32_t>(this->Levels[this->Samples[i]]);
      this->Nearest[i] = std::min(this->Nearest[i], distances[i]);
    }
  }

  /** The first search determines which samples are in the component. */
  void beginSamples()
  {
    const auto reached = static_cast<std::size_t>(
      this->Levels.size() - std::size_t(std::ranges::count(this->Levels, NoIndex)));
    const std::size_t step = std::max<std::size_t>(1, reached / MostSamples);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < this->Levels.size(); ++i)
    {
      if (this->Levels[i] != NoIndex && seen++ % step == 0)
      {
        this->Samples.push(static_cast<std::uint32_t>(i));
        this->Nearest.push(std::numeric_limits<std::int32_t>::max());
      }
    }
    this->Distances.emplace(this->Space, this->Samples.size(), this->Landmarks + MostAxisEnds);
  }

  /** Each landmark is the sample farthest from the previous ones. */
  void measureLandmarks()
  {
    while (this->Candidates.size() < this->Landmarks)
    {
      const std::span<const std::int32_t> nearest = this->Nearest.all();
      const auto farthest = std::ranges::max_element(nearest);
      if (*farthest < LeastDistance)
      {
        return;
      }
      this->measure({ this->sample(std::size_t(farthest - nearest.begin())) });
    }
  }

  void measureAxisEnds()
  {
    if (this->Samples.size() < LeastSamplesForAxes ||
        this->Mesh.samples.size() < 3 * this->Levels.size())
    {
      return;
    }
    for (const std::vector<std::uint32_t>& end : axisEnds(this->Mesh.samples, this->Samples.all()))
    {
      std::vector<SearchSource> sources;
      for (const std::uint32_t sample : end)
      {
        sources.push_back({ 0, sample * static_cast<std::uint32_t>(this->Mesh.sampleStride) });
      }
      this->measure(std::move(sources));
    }
  }

  /** Tests the predicted cost of a plan, since samples are incomplete. */
  void tryPlans(Candidate& best)
  {
    const std::vector<SourcePlan> plans =
      planSources(*this->Distances, best.result.vertices, this->Space);
    for (std::size_t i = 0; i < std::min(plans.size(), MostTrials); ++i)
    {
      if (plans[i].sources.size() > 1 && plans[i].cost < best.cost())
      {
        Candidate planned{ this->sourcesOf(plans[i]), {} };
        planned.result = this->Search.probe(planned.sources);
        best = planned.cost() < best.cost() ? planned : best;
      }
    }
  }

  std::vector<SearchSource> sourcesOf(const SourcePlan& plan) const
  {
    std::vector<SearchSource> sources;
    for (const PlannedSource& planned : plan.sources)
    {
      for (const SearchSource& source : this->Candidates[planned.candidate].sources)
      {
        sources.push_back({ static_cast<std::uint32_t>(planned.level), source.rank });
      }
    }
    std::ranges::stable_sort(sources, {}, &SearchSource::level);
    return sources;
  }

  PagedSearch& Search;
  const PagedMesh& Mesh;
  Workspace& Space;
  const std::size_t Landmarks;
  Buffer LevelMemory;
  const std::span<std::uint32_t> Levels; ///< of all samples of the mesh in the last search
  GrowingArray<std::uint32_t> Samples;   ///< those of the component
  GrowingArray<std::int32_t> Nearest;    ///< distance of each to the nearest candidate
  std::vector<Candidate> Candidates;
  std::optional<SourceDistances> Distances;
};

} // namespace

std::int64_t searchPlanMemory(const PagedMesh& mesh, int landmarks, int threads)
{
  // Rows of numbers: levels, samples, nearest (which grow), distances.
  const std::int64_t rows = 1 + 2 * 3 + std::max(landmarks, LeastLandmarks) + MostAxisEnds;
  return rows * std::int64_t(sampleCount(mesh) * sizeof(std::uint32_t)) +
         sourcePlanMemory(sampleCount(mesh), threads) + 4096;
}

std::vector<SearchSource> planSearch(PagedSearch& search, const PagedMesh& mesh,
  Workspace& workspace, int landmarks, std::uint32_t end)
{
  return Planning(search, mesh, workspace, landmarks).plan(end);
}

} // namespace smg
