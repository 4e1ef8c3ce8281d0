// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/ClusterGrid.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace smg
{
namespace
{

/** Bits of a cluster index, so that three of them form a key. */
constexpr int ClusterBits = 21;

/** Three more may be added before the grid is coarsened. */
constexpr std::size_t MostClusters = (std::size_t(1) << ClusterBits) - 3;

std::uint64_t keyOfTriple(int a, int b, int c)
{
  std::array<std::uint64_t, 3> sorted{ std::uint64_t(a), std::uint64_t(b), std::uint64_t(c) };
  std::sort(sorted.begin(), sorted.end());
  return (sorted[0] << (2 * ClusterBits)) | (sorted[1] << ClusterBits) | sorted[2];
}

std::array<double, 3> sum(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

} // namespace

ClusterGrid::ClusterGrid(
  const std::array<double, 6>& bounds, std::int64_t maximumClusters, bool mayGrow)
  : MaximumClusters(std::clamp<std::int64_t>(maximumClusters, 8, std::int64_t(1) << 20))
  , Capacity(std::min(4 * this->MaximumClusters, MostClusters))
  , MayGrow(mayGrow)
{
  // A surface has about n^2 clusters for n cells along an axis; more if it is folded.
  const double cells = 16.0 * std::sqrt(static_cast<double>(this->Capacity));
  this->FinestCells = std::exp2(std::max(10.0, std::ceil(std::log2(cells))));
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Origin[axis] = bounds[2 * axis];
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  this->FinestSize = longest > 0.0 ? longest / this->FinestCells : 1.0;
}

double ClusterGrid::place(const std::array<double, 3>& point, int axis, double side) const
{
  const double cell = (point[axis] - this->Origin[axis]) / this->FinestSize;
  return std::floor((this->MayGrow ? cell : std::clamp(cell, 0.0, this->FinestCells - 1.0)) / side);
}

bool ClusterGrid::isWithin(const std::array<double, 3>& point) const
{
  constexpr double reach = 1 << (PlaceBits - 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = this->place(point, axis, this->Side);
    if (place < -reach || place >= reach)
    {
      return false;
    }
  }
  return true;
}

std::uint64_t ClusterGrid::keyOf(const std::array<double, 3>& point, double side) const
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto place = static_cast<std::int64_t>(this->place(point, axis, side));
    key = (key << PlaceBits) | static_cast<std::uint64_t>(place + (1 << (PlaceBits - 1)));
  }
  return key;
}

double ClusterGrid::distanceToCentre(const std::array<double, 3>& point) const
{
  const double size = this->FinestSize * this->Side;
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
  const auto [entry, isNew] = this->Index.try_emplace(
    this->keyOf(candidate.point, this->Side), static_cast<int>(this->Clusters.size()));
  if (isNew)
  {
    this->Clusters.push_back(candidate);
  }
  else
  {
    Representative& present = this->Clusters[entry->second];
    const std::array<double, 3> normal = sum(present.normal, candidate.normal);
    if (this->distanceToCentre(candidate.point) < this->distanceToCentre(present.point))
    {
      present = candidate;
    }
    present.normal = normal;
  }
  return entry->second;
}

int ClusterGrid::cluster(std::int64_t id, const std::array<double, 3>& point)
{
  while (this->MayGrow && !this->isWithin(point))
  {
    this->coarsen(2.0 * this->Side);
  }
  return this->find({ id, point, {} });
}

void ClusterGrid::keep(int a, int b, int c)
{
  if (a != b && b != c && c != a && this->Known.insert(keyOfTriple(a, b, c)).second)
  {
    this->Triangles.push_back({ a, b, c });
  }
}

void ClusterGrid::addTriangle(int a, int b, int c, const std::array<double, 3>& normal)
{
  this->keep(a, b, c);
  for (const int cluster : { a, b, c })
  {
    this->Clusters[cluster].normal = sum(this->Clusters[cluster].normal, normal);
  }
  // A surface has about two triangles per vertex; a triangle soup with more must also stay bounded.
  while (this->canGrow() &&
         (this->Clusters.size() > this->Capacity || this->Triangles.size() > 4 * this->Capacity))
  {
    this->coarsen(2.0 * this->Side);
  }
}

bool ClusterGrid::canGrow() const
{
  return this->MayGrow || 2.0 * this->Side < this->FinestCells;
}

void ClusterGrid::finish()
{
  if (this->Clusters.size() > this->MaximumClusters)
  {
    this->coarsen(this->fittingSide());
  }
  while (this->canGrow() && this->Triangles.size() > 8 * this->MaximumClusters)
  {
    this->coarsen(1.25 * this->Side);
  }
}

std::size_t ClusterGrid::countIn(double side) const
{
  std::unordered_set<std::uint64_t> cells;
  cells.reserve(this->MaximumClusters);
  for (const Representative& cluster : this->Clusters)
  {
    cells.insert(this->keyOf(cluster.point, side));
  }
  return cells.size();
}

/** A side with at most the requested number of clusters, and not many fewer. */
double ClusterGrid::fittingSide() const
{
  const auto most = static_cast<double>(this->MaximumClusters);
  double tooSmall = this->Side;
  double fitting = 0.0;
  double fittingCount = 0.0;
  double side = this->Side;
  auto count = static_cast<double>(this->Clusters.size());
  for (int trial = 0; trial < 12 && fittingCount < 0.93 * most; ++trial)
  {
    // The number of clusters of a surface is inversely proportional to the square of the side.
    side *= std::sqrt(count / (0.97 * most));
    if (fitting != 0.0 && (side <= tooSmall || side >= fitting))
    {
      side = std::sqrt(tooSmall * fitting);
    }
    count = static_cast<double>(this->countIn(side));
    if (count > most)
    {
      tooSmall = side;
    }
    else
    {
      fitting = side;
      fittingCount = count;
    }
  }
  while (fitting == 0.0)
  {
    side *= 1.25;
    fitting = this->countIn(side) <= this->MaximumClusters ? side : 0.0;
  }
  return fitting;
}

void ClusterGrid::coarsen(double side)
{
  const std::vector<Representative> clusters = std::move(this->Clusters);
  const std::vector<std::array<int, 3>> triangles = std::move(this->Triangles);
  this->Clusters.clear();
  this->Triangles.clear();
  this->Known.clear();
  this->Index.clear();
  this->Side = side;
  ++this->Generation;
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
