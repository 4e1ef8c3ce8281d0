// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace smg::testing
{
namespace
{

void addPoint(IndexedTestMesh& mesh, double x, double y, double z)
{
  mesh.positions.insert(mesh.positions.end(), { x, y, z });
}

/** Splits every triangle into four, with the new vertices on the unit sphere. */
IndexedTestMesh subdivided(const IndexedTestMesh& mesh)
{
  IndexedTestMesh fine{ CellType::Triangle, mesh.positions, {} };
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
  const auto middle = [&](std::int64_t a, std::int64_t b)
  {
    const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), fine.vertices());
    if (isNew)
    {
      std::array<double, 3> sum{};
      for (int k = 0; k < 3; ++k)
      {
        sum[k] = fine.positions[3 * a + k] + fine.positions[3 * b + k];
      }
      const double length = std::hypot(sum[0], sum[1], sum[2]);
      addPoint(fine, sum[0] / length, sum[1] / length, sum[2] / length);
    }
    return entry->second;
  };
  for (std::int64_t t = 0; t < mesh.cells(); ++t)
  {
    const std::int64_t a = mesh.corners[3 * t];
    const std::int64_t b = mesh.corners[3 * t + 1];
    const std::int64_t c = mesh.corners[3 * t + 2];
    const std::int64_t ab = middle(a, b);
    const std::int64_t bc = middle(b, c);
    const std::int64_t ca = middle(c, a);
    fine.corners.insert(fine.corners.end(), { a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca });
  }
  return fine;
}

/** A random order of 0 ... count-1. */
std::vector<std::int64_t> permutation(std::int64_t count, Random& random)
{
  std::vector<std::int64_t> order(count);
  std::iota(order.begin(), order.end(), std::int64_t(0));
  for (std::int64_t i = count - 1; i > 0; --i)
  {
    std::swap(order[i], order[random.below(i + 1)]);
  }
  return order;
}

} // namespace

std::uint64_t Random::bits()
{
  // splitmix64
  std::uint64_t z = (this->State += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

double Random::uniform(double low, double high)
{
  return low + (high - low) * (static_cast<double>(this->bits() >> 11) * 0x1p-53);
}

std::int64_t Random::below(std::int64_t count)
{
  return static_cast<std::int64_t>(this->bits() % static_cast<std::uint64_t>(count));
}

IndexedTestMesh grid(int nx, int ny, double jitter, std::uint64_t seed)
{
  IndexedTestMesh mesh;
  Random random(seed);
  const double height = std::sqrt(3.0) / 2.0;
  for (int j = 0; j < ny; ++j)
  {
    for (int i = 0; i < nx; ++i)
    {
      const double x = i + 0.5 * (j % 2) + random.uniform(-jitter, jitter);
      const double y = j * height + random.uniform(-jitter, jitter);
      addPoint(mesh, x, y, 0.0);
    }
  }
  for (int j = 0; j + 1 < ny; ++j)
  {
    for (int i = 0; i + 1 < nx; ++i)
    {
      // Odd rows are shifted to the right, so the short diagonal alternates.
      const std::int64_t a = std::int64_t(j) * nx + i;
      const std::int64_t b = a + 1;
      const std::int64_t c = a + nx;
      const std::int64_t d = c + 1;
      if (j % 2 == 0)
      {
        mesh.corners.insert(mesh.corners.end(), { a, b, c, b, d, c });
      }
      else
      {
        mesh.corners.insert(mesh.corners.end(), { a, b, d, a, d, c });
      }
    }
  }
  return mesh;
}

IndexedTestMesh gridWithNeedle(int nx, int ny, double height)
{
  IndexedTestMesh mesh = grid(nx, ny);
  const std::int64_t a = nx / 2, b = a + 1, tip = mesh.vertices();
  addPoint(mesh, a + 0.5, -height, 0.0);
  mesh.corners.insert(mesh.corners.end(), { b, a, tip });
  return mesh;
}

IndexedTestMesh sliverChains(int nx, int ny, double height)
{
  IndexedTestMesh mesh = grid(nx, ny);
  const std::size_t row = 3 * static_cast<std::size_t>(nx);
  for (std::size_t y = 1; y + row < mesh.positions.size(); y += 3)
  {
    if (y / row % 6 == 2)
    {
      mesh.positions[y] = mesh.positions[y + row] - height;
    }
  }
  return mesh;
}

IndexedTestMesh torus(int nu, int nv, double jitter, std::uint64_t seed)
{
  IndexedTestMesh mesh;
  Random random(seed);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const double u = 2 * std::numbers::pi * (i + random.uniform(-jitter, jitter)) / nu;
      const double v = 2 * std::numbers::pi * (j + random.uniform(-jitter, jitter)) / nv;
      const double ring = 2 + std::cos(v);
      addPoint(mesh, ring * std::cos(u), ring * std::sin(u), std::sin(v));
    }
  }
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const std::int64_t row = std::int64_t(j) * nu;
      const std::int64_t nextRow = std::int64_t((j + 1) % nv) * nu;
      const int right = (i + 1) % nu;
      mesh.corners.insert(mesh.corners.end(),
        { row + i, row + right, nextRow + i, row + right, nextRow + right, nextRow + i });
    }
  }
  return mesh;
}

IndexedTestMesh withCaps(const IndexedTestMesh& triangles, int every, std::uint64_t seed)
{
  IndexedTestMesh mesh{ CellType::Triangle, triangles.positions, {} };
  Random random(seed);
  for (std::int64_t t = 0; t < triangles.cells(); ++t)
  {
    const std::int64_t* v = triangles.corners.data() + 3 * t;
    const std::int64_t first = random.below(3);
    const std::int64_t a = v[first], b = v[(first + 1) % 3], c = v[(first + 2) % 3];
    if (t % every != every / 2)
    {
      mesh.corners.insert(mesh.corners.end(), { v[0], v[1], v[2] });
      continue;
    }
    // Beside the place at `share` of the edge from a to b, towards c. The two angles at the edge,
    // which are nearly the height over their parts of it, sum to `slope`.
    const double share = random.uniform(0.3, 0.7);
    const double slope = random.uniform(0.1, 0.6) * std::numbers::pi / 180.0;
    double place[3], towards[3], edge = 0.0, side = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double along = mesh.positions[3 * b + k] - mesh.positions[3 * a + k];
      place[k] = mesh.positions[3 * a + k] + share * along;
      towards[k] = mesh.positions[3 * c + k] - place[k];
      edge += along * along;
      side += towards[k] * towards[k];
    }
    const double height = slope * std::sqrt(edge) * share * (1.0 - share) / std::sqrt(side);
    const std::int64_t tip = mesh.vertices();
    addPoint(mesh, place[0] + height * towards[0], place[1] + height * towards[1],
      place[2] + height * towards[2]);
    mesh.corners.insert(mesh.corners.end(), { a, b, tip, b, c, tip, c, a, tip });
  }
  return mesh;
}

IndexedTestMesh sphere(int subdivisions)
{
  const double p = std::numbers::phi / std::hypot(1.0, std::numbers::phi);
  const double q = 1.0 / std::hypot(1.0, std::numbers::phi);
  IndexedTestMesh mesh;
  mesh.positions = { -q, p, 0, q, p, 0, -q, -p, 0, q, -p, 0, 0, -q, p, 0, q, p, 0, -q, -p, 0, q, -p,
    p, 0, -q, p, 0, q, -p, 0, -q, -p, 0, q };
  mesh.corners = { 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2,
    10, 7, 6, 7, 1, 8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8,
    6, 7, 9, 8, 1 };
  for (int i = 0; i < subdivisions; ++i)
  {
    mesh = subdivided(mesh);
  }
  return mesh;
}

IndexedTestMesh tetBox(int nx, int ny, int nz, double jitter, std::uint64_t seed)
{
  IndexedTestMesh mesh;
  mesh.cellType = CellType::Tetrahedron;
  Random random(seed);
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx; ++i)
      {
        const double x = i + random.uniform(-jitter, jitter);
        const double y = j + random.uniform(-jitter, jitter);
        const double z = k + random.uniform(-jitter, jitter);
        addPoint(mesh, x, y, z);
      }
    }
  }
  const std::array<std::int64_t, 3> step = { 1, nx, std::int64_t(nx) * ny };
  // One tetrahedron for each order of the three steps of a path from corner to corner; for odd
  // orders, its orientation is reversed.
  constexpr int paths[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 1, 0, 2 }, { 0, 2, 1 },
    { 2, 1, 0 } };
  for (int k = 0; k + 1 < nz; ++k)
  {
    for (int j = 0; j + 1 < ny; ++j)
    {
      for (int i = 0; i + 1 < nx; ++i)
      {
        const std::int64_t a = i + j * step[1] + k * step[2];
        for (int path = 0; path < 6; ++path)
        {
          std::int64_t b = a + step[paths[path][0]];
          std::int64_t c = b + step[paths[path][1]];
          const std::int64_t d = c + step[paths[path][2]];
          if (path >= 3)
          {
            std::swap(b, c);
          }
          mesh.corners.insert(mesh.corners.end(), { a, b, c, d });
        }
      }
    }
  }
  return mesh;
}

IndexedTestMesh disjointUnion(
  const IndexedTestMesh& a, const IndexedTestMesh& b, const std::array<double, 3>& offset)
{
  IndexedTestMesh both = a;
  for (std::size_t i = 0; i < b.positions.size(); ++i)
  {
    both.positions.push_back(b.positions[i] + offset[i % 3]);
  }
  for (const std::int64_t corner : b.corners)
  {
    both.corners.push_back(corner + a.vertices());
  }
  return both;
}

IndexedTestMesh resized(IndexedTestMesh mesh, double factor)
{
  std::ranges::for_each(mesh.positions, [factor](double& x) { x *= factor; });
  return mesh;
}

IndexedTestMesh turned(IndexedTestMesh mesh, const std::function<bool(std::int64_t cell)>& isTurned)
{
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    if (isTurned(c))
    {
      const auto first = mesh.corners.begin() + 3 * c;
      std::iter_swap(first + 1, first + 2);
    }
  }
  return mesh;
}

IndexedTestMesh shuffled(const IndexedTestMesh& mesh, std::uint64_t seed)
{
  Random random(seed);
  const int size = cornersOf(mesh.cellType);
  const std::vector<std::int64_t> place = permutation(mesh.vertices(), random);
  const std::vector<std::int64_t> order = permutation(mesh.cells(), random);
  IndexedTestMesh result = mesh;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    std::copy_n(mesh.positions.begin() + 3 * v, 3, result.positions.begin() + 3 * place[v]);
  }
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < size; ++k)
    {
      result.corners[size * c + k] = place[mesh.corners[size * order[c] + k]];
    }
  }
  return result;
}

} // namespace smg::testing
