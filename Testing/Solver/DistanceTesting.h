// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Jobs/Distance/PathDistance.h"
#include "Solver/Jobs/Distance/TriangleTree.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/Distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** Sources by their numbers in the stream. */
inline DistanceDescription fromVertices(std::vector<std::int64_t> ids)
{
  DistanceDescription description;
  description.from.emplace_back(Region(Region::Vertices{ std::move(ids) }));
  return description;
}

/** Distances at all vertices, a row per vertex, and their report. */
inline Solved measure(const StoredMesh& mesh, const DistanceDescription& description,
  const DistanceOptions& options = {})
{
  const std::unique_ptr<Solution> solution = distance(mesh, description, options);
  return { valuesOf(*solution), solution->report() };
}

/** The same along paths, with chunks of so many vertices. */
inline Solved measureInChunks(const StoredMesh& mesh, const DistanceDescription& description,
  std::int64_t chunkVertices, const DistanceOptions& options = {})
{
  const std::unique_ptr<Solution> solution = pathDistance(
    mesh, description, std::make_unique<DistanceRun>(options), "distance", chunkVertices);
  return { valuesOf(*solution), solution->report() };
}

/** The same of points, with the sources. */
inline DistanceDescription fromPoints(std::vector<std::int64_t> ids, PathAccuracy accuracy)
{
  DistanceDescription description = fromVertices(std::move(ids));
  description.accuracy = accuracy;
  description.source = true;
  return description;
}

/** A surface, and the exact distance between two of its vertices, where that is known. */
struct KnownSurface
{
  std::string name;
  StreamMesh mesh;
  std::function<double(std::int64_t, std::int64_t)> exact; ///< empty: not known
};

/** The stream, and for each of its vertices the point of `plane`, of the mesh before. */
inline KnownSurface unfolding(std::string name, const IndexedTestMesh& mesh,
  std::vector<std::array<double, 2>> plane,
  std::function<double(const std::array<double, 2>&, const std::array<double, 2>&)> distance)
{
  StreamMesh stream = toStream(mesh);
  std::vector<std::array<double, 2>> points;
  for (const std::int64_t id : stream.originalIds)
  {
    points.push_back(plane[static_cast<std::size_t>(id)]);
  }
  return { std::move(name), std::move(stream),
    [points = std::move(points), distance = std::move(distance)](std::int64_t a, std::int64_t b) {
      return distance(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]);
    } };
}

inline double straight(const std::array<double, 2>& a, const std::array<double, 2>& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/** Moves the inner vertices of a mesh in the unit square or cube by up to `jitter`, in the first
 * `axes` coordinates. */
inline void jitterInside(IndexedTestMesh& mesh, int axes, double jitter)
{
  Random random(5);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
  {
    const auto begin = mesh.positions.begin() + static_cast<std::ptrdiff_t>(v);
    if (std::all_of(begin, begin + axes, [](double x) { return x > 0 && x < 1; }))
    {
      std::for_each(begin, begin + axes, [&](double& x) { x += random.uniform(-jitter, jitter); });
    }
  }
}

/** The unit square in n x n cells of two triangles, with inner vertices moved. */
inline IndexedTestMesh unitSquare(int n, double jitter = 0.2)
{
  IndexedTestMesh mesh;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      mesh.positions.insert(mesh.positions.end(), { double(j) / n, double(i) / n, 0.0 });
      if (i < n && j < n)
      {
        const std::int64_t a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
        const bool rising = (i + j) % 2 == 0;
        mesh.corners.insert(mesh.corners.end(), { a, b, rising ? d : c, rising ? a : b, d, c });
      }
    }
  }
  jitterInside(mesh, 2, jitter / n);
  return mesh;
}

/** The unit cube in n x n x n cells of six tetrahedra, with inner vertices moved. */
inline IndexedTestMesh unitCube(int n, double jitter = 0.1)
{
  IndexedTestMesh mesh = tetBox(n + 1, n + 1, n + 1);
  std::ranges::for_each(mesh.positions, [n](double& x) { x /= n; });
  jitterInside(mesh, 3, jitter / n);
  return mesh;
}

/** The stream vertex nearest to a point. */
inline std::int64_t nearestTo(const StreamMesh& mesh, double x, double y, double z)
{
  std::int64_t nearest = 0;
  double least = HUGE_VAL;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = mesh.positions.data() + 3 * v;
    const double distance = std::hypot(p[0] - x, p[1] - y, p[2] - z);
    nearest = distance < least ? v : nearest;
    least = std::min(least, distance);
  }
  return nearest;
}

/** Relative errors of distances where the exact ones are not 0. */
struct RelativeErrors
{
  double mean = 0;
  double largest = 0; ///< of exact distances beyond 5 % of the largest one
};

/** The errors against exact(position). */
inline RelativeErrors errorsOf(const Solved& solved, const StreamMesh& mesh, const auto& exact)
{
  std::vector<double> all;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    all.push_back(exact(mesh.positions.data() + 3 * v));
  }
  const double farthest = *std::ranges::max_element(all);
  RelativeErrors errors;
  std::int64_t count = 0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double distance = all[static_cast<std::size_t>(v)];
    if (distance > 0)
    {
      const double error = std::abs(solved.values(v, 0) - distance) / distance;
      errors.mean += error;
      ++count;
      errors.largest =
        distance > 0.05 * farthest ? std::max(errors.largest, error) : errors.largest;
    }
  }
  errors.mean /= static_cast<double>(std::max<std::int64_t>(count, 1));
  return errors;
}

/** The Euclidean distance from vertex `source`. */
inline auto straightFrom(const StreamMesh& mesh, std::int64_t source)
{
  const double* s = mesh.positions.data() + 3 * source;
  return [s](const double* p) { return std::hypot(p[0] - s[0], p[1] - s[1], p[2] - s[2]); };
}

/** The distance of a point to the nearest of the triangles. */
inline double straightTo(const std::vector<TrianglePoints>& triangles, const double* point)
{
  double least = HUGE_VAL;
  for (const TrianglePoints& triangle : triangles)
  {
    const Vector way = difference(nearestPoint(triangle, point).data(), point);
    least = std::min(least, std::sqrt(dot(way, way)));
  }
  return least;
}

} // namespace smg::testing
