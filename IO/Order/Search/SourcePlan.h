// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Memory/Buffer.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The cost of streaming a breadth-first order: mainly the mean of its windows, which all levels of
 * a solver have in memory, and to a small part the largest one. */
inline double searchCost(double meanQueue, double peakQueue)
{
  return 0.9 * meanQueue + 0.1 * peakQueue;
}

/** Distances, in edges, from candidates for sources to the samples of a connected component. */
class SourceDistances
{
public:
  SourceDistances(Workspace& workspace, std::size_t samples, std::size_t maxCandidates)
    : Samples(samples)
    , Memory(workspace.pool(), samples * maxCandidates * sizeof(std::int32_t))
  {
  }

  /** Adds a candidate, up to the reserved number; returns the destination of its distances. */
  std::int32_t* add()
  {
    assert((this->Candidates + 1) * this->Samples * sizeof(std::int32_t) <= this->Memory.size());
    return this->row(this->Candidates++);
  }

  std::size_t samples() const { return this->Samples; }
  std::size_t candidates() const { return this->Candidates; }
  std::span<const std::int32_t> operator[](std::size_t candidate) const
  {
    return { this->row(candidate), this->Samples };
  }

private:
  std::int32_t* row(std::size_t candidate) const
  {
    return reinterpret_cast<std::int32_t*>(this->Memory.data()) + candidate * this->Samples;
  }

  std::size_t Samples;
  std::size_t Candidates = 0;
  Buffer Memory;
};

/** A candidate from which a search starts when it has reached a level. */
struct PlannedSource
{
  std::size_t candidate;
  std::int32_t level;
};

/** A multi-source search and its expected cost. */
struct SourcePlan
{
  std::vector<PlannedSource> sources;
  double cost = 0;
};

/** The memory in bytes with which planSources() makes as many plans at once as there are threads; a
 * part of it is enough to make them one after another. */
std::int64_t sourcePlanMemory(std::size_t samples, int threads);

/**
 * Chooses sources and the levels at which they begin so that the levels of the search, which are
 * known at the samples, are small: each of the best single candidates is joined by others as long
 * as that reduces the cost. Deterministic.
 * @param vertices of the component
 * @return plans of one or more sources, the one with the smallest expected cost first
 */
std::vector<SourcePlan> planSources(
  const SourceDistances& distances, std::int64_t vertices, Workspace& workspace);

/**
 * The points at the ends of their two longest principal axes: four sets, or fewer if an axis has no
 * extent.
 * @param points x, y, z each
 * @param chosen which of them count, at least one
 * @return sets of at least two of the chosen points
 */
std::vector<std::vector<std::uint32_t>> axisEnds(
  std::span<const float> points, std::span<const std::uint32_t> chosen);

} // namespace smg
