// SPDX-License-Identifier: BSD-3-Clause
// Distances: along paths between Euclid and Dijkstra, of walls by all triangles.
#include "Testing/Random/Check.h"

#include "Testing/Random/Doors.h"
#include "Testing/Random/Evaluation.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/DescriptionFiles.h"
#include "smg/Distance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

namespace smg::testing
{
namespace
{

using Eigen::Vector3d;
using nlohmann::json;

constexpr double Infinite = std::numeric_limits<double>::infinity();

Vector3d pointOf(const Case& given, std::int64_t v)
{
  return Vector3d::Map(&given.points[3 * static_cast<std::size_t>(v)]);
}

/** The cells along which paths run: those that repeat no corner and no cell. */
std::vector<std::int64_t> passableCells(const Case& given)
{
  const std::vector<std::uint8_t> flags = given.flags();
  const int size = cornersOf(given.type);
  std::vector<std::int64_t> cells;
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    const std::set<std::int64_t> distinct(given.cell(c), given.cell(c) + size);
    if (static_cast<int>(distinct.size()) == size &&
        !(flags[static_cast<std::size_t>(c)] & DuplicateCell))
    {
      cells.push_back(c);
    }
  }
  return cells;
}

/** The distance from a point to a segment. */
double toSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const double square = (b - a).squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * (b - a)).norm();
}

/** The distance from a point to a triangle: to its plane where the foot is inside, else to its
 * edges. */
double toTriangle(const Vector3d& p, const std::array<Vector3d, 3>& t)
{
  double least =
    std::min({ toSegment(p, t[0], t[1]), toSegment(p, t[1], t[2]), toSegment(p, t[2], t[0]) });
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double square = normal.squaredNorm();
  if (square > 0.0)
  {
    bool isInside = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      isInside = isInside && normal.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0.0;
    }
    least = isInside ? std::min(least, std::abs(normal.dot(p - t[0])) / std::sqrt(square)) : least;
  }
  return least;
}

void checkWall(const Case& given, const Eigen::MatrixXd& distances, CheckedCase& to)
{
  const Evaluation at(given);
  const std::vector<std::size_t> walls = at.walls(given.problem.at("from"));
  double size = 0.0;
  for (const double x : given.points)
  {
    size = std::max(size, std::abs(x));
  }
  for (std::int64_t v = 0; v < given.vertices(); ++v)
  {
    double least = Infinite;
    for (const std::size_t f : walls)
    {
      const std::vector<std::int64_t>& corner = at.facets()[f].corners;
      least = std::min(least,
        toTriangle(pointOf(given, v),
          { pointOf(given, corner[0]), pointOf(given, corner[1]), pointOf(given, corner[2]) }));
    }
    const double found = distances(v, 0);
    const double error = std::abs(found - least) / size;
    to.error = std::isfinite(error) ? std::max(to.error, error) : to.error;
    if (!(found == least || error <= 1e-7))
    {
      std::ostringstream text;
      text << "vertex " << v << " has the wall distance " << found << " instead of " << least;
      to.failure = text.str();
      return;
    }
  }
}

/** Of vertices, by relaxing all edges until nothing changes. */
std::vector<double> dijkstra(
  const Case& given, const std::vector<std::int64_t>& cells, const std::vector<bool>& isSource)
{
  std::vector<double> distance(isSource.size(), Infinite);
  for (std::size_t v = 0; v < isSource.size(); ++v)
  {
    distance[v] = isSource[v] ? 0.0 : Infinite;
  }
  const int size = cornersOf(given.type);
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (const std::int64_t c : cells)
    {
      for (int i = 0; i < size; ++i)
      {
        for (int j = 0; j < size; ++j)
        {
          const std::int64_t a = given.cell(c)[i], b = given.cell(c)[j];
          const double by =
            distance[static_cast<std::size_t>(a)] + (pointOf(given, a) - pointOf(given, b)).norm();
          double& old = distance[static_cast<std::size_t>(b)];
          isChanged = isChanged || by < old;
          old = std::min(old, by);
        }
      }
    }
  }
  return distance;
}

/** No distance is shorter than the straight line to the nearest source, and none longer than the
 * shortest path along edges. */
void checkPaths(const Case& given, const Eigen::MatrixXd& distances, CheckedCase& to)
{
  const Evaluation at(given);
  bool isEmpty = false;
  std::vector<bool> isSource(static_cast<std::size_t>(given.vertices()), false);
  for (const json& place : given.problem.at("from"))
  {
    const std::vector<bool> selected = at.select(place, Of::Vertices, isEmpty);
    for (std::size_t v = 0; v < selected.size(); ++v)
    {
      isSource[v] = isSource[v] || selected[v];
    }
  }
  const std::vector<std::int64_t> cells = passableCells(given);
  const std::vector<double> longest = dijkstra(given, cells, isSource);
  // The front of one source is exact. Where those of several meet, cells may be crossed by a front
  // between the two, and between sources of a cell lies an edge or a face of sources.
  double slack = 0.0;
  const int size = cornersOf(given.type);
  const bool areSeveral = std::ranges::count(isSource, true) > 1;
  for (std::size_t k = 0; areSeveral && k < cells.size(); ++k)
  {
    const std::int64_t* corner = given.cell(cells[k]);
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        slack = std::max(slack, 2 * (pointOf(given, corner[i]) - pointOf(given, corner[j])).norm());
      }
    }
  }
  for (std::int64_t v = 0; v < given.vertices(); ++v)
  {
    double straight = Infinite;
    for (std::int64_t s = 0; s < given.vertices(); ++s)
    {
      if (isSource[static_cast<std::size_t>(s)])
      {
        straight = std::min(straight, (pointOf(given, v) - pointOf(given, s)).norm());
      }
    }
    const double found = distances(v, 0), path = longest[static_cast<std::size_t>(v)];
    const bool isRight = path == Infinite
                           ? found == Infinite
                           : found <= path * (1 + 1e-6) && found >= (straight - slack) * (1 - 1e-6);
    if (!isRight)
    {
      std::ostringstream text;
      text << "vertex " << v << " has the distance " << found << ", not between " << straight
           << " and " << path;
      to.failure = text.str();
      return;
    }
  }
}

} // namespace

void checkDistance(const Case& given, CheckedCase& to)
{
  const TemporaryFolder folder;
  DistanceDescription description;
  const json& from = given.problem.at("from");
  description.from = from.empty() ? std::vector<Where>{} : readPlacesText(from.dump(), "from");
  description.wall = given.problem.at("wall");
  description.source = description.direction = true;
  const auto run = [&](const CaseRun& how)
  {
    const MemoryMesh mesh(given.stream(), how.blockCells);
    DistanceOptions options;
    options.threads = how.threads;
    options.scratch = folder.path();
    return valuesOf(*distance(mesh, description, options));
  };
  const Eigen::MatrixXd found = run(given.run);
  if (!sameBits(found, run(plain(given.run))))
  {
    to.failure = "does not have the bits of the plain run";
    return;
  }
  (description.wall ? checkWall : checkPaths)(given, found, to);
}

} // namespace smg::testing
