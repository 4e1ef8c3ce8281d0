// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/NearestSelection.h"

#include "Solver/Jobs/Projection/PointTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

// The vertices nearest to given points, found by a reading of the stream beforehand.
//
// Vertices are searched in batches. Each point is compared with the bounding box of the batch
// first; only if that is nearer than the nearest vertex so far, a k-d tree of the batch is built
// (once) and searched. Of equally near vertices the first in the stream counts: within a batch the
// tree finds the lowest index, and a later batch must be strictly nearer. So the result does not
// depend on where batches end, which does depend on the blocks. A batch has at least as many
// vertices as there are points, so that the comparisons with its box take no longer than the tree.

namespace smg
{

namespace
{

/** The least number of vertices that are searched at once, however small the blocks are; for more
 * points than this, as many vertices as points. */
constexpr std::size_t BatchVertices = 8192;

} // namespace

NearestSelection::NearestSelection(const NearestVertices& nearest, DataPlace place,
  const std::string& key, const MeshColumns& columns)
  : Selection(place, key, columns)
  , Points(nearest.points)
{
  NearestSelection::begin();
  const auto isFinite = [](const std::array<double, 3>& p)
  { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); };
  // NaN would be nearest to no vertex, and infinity equally near to all of them.
  if (this->Points.empty() || !std::ranges::all_of(this->Points, isFinite))
  {
    columns.fail(key + ".nearest", "must have at least one point, and finite coordinates");
  }
}

void NearestSelection::begin()
{
  this->Selection::begin();
  this->Batch.clear();
  this->BatchBegin = 0;
  this->Distances.assign(this->Points.size(), std::numeric_limits<double>::infinity());
  this->Vertices.assign(this->Points.size(), -1);
}

/** Collects vertices until they are enough for a batch. A tree of few vertices would not pay. */
void NearestSelection::add(const MeshBlock& block, const std::filesystem::path& /*scratch*/)
{
  // Whole blocks, in order: a vertex has the index BatchBegin plus its place in the batch.
  this->Batch.insert(this->Batch.end(), block.positions.begin(), block.positions.end());
  if (this->Batch.size() >= 3 * std::max(BatchVertices, this->Points.size()))
  {
    this->searchBatch();
  }
}

void NearestSelection::searchBatch()
{
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < this->Batch.size(); ++i)
  {
    low[i % 3] = std::min(low[i % 3], this->Batch[i]);
    high[i % 3] = std::max(high[i % 3], this->Batch[i]);
  }
  // Building it costs more than searching it for one point.
  std::optional<PointTree> tree;
  for (std::size_t n = 0; n < this->Points.size(); ++n)
  {
    const std::array<double, 3>& point = this->Points[n];
    std::array<double, 3> inBox{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      // The point of the box that is nearest to `point`.
      inBox[k] = std::min(std::max(point[k], low[k]), high[k]);
    }
    // Most batches are farther from most points than vertices that are known already. The distance
    // of the box is computed like those of vertices, so that rounding keeps it a lower bound.
    if (PointTree::squaredDistance(inBox, point) < this->Distances[n])
    {
      if (!tree)
      {
        tree.emplace(this->Batch);
      }
      const PointTree::Nearest found = tree->nearest(point, this->Distances[n]);
      if (found.squaredDistance < this->Distances[n])
      {
        this->Distances[n] = found.squaredDistance;
        this->Vertices[n] = this->BatchBegin + found.point;
      }
    }
  }
  this->BatchBegin += static_cast<std::int64_t>(this->Batch.size() / 3);
  this->Batch.clear();
}

/** Searches the rest of the vertices, and turns the nearest vertex of each point into an ascending
 * list of vertices with their points. */
void NearestSelection::endPreparing(MeshParts* parts)
{
  if (!this->needsPreparing())
  {
    return; // no block has come since the last time
  }
  this->searchBatch();
  // Gives the memory back.
  this->Batch = {};
  if (parts)
  {
    // Vertices are -1 afterwards where another part has the nearest one.
    parts->nearest(this->Distances, this->Vertices);
  }
  // Says that preparation is complete, see needsPreparing().
  this->Distances.clear();
  const std::vector<std::int64_t> nearest = this->Vertices;
  std::erase(this->Vertices, -1);
  this->Count = static_cast<std::int64_t>(this->Vertices.size());
  this->Selection::endPreparing(parts);
  // Ascending, so that the vertices of a block form a range, and any vertex is found by bisection.
  std::ranges::sort(this->Vertices);
  this->Vertices.erase(
    std::unique(this->Vertices.begin(), this->Vertices.end()), this->Vertices.end());
  this->Numbers.resize(this->Vertices.size());
  for (std::size_t n = 0; n < nearest.size(); ++n)
  {
    // Another part of the mesh has the vertex.
    if (nearest[n] < 0)
    {
      continue;
    }
    const auto place = std::ranges::lower_bound(this->Vertices, nearest[n]);
    // Later points overwrite earlier ones: the last one counts.
    this->Numbers[static_cast<std::size_t>(place - this->Vertices.begin())] = n;
  }
}

/** The vertex is selected, so that the list has it. */
std::size_t NearestSelection::pointOf(std::int64_t vertex) const
{
  const auto place = std::ranges::lower_bound(this->Vertices, vertex);
  return this->Numbers[static_cast<std::size_t>(place - this->Vertices.begin())];
}

/** The selected vertices of a block are a range of the ascending list. */
void NearestSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  const auto begin = std::ranges::lower_bound(this->Vertices, block.firstVertex);
  const auto end = std::ranges::lower_bound(this->Vertices, block.firstVertex + block.vertices());
  std::for_each(begin, end,
    [&](std::int64_t v) { selected[static_cast<std::size_t>(v - block.firstVertex)] = 1; });
}

} // namespace smg
