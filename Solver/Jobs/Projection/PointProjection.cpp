// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/PointProjection.h"

#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// Projects points to the nearest vertices of a stream in one pass, and finds the vertices that each
// point influences: within a radius of its vertex, or within a number of edges ("rings").
//
// Vertices are compared in batches with a k-d tree, which is only built where the bounding box of
// the batch is near enough to some point. Rings need edges around vertices that are not known until
// the end: a window keeps everything that may still be near enough, and forgets the rest from time
// to time. Where batches end depends on the blocks, the result does not: of equally near vertices
// the first one counts.

namespace smg
{
namespace
{

/** The number of vertices that the points are compared with at once, unless a block is larger. */
constexpr std::size_t BatchVertices = 65536;

/** The size to which the window of rings grows before cells are discarded for the first time. */
constexpr std::int64_t MinBytesToForgetAt = std::int64_t(16) << 20;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Empty bounds: xmin, xmax, ymin, ymax, zmin, zmax. */
constexpr std::array<double, 6> NoBounds{ Infinity, -Infinity, Infinity, -Infinity, Infinity,
  -Infinity };

void extend(std::array<double, 6>& bounds, std::span<const double> positions)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const std::size_t k = 2 * (i % 3);
    bounds[k] = std::min(bounds[k], positions[i]);
    bounds[k + 1] = std::max(bounds[k + 1], positions[i]);
  }
}

std::span<const double, 3> tripleOf(std::span<const double> numbers, std::size_t i)
{
  return numbers.subspan(3 * i).first<3>();
}

} // namespace

/** Checks points and influence, which come from a user. */
PointProjection::PointProjection(std::span<const double> points, const Influence& influence,
  CellType cellType, std::int64_t memoryLimit)
  : Points(points.begin(), points.end())
  , Reach(influence)
  , MemoryLimit(memoryLimit)
  , Check(cellType)
  , Found(points.size() / 3)
  , Squared(points.size() / 3, Infinity)
  , Bounds(NoBounds)
  , BytesToForgetAt(std::min(memoryLimit, MinBytesToForgetAt))
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!std::isfinite(points[i]))
    {
      throw Error("Point " + std::to_string(i / 3) +
                  " of the region has a coordinate that is not a finite number.");
    }
  }
  if (!std::isfinite(influence.radius) || influence.radius < 0.0)
  {
    throw Error("The radius of the region must be finite and at least 0.");
  }
  if (influence.rings < 0 || influence.rings > MaximumRings)
  {
    throw Error("The rings of the region must be from 0 to " + std::to_string(MaximumRings) + ".");
  }
  if (influence.rings > 0)
  {
    this->Window.emplace(cellType, influence.rings);
  }
}

/** Collects vertices for a batch, and cells for the window of rings. */
void PointProjection::add(const MeshBlock& block)
{
  this->Check.add(block);
  // Pending vertices are consecutive: the first index is enough.
  if (this->Pending.empty())
  {
    this->FirstPending = block.firstVertex;
  }
  this->Pending.insert(this->Pending.end(), block.positions.begin(), block.positions.end());
  if (this->Window)
  {
    this->Window->add(block);
  }
  if (this->Pending.size() >= 3 * BatchVertices)
  {
    this->project();
  }
}

void PointProjection::finish()
{
  Progress none;
  this->finish(none);
}

/** Projects the rest of the vertices, and prepares influencing(). */
void PointProjection::finish(Progress& progress)
{
  this->project();
  if (this->Check.vertices() == 0)
  {
    throw Error("The mesh has no vertex that a point of the region could be projected to.");
  }
  std::vector<double> anchors;
  for (const Projected& found : this->Found)
  {
    // The square of every distance has overflowed.
    if (found.vertex < 0)
    {
      throw Error(
        "A point of the region lies too far from the mesh for a distance to be computed.");
    }
    anchors.insert(anchors.end(), found.position.begin(), found.position.end());
  }
  // Influence is measured from the vertices, not from the points.
  this->Anchors = PointTree(anchors);
  if (this->Window)
  {
    progress.update(0.0);
    this->Window->finish();
    this->forget();
    this->InRings = this->Window->nearestCenters(this->nearestVertices(), progress);
    this->Window.reset();
  }
}

/** The nearest vertices so far, which are the centers of rings. */
std::vector<std::int64_t> PointProjection::nearestVertices() const
{
  std::vector<std::int64_t> vertices;
  for (const Projected& found : this->Found)
  {
    if (found.vertex >= 0)
    {
      vertices.push_back(found.vertex);
    }
  }
  return vertices;
}

/** Discards the parts of the window that no point needs. All vertices so far must have been
 * compared with the points, since those discarded cannot become nearest vertices any more. */
void PointProjection::forget()
{
  this->Window->forget(this->nearestVertices());
  const std::int64_t bytes = this->Window->bytes();
  if (bytes > this->MemoryLimit)
  {
    throw MemoryError(
      "The " + std::to_string(this->Reach.rings) + " rings around the " +
      std::to_string(this->Found.size()) + " points of the region need at least " +
      std::to_string(bytes) + " bytes, " + std::to_string(this->MemoryLimit) +
      " are allowed: give fewer rings or points, or a radius instead, or convert the "
      "mesh with the order bfs.");
  }
  // Discarding takes time in proportion to the window. With a threshold of twice what remains, it
  // costs a constant amount per vertex that is added.
  this->BytesToForgetAt = std::min(this->MemoryLimit, std::max(MinBytesToForgetAt, 2 * bytes));
}

/** Whether the box may have a vertex nearer than the nearest one so far. Its distance is computed
 * like the distances of vertices, so that rounding keeps it a lower bound. */
bool PointProjection::isInReach(std::size_t point, const std::array<double, 6>& bounds) const
{
  std::array<double, 3> nearest{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    nearest[k] = std::clamp(this->Points[3 * point + k], bounds[2 * k], bounds[2 * k + 1]);
  }
  return PointTree::squaredDistance(nearest, tripleOf(this->Points, point)) < this->Squared[point];
}

/** Compares the pending vertices with all points. */
void PointProjection::project()
{
  std::array<double, 6> bounds = NoBounds;
  extend(bounds, this->Pending);
  extend(this->Bounds, this->Pending);
  std::optional<PointTree> vertices;
  for (std::size_t point = 0; point < this->Found.size() && !this->Pending.empty(); ++point)
  {
    if (!this->isInReach(point, bounds))
    {
      continue;
    }
    if (!vertices)
    {
      vertices.emplace(this->Pending);
    }
    const PointTree::Nearest near =
      vertices->nearest(tripleOf(this->Points, point), this->Squared[point]);
    // Only if strictly nearer: an equally near vertex of an earlier batch has a lower index.
    if (near.point >= 0 && near.squaredDistance < this->Squared[point])
    {
      Projected& found = this->Found[point];
      found.vertex = this->FirstPending + near.point;
      std::copy_n(this->Pending.data() + 3 * near.point, 3, found.position.data());
      found.distance = std::sqrt(near.squaredDistance);
      this->Squared[point] = near.squaredDistance;
    }
  }
  this->Pending.clear();
  // Now that no vertex is pending.
  if (this->Window && this->Window->bytes() > this->BytesToForgetAt)
  {
    this->forget();
  }
}

double PointProjection::diagonal() const
{
  double squared = 0.0;
  for (std::size_t k = 0; k < 6; k += 2)
  {
    const double extent = std::max(0.0, this->Bounds[k + 1] - this->Bounds[k]);
    squared += extent * extent;
  }
  return std::sqrt(squared);
}

/** Such points are probably in another unit or coordinate system than the mesh. */
std::vector<std::int64_t> PointProjection::distantPoints(double part) const
{
  const double limit = part * this->diagonal();
  std::vector<std::int64_t> distant;
  for (std::size_t point = 0; point < this->Found.size(); ++point)
  {
    if (this->Found[point].distance > limit)
    {
      distant.push_back(static_cast<std::int64_t>(point));
    }
  }
  return distant;
}

/** The nearest vertex of a point within the radius, or a nearer one by rings. */
std::int64_t PointProjection::influencing(
  std::int64_t vertex, std::span<const double, 3> position) const
{
  PointTree::Nearest best =
    this->Anchors.nearest(position, this->Reach.radius * this->Reach.radius);
  // The smallest possible second member finds the entry of the vertex, whatever its point is.
  const auto entry = std::lower_bound(this->InRings.begin(), this->InRings.end(),
    std::pair(vertex, std::numeric_limits<std::int64_t>::min()));
  if (entry != this->InRings.end() && entry->first == vertex)
  {
    const std::int64_t point = entry->second;
    const double squared = PointTree::squaredDistance(this->Found[point].position, position);
    if (best.point < 0 || squared < best.squaredDistance ||
        (squared == best.squaredDistance && point < best.point))
    {
      best.point = point;
    }
  }
  return best.point;
}

} // namespace smg
