// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Description/NearestSelection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{

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
  for (std::size_t n = 0; n < this->Points.size(); ++n)
  {
    const auto [px, py, pz] = this->Points[n];
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      const double x = block.positions[3 * i] - px;
      const double y = block.positions[3 * i + 1] - py;
      const double z = block.positions[3 * i + 2] - pz;
      const double distance = x * x + y * y + z * z;
      if (distance < this->Distances[n])
      {
        this->Distances[n] = distance;
        this->Vertices[n] = block.firstVertex + i;
      }
    }
  }
}

void NearestSelection::endPreparing(MeshParts* parts)
{
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
