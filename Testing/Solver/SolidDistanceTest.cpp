// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

// Laws of distances through solids whose cells are flat up to 1 : 10,000: in convex ones they are
// straight lines, and around an edge they are known.

namespace smg::testing
{
namespace
{

/** The unit cube, without the quarter where x and y are above 1/2 if it has a `notch`; z divided by
 * `flatness`. Inner vertices are moved. */
StreamMesh solid(bool notch, double flatness)
{
  constexpr int n = 10;
  IndexedTestMesh mesh = tetBox(n + 1, n + 1, n + 1);
  const auto isCut = [&](double x, double y) { return notch && x > n / 2 && y > n / 2; };
  IndexedTestMesh kept;
  kept.cellType = mesh.cellType;
  std::vector<std::int64_t> place(mesh.positions.size() / 3, -1);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    double middle[2] = { 0, 0 };
    for (std::size_t k = 0; k < 8; ++k)
    {
      const auto corner = 3 * static_cast<std::size_t>(mesh.corners[c + k / 2]);
      middle[k % 2] += mesh.positions[corner + k % 2] / 4;
    }
    for (std::size_t k = 0; k < 4 && !isCut(middle[0], middle[1]); ++k)
    {
      const auto corner = static_cast<std::size_t>(mesh.corners[c + k]);
      if (place[corner] < 0)
      {
        place[corner] = std::ssize(kept.positions) / 3;
        const auto begin = mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * corner);
        kept.positions.insert(kept.positions.end(), begin, begin + 3);
      }
      kept.corners.push_back(place[corner]);
    }
  }
  Random random(3);
  for (std::size_t k = 0; k < kept.positions.size(); k += 3)
  {
    double* const p = &kept.positions[k];
    const bool isOnNotch = notch && std::max(p[0], p[1]) >= n / 2 && std::min(p[0], p[1]) >= n / 2;
    const bool isInside =
      std::all_of(p, p + 3, [](double x) { return x > 0 && x < n; }) && !isOnNotch;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = (p[axis] + (isInside ? random.uniform(-0.2, 0.2) : 0.0)) / n;
    }
    p[2] /= flatness;
  }
  return toStream(kept);
}

/** The distance around the edge of the notch, x = y = 1/2. */
double aroundNotch(const double* a, const double* b)
{
  const double whole = std::hypot(a[0] - b[0], a[1] - b[1]);
  // On which side of the edge the line between passes it: the notch is to the right of the way from
  // large x to large y.
  const double *p = a[0] > b[0] ? a : b, *q = a[0] > b[0] ? b : a;
  const double side = (q[0] - p[0]) * (0.5 - p[1]) - (q[1] - p[1]) * (0.5 - p[0]);
  const bool isBlocked = p[0] > 0.5 && q[1] > 0.5 && side > 0;
  const double around = std::hypot(p[0] - 0.5, p[1] - 0.5) + std::hypot(q[0] - 0.5, q[1] - 0.5);
  return std::hypot(isBlocked ? around : whole, a[2] - b[2]);
}

} // namespace

TEST(SolidDistances, AreStraightLinesInConvexSolidsWhateverTheCells)
{
  for (const double flatness : { 1.0, 10.0, 100.0, 10'000.0 })
  {
    const MemoryMesh mesh(solid(false, flatness));
    const StreamMesh& stream = mesh.mesh();
    Random random(7);
    for (const int count : { 1, 1, 5 })
    {
      std::vector<std::int64_t> sources;
      for (int k = 0; k < count; ++k)
      {
        sources.push_back(random.below(stream.vertices()));
      }
      for (const std::int64_t chunk : { 100000, 1 })
      {
        SCOPED_TRACE("1 : " + std::to_string(flatness) + ", " + std::to_string(count) +
                     " sources, chunks of " + std::to_string(chunk));
        const Solved found = measureInChunks(mesh, fromVertices(sources), chunk);
        for (std::int64_t v = 0; v < stream.vertices(); ++v)
        {
          double exact = HUGE_VAL;
          for (const std::int64_t source : sources)
          {
            exact =
              std::min(exact, straightFrom(stream, source)(&stream.positions[3 * std::size_t(v)]));
          }
          // A line that leaves the window is not seen.
          EXPECT_NEAR(found.values(v, 0), exact, (chunk == 1 ? 5e-3 : 1e-7) * exact) << v;
          EXPECT_GE(found.values(v, 0), (1 - 1e-7) * exact) << v;
        }
      }
    }
  }
}

TEST(SolidDistances, AreNotShorterThanThePathAroundAnEdge)
{
  for (const double flatness : { 1.0, 10.0, 1000.0 })
  {
    const MemoryMesh mesh(solid(true, flatness));
    const StreamMesh& stream = mesh.mesh();
    Random random(11);
    for (int run = 0; run < 3; ++run)
    {
      const std::int64_t source = random.below(stream.vertices());
      const Solved found = measure(mesh, fromVertices({ source }));
      double mean = 0;
      for (std::int64_t v = 0; v < stream.vertices(); ++v)
      {
        const double exact = aroundNotch(
          &stream.positions[3 * std::size_t(source)], &stream.positions[3 * std::size_t(v)]);
        EXPECT_GE(found.values(v, 0), (1 - 1e-6) * exact) << v;
        mean += exact > 0 ? (found.values(v, 0) / exact - 1) / double(stream.vertices()) : 0.0;
      }
      EXPECT_LT(mean, 0.01) << "1 : " << flatness;
    }
  }
}

} // namespace smg::testing
