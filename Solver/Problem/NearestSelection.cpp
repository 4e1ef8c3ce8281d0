// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/NearestSelection.h"

#include "Solver/Jobs/Projection/PointTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace smg
{

namespace
{

/** So many vertices are searched at once, however small the blocks are. */
constexpr std::size_t BatchVertices = 8192;

} // namespace

NearestSelection::NearestSelection(const NearestVertices& nearest, DataPlace place,
  const std::string& key, const MeshColumns& columns)
  : Selection(place, key, columns)
  , Points(nearest.points)
  , Distances(nearest.points.size(), std::numeric_limits<double>::infinity())
  , Vertices(nearest.points.size(), -1)
{
  const auto isFinite = [](const std::array<double, 3>& p)
  { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); };
  if (this->Points.empty() || !std::ranges::all_of(this->Points, isFinite))
  {
    columns.fail(key + ".nearest", "must have at least one point, and finite coordinates");
  }
}

void NearestSelection::prepare(const MeshBlock& block, const std::filesystem::path& /*scratch*/)
{
  this->Batch.insert(this->Batch.end(), block.positions.begin(), block.positions.end());
  if (this->Batch.size() >= 3 * BatchVertices)
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
  std::optional<PointTree> tree;
  for (std::size_t n = 0; n < this->Points.size(); ++n)
  {
    const std::array<double, 3>& point = this->Points[n];
    std::array<double, 3> inBox{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      inBox[k] = std::min(std::max(point[k], low[k]), high[k]);
    }
    // Most batches are farther from most points than vertices that are known already.
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

void NearestSelection::endPreparing(MeshParts* parts)
{
  this->searchBatch();
  this->Batch = {};
  if (parts)
  {
    parts->nearest(this->Distances, this->Vertices);
  }
  this->Distances.clear();
  const std::vector<std::int64_t> nearest = this->Vertices;
  std::erase(this->Vertices, -1);
  this->Count = static_cast<std::int64_t>(this->Vertices.size());
  this->Selection::endPreparing(parts);
  std::ranges::sort(this->Vertices);
  this->Vertices.erase(
    std::unique(this->Vertices.begin(), this->Vertices.end()), this->Vertices.end());
  this->Numbers.resize(this->Vertices.size());
  for (std::size_t n = 0; n < nearest.size(); ++n)
  {
    if (nearest[n] < 0)
    {
      continue; // a vertex that the part lacks
    }
    const auto place = std::ranges::lower_bound(this->Vertices, nearest[n]);
    this->Numbers[static_cast<std::size_t>(place - this->Vertices.begin())] = n;
  }
}

std::size_t NearestSelection::pointOf(std::int64_t vertex) const
{
  const auto place = std::ranges::lower_bound(this->Vertices, vertex);
  return this->Numbers[static_cast<std::size_t>(place - this->Vertices.begin())];
}

void NearestSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  const auto begin = std::ranges::lower_bound(this->Vertices, block.firstVertex);
  const auto end = std::ranges::lower_bound(this->Vertices, block.firstVertex + block.vertices());
  std::for_each(begin, end,
    [&](std::int64_t v) { selected[static_cast<std::size_t>(v - block.firstVertex)] = 1; });
}

} // namespace smg
