// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SearchPlan.h"

#include "IO/External/Relabelling.h"
#include "IO/Order/Search/SourcePlan.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <optional>

// Planning the search of a component: landmarks, distances, plans, trials.
//
// Landmarks are the ends of a double sweep and then, each time, the sample that is farthest from
// all of them; the ends of the two longest principal axes are candidates, too, as sets of sources.
// A search from each measures the exact distances to a sample of the vertices, and its own cost.
// Plans of several sources are made from the distances and tried out, since samples are incomplete;
// the best of all that was measured is returned, so it is never worse than a single source.
//
// A search costs a pass over the adjacency of the component (about 10 bytes per vertex of a
// surface). If the cache has all pages, helpers search at the same time on other threads; the
// results that are used do not depend on that.

namespace smg
{

namespace
{

constexpr int MaxAxisEnds = 4;
/** The ends of a double sweep. */
constexpr int SweepEnds = 2;
/** The minimum distance between landmarks. */
constexpr std::int32_t MinDistance = 8;
/** The minimum samples of a component for a plan, and for its principal axes. */
constexpr std::size_t MinSamples = 16, MinSamplesForAxes = 100;
/** More samples do not make better plans. */
constexpr std::size_t MaxSamples = 8192;
/** The number of tested plans. */
constexpr std::size_t MaxTrials = 4;

std::size_t sampleCount(const PagedMesh& mesh)
{
  return static_cast<std::size_t>(
    (mesh.pages.vertices() + mesh.sampleStride - 1) / mesh.sampleStride);
}

/** A possible start of a search, a vertex or a set of vertices, with the cost of a search from
 * there alone. */
struct Candidate
{
  std::vector<SearchSource> sources;
  SearchResult result;

  double cost() const { return searchCost(this->result.meanQueue, double(this->result.peakQueue)); }
};

/** A candidate that a helper may search while others are searched, and the levels that it finds. */
struct Trial
{
  std::vector<SearchSource> sources;
  std::span<std::uint32_t> levels;
  std::optional<SearchResult> result;
};

class Planning
{
public:
  Planning(
    PagedSearch& search, const PagedMesh& mesh, Workspace& workspace, int landmarks, int helpers)
    : Search(search)
    , Mesh(mesh)
    , Space(workspace)
    , Landmarks(static_cast<std::size_t>(std::max(landmarks, SweepEnds)))
    , LevelMemory(workspace.pool(), levelRows(helpers) * sampleCount(mesh) * sizeof(std::uint32_t))
    , Levels(this->levelRow(0))
    , Samples(workspace)
    , Nearest(workspace)
  {
    for (int i = 0; i < helpers; ++i)
    {
      this->Helpers.push_back(search.another());
    }
  }

  static std::size_t levelRows(int helpers) { return helpers > 0 ? 1 + MaxAxisEnds : 1; }

  std::vector<SearchSource> plan(std::uint32_t end)
  {
    // The search that was made last has reached exactly the component.
    assert(this->Search.reached(end));
    this->First = end;
    this->beginSamples();
    std::vector<Trial> ends;
    if (this->Samples.size() >= MinSamples)
    {
      ends = this->axisEndTrials();
      this->searchTogether(ends);
    }
    while (this->measureNext([this](auto&... probed) { return this->Search.probe(probed...); }))
    {
    }
    // What helpers have not measured is searched here. The order of the candidates, which decides
    // ties, is the same in both cases.
    for (Trial& end : ends)
    {
      end.result ? this->add(std::move(end.sources), *end.result, end.levels)
                 : this->measure(std::move(end.sources));
    }
    Candidate best = *std::ranges::min_element(this->Candidates, {}, &Candidate::cost);
    if (this->Samples.size() >= MinSamples)
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

  std::span<std::uint32_t> levelRow(std::size_t row) const
  {
    // Row 0 is for this search, the others for helpers.
    const std::size_t count = sampleCount(this->Mesh);
    return { reinterpret_cast<std::uint32_t*>(this->LevelMemory.data()) + row * count, count };
  }

  /** Makes a candidate of a set of vertices. */
  void measure(std::vector<SearchSource> sources)
  {
    const SearchResult result = this->Search.probe(sources, this->Levels, this->Mesh.sampleStride);
    this->add(std::move(sources), result, this->Levels);
  }

  void add(std::vector<SearchSource> sources, const SearchResult& result,
    std::span<const std::uint32_t> levels)
  {
    this->Candidates.push_back({ std::move(sources), result });
    std::int32_t* distances = this->Distances->add();
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      // All samples are in the component, so each has been reached.
      distances[i] = static_cast<std::int32_t>(levels[this->Samples[i]]);
      this->Nearest[i] = std::min(this->Nearest[i], distances[i]);
    }
  }

  /** Finds the samples of the component: those that the last search has reached, at most about
   * twice MaxSamples. */
  void beginSamples()
  {
    const auto count = static_cast<std::uint32_t>(this->Levels.size());
    const auto stride = static_cast<std::uint32_t>(this->Mesh.sampleStride);
    std::size_t reached = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      reached += this->Search.reached(i * stride) ? 1 : 0;
    }
    const std::size_t step = std::max<std::size_t>(1, reached / MaxSamples);
    std::size_t seen = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      if (this->Search.reached(i * stride) && seen++ % step == 0)
      {
        this->Samples.push(i);
        this->Nearest.push(std::numeric_limits<std::int32_t>::max());
      }
    }
    this->Distances.emplace(this->Space, this->Samples.size(), this->Landmarks + MaxAxisEnds);
  }

  /** The sources of the next search: the first end; the last vertex of the search from there; then
   * landmarks, each the sample farthest from all before. Empty: there are enough, or the rest lies
   * near one of them. */
  std::vector<SearchSource> nextSources()
  {
    if (this->Candidates.empty())
    {
      return { { 0, this->First } };
    }
    if (this->Candidates.size() == 1)
    {
      return { { 0, this->Candidates[0].result.last } };
    }
    if (this->Samples.size() < MinSamples || this->Candidates.size() >= this->Landmarks)
    {
      return {};
    }
    const std::span<const std::int32_t> nearest = this->Nearest.all();
    const auto farthest = std::ranges::max_element(nearest);
    return *farthest < MinDistance
             ? std::vector<SearchSource>()
             : std::vector{ this->sample(std::size_t(farthest - nearest.begin())) };
  }

  /** Measures the distances from the next sources by `probe`. Returns false if there are no more,
   * or it had no result. */
  template <class Probe>
  bool measureNext(Probe&& probe)
  {
    std::vector<SearchSource> sources = this->nextSources();
    if (sources.empty())
    {
      return false;
    }
    const std::optional<SearchResult> result =
      probe(sources, this->Levels, this->Mesh.sampleStride);
    if (result)
    {
      this->add(std::move(sources), *result, this->Levels);
    }
    return result.has_value();
  }

  std::vector<Trial> axisEndTrials() const
  {
    std::vector<Trial> trials;
    if (this->Samples.size() < MinSamplesForAxes ||
        this->Mesh.samples.size() < 3 * this->Levels.size())
    {
      return trials;
    }
    for (const std::vector<std::uint32_t>& end : axisEnds(this->Mesh.samples, this->Samples.all()))
    {
      Trial& trial = trials.emplace_back();
      for (const std::uint32_t sample : end)
      {
        trial.sources.push_back(
          { 0, sample * static_cast<std::uint32_t>(this->Mesh.sampleStride) });
      }
      trial.levels = this->Helpers.empty() ? this->Levels : this->levelRow(trials.size());
    }
    return trials;
  }

  /** Helpers search from the ends of the axes while this thread searches from the landmarks, each
   * of which depends on the ones before. Without helpers, or if the cache lacks a page, some
   * searches are left to be made. */
  void searchTogether(std::vector<Trial>& ends)
  {
    const auto helpers = static_cast<int>(std::min(this->Helpers.size(), ends.size()));
    if (helpers == 0)
    {
      return;
    }
    runAll(this->Space.workers(), 1 + helpers,
      [&](int task)
      {
        if (task == 0)
        {
          while (this->measureNext(
            [this](auto&... probed) { return this->Search.probeLoaded(probed...); }))
          {
          }
          return;
        }
        PagedSearch& helper = *this->Helpers[static_cast<std::size_t>(task) - 1];
        for (auto i = static_cast<std::size_t>(task) - 1; i < ends.size();
             i += static_cast<std::size_t>(helpers))
        {
          ends[i].result =
            helper.probeLoaded(ends[i].sources, ends[i].levels, this->Mesh.sampleStride);
        }
      });
  }

  /** Tries out the most promising plans by searches, since their cost was predicted from a sample.
   * The plans are taken in the order of their predictions; one that is not expected to cost less
   * than the best measured one is skipped. */
  void tryPlans(Candidate& best)
  {
    const std::vector<SourcePlan> plans =
      planSources(*this->Distances, best.result.vertices, this->Space);
    const auto isPromising = [&best](const SourcePlan& plan)
    { return plan.sources.size() > 1 && plan.cost < best.cost(); };
    std::vector<Trial> trials(std::min(plans.size(), MaxTrials));
    for (std::size_t i = 0; i < trials.size(); ++i)
    {
      if (!isPromising(plans[i]))
      {
        continue;
      }
      // This plan and following ones that are promising are probed at the same time, one on each
      // search. Results of plans that turn out not to be promising are not used: with any number of
      // helpers the same plan wins.
      if (!trials[i].result)
      {
        std::vector<Trial*> next; // which are tested at the same time
        for (std::size_t k = i; k < trials.size() && next.size() <= this->Helpers.size(); ++k)
        {
          if (isPromising(plans[k]))
          {
            trials[k].sources = this->sourcesOf(plans[k]);
            next.push_back(&trials[k]);
          }
        }
        this->probeTogether(next);
      }
      const Candidate planned{ trials[i].sources, *trials[i].result };
      best = planned.cost() < best.cost() ? planned : best;
    }
  }

  /** Probes from at most as many sets of sources as there are searches; the first one certainly
   * gets a result. */
  void probeTogether(const std::vector<Trial*>& trials)
  {
    if (trials.size() > 1)
    {
      runAll(this->Space.workers(), static_cast<int>(trials.size()),
        [&](int task)
        {
          const auto i = static_cast<std::size_t>(task);
          PagedSearch& search = i == 0 ? this->Search : *this->Helpers[i - 1];
          trials[i]->result = search.probeLoaded(trials[i]->sources);
        });
    }
    if (!trials.front()->result)
    {
      trials.front()->result = this->Search.probe(trials.front()->sources);
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
  std::uint32_t First = 0; ///< rank
  Buffer LevelMemory;
  const std::span<std::uint32_t> Levels; ///< of all samples of the mesh in the last search
  GrowingArray<std::uint32_t> Samples;   ///< numbers of the samples in the component
  GrowingArray<std::int32_t> Nearest;    ///< distance of each to the nearest candidate
  std::vector<Candidate> Candidates;
  std::optional<SourceDistances> Distances;
  std::vector<std::unique_ptr<PagedSearch>> Helpers;
};

} // namespace

std::int64_t searchPlanMemory(const PagedMesh& mesh, int landmarks, int threads, int helpers)
{
  // Rows of numbers: levels; samples and nearest, which grow and so may take three times their
  // size; distances.
  const std::int64_t rows = std::int64_t(Planning::levelRows(helpers)) + 2 * 3 +
                            std::max(landmarks, SweepEnds) + MaxAxisEnds;
  return rows * std::int64_t(sampleCount(mesh) * sizeof(std::uint32_t)) +
         sourcePlanMemory(sampleCount(mesh), threads) + 4096;
}

std::vector<SearchSource> planSearch(PagedSearch& search, const PagedMesh& mesh,
  Workspace& workspace, int landmarks, std::uint32_t end, int helpers)
{
  return Planning(search, mesh, workspace, landmarks, helpers).plan(end);
}

} // namespace smg
