// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/SolidPreview.h"

#include "IO/Files/PartialProgress.h"
#include "Solver/Core/DisjointSets.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Vector.h"
#include "Solver/Problem/OpenValues.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

using SolidPoint = SolidClusters::Point;

/** Vertices of the mesh for each point of the preview, at least. */
constexpr std::int64_t VerticesPerPoint = 20;
/** Vertices that the size of the cells is chosen by, for each point of the preview. */
constexpr std::int64_t SamplesPerPoint = 16;
/** The share of the requested points that the cells are chosen for: the sample misses some. */
constexpr double ChosenShare = 0.85;

SolidPoint pointOf(const MeshBlock& block, std::size_t i)
{
  return { block.positions[3 * i], block.positions[3 * i + 1], block.positions[3 * i + 2] };
}

/** Calls visit(block) for each block, until it returns false. */
void visitBlocks(const StoredMesh& mesh, const ProgressFunction& progress,
  const std::function<bool(const MeshBlock&)>& visit)
{
  Progress done(progress);
  const auto source = mesh.source({}, {});
  const auto cells = static_cast<double>(std::max<std::int64_t>(mesh.info().cells, 1));
  for (MeshBlock block; source->next(block) && visit(block);)
  {
    done.update(std::min(1.0, static_cast<double>(block.firstCell) / cells));
  }
  done.update(1.0);
}

/** About `count` vertices of the mesh, all over it. */
std::vector<SolidPoint> sampleOf(
  const StoredMesh& mesh, std::int64_t count, const ProgressFunction& progress)
{
  const double share = static_cast<double>(count) /
                       static_cast<double>(std::max<std::int64_t>(mesh.info().vertices, 1));
  std::vector<SolidPoint> sample;
  visitBlocks(mesh, progress,
    [&](const MeshBlock& block)
    {
      for (std::int64_t i = 0; i < block.vertices(); ++i)
      {
        // The fractional parts of the multiples of the golden ratio are spread evenly.
        const double multiple = 0.6180339887498949 * static_cast<double>(block.firstVertex + i);
        if (multiple - std::floor(multiple) < share)
        {
          sample.push_back(pointOf(block, static_cast<std::size_t>(i)));
        }
      }
      return true;
    });
  return sample;
}

/** The side of the grid's cubes with which the sample is in at most so many cells, and not many
 * fewer. */
double fittingSide(const std::vector<SolidPoint>& sample, const SolidPoint& origin, double longest,
  double maximumCells)
{
  const auto cells = [&](double side)
  {
    const BodyCentredGrid grid(origin, side);
    std::unordered_set<std::uint64_t> keys;
    for (const SolidPoint& point : sample)
    {
      keys.insert(grid.placeOf(point).key);
    }
    return static_cast<double>(keys.size());
  };
  double tooSmall = longest / 16384.0, fitting = 2.0 * longest;
  for (int trial = 0; trial < 24 && fitting > 1.01 * tooSmall; ++trial)
  {
    const double side = std::sqrt(tooSmall * fitting);
    (cells(side) > maximumCells ? tooSmall : fitting) = side;
  }
  return fitting;
}

/** Clusters the mesh. Returns none if there are more than so many clusters. */
std::optional<SolidClusters> cluster(const StoredMesh& mesh,
  const std::optional<BodyCentredGrid>& grid, std::int64_t maximumPoints,
  const ProgressFunction& progress)
{
  struct Vertex
  {
    SolidPoint point;
    int cluster;
  };
  SolidClusters clusters(grid);
  Pool memory(std::numeric_limits<std::int64_t>::max()); // a preview has no limit
  OpenValues<Vertex> open(memory);
  std::int64_t finalized = 0;
  const auto fits = [&]
  { return static_cast<std::int64_t>(clusters.clusters().size()) <= maximumPoints; };
  visitBlocks(mesh, progress,
    [&](const MeshBlock& block)
    {
      open.release(finalized);
      finalized = block.finalized;
      const std::span<Vertex> vertices = open.append(block.vertices());
      for (std::size_t i = 0; i < vertices.size(); ++i)
      {
        const SolidPoint point = pointOf(block, i);
        vertices[i] = { point,
          clusters.add(block.firstVertex + static_cast<std::int64_t>(i), point) };
      }
      for (std::size_t c = 0; c + 4 <= block.corners.size(); c += 4)
      {
        SolidClusters::Tetrahedron corners;
        std::array<SolidPoint, 4> points;
        for (std::size_t k = 0; k < 4; ++k)
        {
          const Vertex& vertex = *open.at(block.corners[c + k]);
          corners[k] = vertex.cluster;
          points[k] = vertex.point;
        }
        clusters.add(corners, points);
      }
      return fits();
    });
  return fits() ? std::optional(std::move(clusters)) : std::nullopt;
}

/** The clusters that tetrahedra use, by ascending stream index. */
MeshPiece collect(const SolidClusters& solid)
{
  const std::vector<SolidClusters::Cluster>& clusters = solid.clusters();
  const std::vector<SolidClusters::Tetrahedron> tetrahedra = solid.tetrahedra();
  std::vector<std::int64_t> number(clusters.size(), -1);
  std::vector<int> used;
  for (const auto& corners : tetrahedra)
  {
    for (const int corner : corners)
    {
      if (std::exchange(number[static_cast<std::size_t>(corner)], 0) < 0)
      {
        used.push_back(corner);
      }
    }
  }
  const auto of = [&clusters](int cluster) -> const SolidClusters::Cluster&
  { return clusters[static_cast<std::size_t>(cluster)]; };
  std::ranges::sort(used, {}, [&of](int cluster) { return of(cluster).id; });
  MeshPiece preview;
  for (const int cluster : used)
  {
    number[static_cast<std::size_t>(cluster)] = static_cast<std::int64_t>(preview.ids.size());
    preview.ids.push_back(of(cluster).id);
    const SolidPoint& point = of(cluster).point;
    preview.positions.insert(preview.positions.end(), point.begin(), point.end());
  }
  for (const auto& corners : tetrahedra)
  {
    for (const int corner : corners)
    {
      preview.corners.push_back(number[static_cast<std::size_t>(corner)]);
    }
  }
  preview.ghost.assign(preview.ids.size(), 0);
  preview.finalized.assign(preview.ids.size(), 1);
  return preview;
}

/** The grid for at most so many points; none if the mesh has not more. */
std::optional<BodyCentredGrid> gridFor(
  const StoredMesh& mesh, std::int64_t maximumPoints, const ProgressFunction& progress)
{
  const StreamInfo& info = mesh.info();
  if (info.vertices <= maximumPoints)
  {
    return std::nullopt;
  }
  const std::vector<SolidPoint> sample = sampleOf(mesh, SamplesPerPoint * maximumPoints, progress);
  const std::array<double, 6>& box = info.bounds;
  const double longest = std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4] });
  const SolidPoint origin{ box[0], box[2], box[4] };
  return BodyCentredGrid(origin, longest > 0.0 ? fittingSide(sample, origin, longest,
                                                   ChosenShare * static_cast<double>(maximumPoints))
                                               : 1.0);
}

using SolidPoint = SolidClusters::Point;

/** Tetrahedra with less than this share of the volume between lattice points are flat: their
 * weights would exceed all others. */
constexpr double MinVolume = 0.05;

/** The number of tetrahedra between lattice points that meet at one of them. */
constexpr std::size_t AroundAPoint = 24;

double signedVolume(
  const SolidPoint& a, const SolidPoint& b, const SolidPoint& c, const SolidPoint& d)
{
  const auto edge = [&a](const SolidPoint& p) { return difference(p.data(), a.data()); };
  return dot(edge(b), cross(edge(c), edge(d))) / 6.0;
}

/** Sorts the clusters. Returns 1 if the permutation is even, -1 if it is odd. */
int sortClusters(SolidClusters::Tetrahedron& clusters)
{
  int sign = 1;
  for (std::size_t end = clusters.size(); end > 1; --end)
  {
    for (std::size_t i = 1; i < end; ++i)
    {
      if (clusters[i - 1] > clusters[i])
      {
        std::swap(clusters[i - 1], clusters[i]);
        sign = -sign;
      }
    }
  }
  return sign;
}

} // namespace

MeshPiece makeSolidPreview(
  const StoredMesh& mesh, std::int64_t maximumPoints, const ProgressFunction& progress)
{
  const std::int64_t vertices = mesh.info().vertices;
  const std::int64_t most = vertices <= maximumPoints ? maximumPoints
                                                      : std::clamp(vertices / VerticesPerPoint,
                                                          MinPreviewPoints, maximumPoints);
  Progress done(progress);
  const auto rising = [&done](double part)
  {
    done.update(part);
    return true;
  };
  std::optional<BodyCentredGrid> grid = gridFor(mesh, most, partOf(rising, 0.0, 0.4));
  for (;;)
  {
    if (const auto clusters = cluster(mesh, grid, most, partOf(rising, 0.4, 1.0)))
    {
      return collect(*clusters);
    }
    constexpr double Growth = 1.1;
    grid = BodyCentredGrid(grid->origin(), Growth * grid->side());
  }
}

std::size_t SolidClusters::Hash::operator()(const Tetrahedron& corners) const
{
  std::uint64_t hash = 0;
  for (const int corner : corners)
  {
    hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash;
}

int SolidClusters::add(std::int64_t id, const Point& point)
{
  const int next = static_cast<int>(this->Clusters.size());
  const BodyCentredGrid::Place place =
    this->Grid ? this->Grid->placeOf(point) : BodyCentredGrid::Place{};
  const int cluster = this->Grid ? this->Index.try_emplace(place.key, next).first->second : next;
  if (cluster == next)
  {
    this->Clusters.push_back({ id, point, place.squared });
  }
  else if (Cluster& present = this->Clusters[static_cast<std::size_t>(cluster)];
           place.squared < present.squared)
  {
    present = { id, point, place.squared };
  }
  return cluster;
}

void SolidClusters::add(const Tetrahedron& clusters, const std::array<Point, 4>& points)
{
  Tetrahedron sorted = clusters;
  const int sign = sortClusters(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
  {
    return;
  }
  const double size = signedVolume(points[0], points[1], points[2], points[3]);
  if (size != 0.0)
  {
    this->Images[sorted] += size > 0.0 ? sign : -sign;
  }
}

std::vector<SolidClusters::Tetrahedron> SolidClusters::tetrahedra() const
{
  const double least = this->Grid ? MinVolume * this->Grid->tetrahedronVolume() : 0.0;
  const auto point = [this](int cluster) -> const Point&
  { return this->Clusters[static_cast<std::size_t>(cluster)].point; };
  std::vector<Tetrahedron> kept;
  for (const auto& [corners, orientation] : this->Images)
  {
    Tetrahedron turned = corners;
    if (orientation < 0)
    {
      std::swap(turned[2], turned[3]);
    }
    if (orientation != 0 && signedVolume(point(turned[0]), point(turned[1]), point(turned[2]),
                              point(turned[3])) > least)
    {
      kept.push_back(turned);
    }
  }
  // In an order that does not depend on the hash table.
  std::ranges::sort(kept);
  return this->Grid ? this->withoutFragments(std::move(kept)) : kept;
}

std::vector<SolidClusters::Tetrahedron> SolidClusters::withoutFragments(
  std::vector<Tetrahedron> all) const
{
  DisjointSets<int> sets(this->Clusters.size());
  for (const Tetrahedron& corners : all)
  {
    for (const int corner : corners)
    {
      sets.join(corners[0], corner);
    }
  }
  std::vector<std::size_t> sizes(this->Clusters.size(), 0);
  std::size_t largest = 0;
  for (const Tetrahedron& corners : all)
  {
    largest = std::max(largest, ++sizes[static_cast<std::size_t>(sets.first(corners[0]))]);
  }
  const std::size_t least = std::min(AroundAPoint, largest);
  std::erase_if(all, [&](const Tetrahedron& corners)
    { return sizes[static_cast<std::size_t>(sets.first(corners[0]))] < least; });
  return all;
}

} // namespace smg
