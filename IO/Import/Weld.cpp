// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Weld.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <unordered_map>

namespace smg
{

namespace
{

using Point = WeldPoint;

/** The remaining points that may be close to a later point. */
class NearPoints
{
public:
  NearPoints(double tolerance, std::int64_t memory)
    : Tolerance(tolerance)
    , Most(static_cast<std::size_t>(memory) / BytesPerPoint)
  {
  }

  /** The number of the first point close to this one; if there is none, this one is kept. */
  std::uint32_t findOrKeep(const Point& point)
  {
    this->forgetBefore(point.position[0] - this->Tolerance);
    const Cell cell = this->cellOf(point);
    const Point* first = nullptr;
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dz = -1; dz <= 1; ++dz)
      {
        const auto [begin, end] = this->Grid.equal_range({ cell[0] + dy, cell[1] + dz });
        for (auto entry = begin; entry != end; ++entry)
        {
          const Point& other = entry->second;
          if (this->isNear(point, other) && (!first || other < *first))
          {
            first = &other;
          }
        }
      }
    }
    if (first)
    {
      return first->id;
    }
    this->keep(cell, point);
    return point.id;
  }

private:
  /** Bytes of a point with its entries in the grid and in the queue. */
  static constexpr std::size_t BytesPerPoint = 160;

  using Cell = std::array<double, 2>;
  struct CellHash
  {
    std::size_t operator()(const Cell& cell) const
    {
      return std::hash<double>()(cell[0]) * 0x9e3779b97f4a7c15u ^ std::hash<double>()(cell[1]);
    }
  };

  Cell cellOf(const Point& point) const
  {
    // If only equal coordinates are merged, cells are the coordinates themselves.
    const double size = this->Tolerance;
    return size > 0
             ? Cell{ std::floor(point.position[1] / size), std::floor(point.position[2] / size) }
             : Cell{ point.position[1] + 0.0, point.position[2] + 0.0 };
  }

  bool isNear(const Point& a, const Point& b) const
  {
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      squares += (a.position[axis] - b.position[axis]) * (a.position[axis] - b.position[axis]);
    }
    return std::sqrt(squares) <= this->Tolerance;
  }

  void keep(const Cell& cell, const Point& point)
  {
    if (this->Kept.size() == this->Most)
    {
      throw MemoryError(
        "More than " + std::to_string(this->Most) +
        " points lie within the tolerance of each other along x, which is more than the "
        "memory holds: choose a smaller tolerance or a larger memory limit.");
    }
    this->Kept.push_back(this->Grid.emplace(cell, point));
  }

  void forgetBefore(double x)
  {
    while (!this->Kept.empty() && this->Kept.front()->second.position[0] < x)
    {
      this->Grid.erase(this->Kept.front());
      this->Kept.pop_front();
    }
  }

  using Points = std::unordered_multimap<Cell, Point, CellHash>;

  double Tolerance;
  std::size_t Most;
  Points Grid;
  std::deque<typename Points::iterator> Kept; ///< by x
};

void readPoints(const RawMesh& mesh, ExternalSort<Point>& points)
{
  BucketFile::Reader positions(mesh.positions);
  std::array<float, 3> single;
  Point point{ {}, 0 };
  for (; point.id < mesh.vertices; ++point.id)
  {
    if (mesh.doublePositions)
    {
      positions.get(point.position);
    }
    else
    {
      positions.get(single);
      std::copy(single.begin(), single.end(), point.position.begin());
    }
    points.put(point);
  }
}

} // namespace

void checkWeldDistance(double tolerance)
{
  if (!(tolerance >= 0))
  {
    throw Error("The distance within which points are merged must be 0 or more.");
  }
}

std::int64_t weldPoints(RawMesh& mesh, double tolerance, Workspace& workspace, VertexFilter* joined)
{
  checkWeldDistance(tolerance);
  const std::int64_t memory = workspace.available() / 3;
  Relabelling kept(workspace, mesh.vertices, memory);
  std::int64_t merged = 0;
  {
    ExternalSort<Point> points(workspace, memory);
    readPoints(mesh, points);
    points.sort();
    const std::int64_t window = workspace.available() / 2;
    const Reservation reserved(workspace.pool(), window);
    NearPoints near(tolerance, window);
    for (Point point{}; points.next(point);)
    {
      const std::uint32_t id = near.findOrKeep(point);
      kept.put(point.id, id);
      if (id != point.id)
      {
        ++merged;
        if (joined)
        {
          joined->add(id);
        }
      }
    }
  }
  if (merged > 0)
  {
    for (RecordFile<std::uint32_t>* named :
      { &mesh.corners, &mesh.facets.corners, &mesh.points.corners })
    {
      RecordFile<std::uint32_t> corners(workspace);
      kept.apply(
        *named, 1, [&corners](std::span<const std::uint32_t> corner) { corners.put(corner); });
      corners.close();
      *named = std::move(corners);
    }
  }
  mesh.counts.mergedPoints += merged;
  return merged;
}

std::vector<std::uint32_t> mergedWith(std::vector<WeldPoint> points, double tolerance,
  std::int64_t memory, const std::function<void()>& poll)
{
  constexpr std::size_t Often = std::size_t(1) << 18;
  std::size_t compared = 0;
  std::sort(points.begin(), points.end(),
    [&](const Point& a, const Point& b)
    {
      if (++compared % Often == 0)
      {
        poll();
      }
      return a < b;
    });
  std::vector<std::uint32_t> kept(points.size());
  NearPoints near(tolerance, memory);
  const Point* first = nullptr; // of those at the same place
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Point& point = points[k];
    if (k % Often == 0)
    {
      poll();
    }
    if (tolerance > 0.0)
    {
      kept[point.id] = near.findOrKeep(point);
      continue;
    }
    first = first && first->position == point.position ? first : &point;
    kept[point.id] = first->id;
  }
  return kept;
}

} // namespace smg
