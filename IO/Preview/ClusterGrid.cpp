// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/ClusterGrid.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

/** Clusters are numbered in this many bits, so that three of them make a key. */
constexpr int ClusterBits = 21;

std::uint64_t keyOfTriple(int a, int b, int c)
{
  std::array<std::uint64_t, 3> sorted{ std::uint64_t(a), std::uint64_t(b), std::uint64_t(c) };
  std::sort(sorted.begin(), sorted.end());
  return (sorted[0] << (2 * ClusterBits)) | (sorted[1] << ClusterBits) | sorted[2];
}

} // namespace

ClusterGrid::ClusterGrid(const std::array<double, 6>& bounds, std::int64_t maximumClusters)
  : MaximumClusters(std::clamp<std::int64_t>(maximumClusters, 8, std::int64_t(1) << 20))
{
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Origin[axis] = bounds[2 * axis];
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  this->FinestSize = longest > 0.0 ? longest / (1 << FinestBits) : 1.0;
}

std::uint64_t ClusterGrid::keyOf(const std::array<double, 3>& point) const
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double cell = (point[axis] - this->Origin[axis]) / this->FinestSize;
    const auto finest =
      static_cast<std::uint64_t>(std::clamp(cell, 0.0, double((1 << FinestBits) - 1)));
    key = (key << FinestBits) | (finest >> this->Level);
  }
  return key;
}

double ClusterGrid::distanceToCentre(const std::array<double, 3>& point) const
{
  const double size = std::ldexp(this->FinestSize, this->Level);
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double cell = (point[axis] - this->Origin[axis]) / size;
    const double offset = cell - std::floor(cell) - 0.5;
    sum += offset * offset;
  }
  return sum;
}

int ClusterGrid::find(const Representative& candidate)
{
  const auto [entry, isNew] =
    this->Index.try_emplace(this->keyOf(candidate.point), static_cast<int>(this->Clusters.size()));
  if (isNew)
  {
    this->Clusters.push_back(candidate);
  }
  else if (Representative& present = this->Clusters[entry->second];
           this->distanceToCentre(candidate.point) < this->distanceToCentre(present.point))
  {
    present = candidate;
  }
  return entry->second;
}

int ClusterGrid::cluster(std::int64_t id, const std::array<double, 3>& point)
{
  return this->find({ id, point });
}

void ClusterGrid::keep(int a, int b, int c)
{
  if (a != b && b != c && c != a && this->Known.insert(keyOfTriple(a, b, c)).second)
  {
    this->Triangles.push_back({ a, b, c });
  }
}

void ClusterGrid::addTriangle(int a, int b, int c)
{
  this->keep(a, b, c);
  // A surface has about two triangles a vertex; a soup that has many more must stay bounded, too.
  while (this->Level + 1 < FinestBits && (this->Clusters.size() > this->MaximumClusters ||
                                           this->Triangles.size() > 8 * this->MaximumClusters))
  {
    this->coarsen();
  }
}

void ClusterGrid::coarsen()
{
  const std::vector<Representative> clusters = std::move(this->Clusters);
  const std::vector<std::array<int, 3>> triangles = std::move(this->Triangles);
  this->Clusters.clear();
  this->Triangles.clear();
  this->Known.clear();
  this->Index.clear();
  ++this->Level;
  std::vector<int> coarse;
  coarse.reserve(clusters.size());
  for (const Representative& cluster : clusters)
  {
    coarse.push_back(this->find(cluster));
  }
  for (const auto& [a, b, c] : triangles)
  {
    this->keep(coarse[a], coarse[b], coarse[c]);
  }
}

} // namespace smg
