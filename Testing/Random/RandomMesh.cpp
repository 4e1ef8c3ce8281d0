// SPDX-License-Identifier: BSD-3-Clause
// Random meshes of a few hundred cells: closed and open, of several bodies, not manifold, with
// needles and slivers, flat, repeated and inverted cells, Delaunay tetrahedra, in orders that are
// not coherent.
#include "Testing/Random/Case.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace smg::testing
{
namespace
{

int between(Random& random, int low, int high)
{
  return low + static_cast<int>(random.below(high - low + 1));
}

bool chance(Random& random, double probability)
{
  return random.uniform() < probability;
}

/** A strip of obtuse triangles, each vertex nearly between its neighbours. */
IndexedTestMesh strip(Random& random)
{
  const int last = between(random, 4, 40);
  const double width = std::pow(10, random.uniform(-4, 0));
  IndexedTestMesh mesh;
  for (std::int64_t v = 0; v <= last; ++v)
  {
    mesh.positions.insert(
      mesh.positions.end(), { static_cast<double>(v), v % 2 == 0 ? 0.0 : width, 0.0 });
    if (v >= 2)
    {
      mesh.corners.insert(mesh.corners.end(), { v - 2, v - 1, v });
    }
  }
  return mesh;
}

IndexedTestMesh surface(Random& random)
{
  const std::uint64_t seed = random.bits();
  switch (random.below(6))
  {
    case 5:
      return strip(random);
    case 0:
      return torus(between(random, 3, 12), between(random, 3, 9), random.uniform(0, 0.2), seed);
    case 1:
      return sphere(between(random, 0, 2));
    case 2:
      return sliverChains(
        between(random, 4, 12), between(random, 7, 14), std::pow(10, random.uniform(-8, -1)));
    default:
      return grid(between(random, 2, 14), between(random, 2, 14),
        chance(random, 0.4) ? 0.0 : random.uniform(0, 0.4), seed);
  }
}

/** The Delaunay tetrahedra of random points, by insertion (Bowyer 1981, Watson 1981): with slivers,
 * and flat ones where points lie nearly in a plane. Rounding may let some overlap. */
IndexedTestMesh delaunay(Random& random)
{
  using Eigen::Vector3d;
  const int count = between(random, 8, 50);
  const double layer = chance(random, 0.5) ? std::pow(10, random.uniform(-12, -4)) : 1.0;
  std::vector<Vector3d> points{ { -50, -50, -50 }, { 150, -50, -50 }, { -50, 150, -50 },
    { -50, -50, 150 } };
  std::vector<std::array<std::int64_t, 4>> cells{ { 0, 1, 2, 3 } };
  const auto isInSphere = [&](const std::array<std::int64_t, 4>& cell, const Vector3d& p)
  {
    Eigen::Matrix4d lifted;
    Eigen::Matrix3d edges;
    for (int k = 0; k < 4; ++k)
    {
      const Vector3d to = points[static_cast<std::size_t>(cell[static_cast<std::size_t>(k)])] - p;
      lifted.row(k) << to.transpose(), to.squaredNorm();
    }
    for (int k = 0; k < 3; ++k)
    {
      edges.row(k) = (lifted.row(k + 1) - lifted.row(0)).head<3>();
    }
    return lifted.determinant() * edges.determinant() < 0.0;
  };
  for (int n = 0; n < count; ++n)
  {
    Vector3d p(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
    p[2] = chance(random, 0.5) ? std::floor(p[2]) + layer * random.uniform() : p[2];
    std::map<std::array<std::int64_t, 3>, int> faces; // of the cells whose spheres have the point
    std::erase_if(cells,
      [&](const std::array<std::int64_t, 4>& cell)
      {
        const bool isHit = isInSphere(cell, p);
        for (std::size_t k = 0; isHit && k < 4; ++k)
        {
          std::array<std::int64_t, 3> face{ cell[(k + 1) % 4], cell[(k + 2) % 4],
            cell[(k + 3) % 4] };
          std::ranges::sort(face);
          ++faces[face];
        }
        return isHit;
      });
    points.push_back(p);
    for (const auto& [face, times] : faces)
    {
      if (times == 1)
      {
        cells.push_back({ face[0], face[1], face[2], std::ssize(points) - 1 });
      }
    }
  }
  IndexedTestMesh mesh;
  mesh.cellType = CellType::Tetrahedron;
  for (const Vector3d& p : points)
  {
    mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
  }
  for (const std::array<std::int64_t, 4>& cell : cells)
  {
    if (std::ranges::min(cell) >= 4)
    {
      mesh.corners.insert(mesh.corners.end(), cell.begin(), cell.end());
    }
  }
  return mesh;
}

IndexedTestMesh solid(Random& random)
{
  if (chance(random, 0.25))
  {
    return delaunay(random);
  }
  // Above about 0.2 cells are inverted and overlap: the equations are well defined all the same.
  const double jitter = chance(random, 0.3) ? 0.0 : random.uniform(0, 0.35);
  return tetBox(
    between(random, 2, 6), between(random, 2, 5), between(random, 2, 5), jitter, random.bits());
}

/** Bends, stretches and moves the points. */
void place(IndexedTestMesh& mesh, Random& random)
{
  const double bend = chance(random, 0.5) ? random.uniform(0, 0.5) : 0.0;
  const double stretch = chance(random, 0.3) ? std::pow(10, random.uniform(-1, 1)) : 1.0;
  const std::array<double, 3> offset{ random.uniform(-1, 1), random.uniform(-1, 1), 0.5 };
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
  {
    double* p = mesh.positions.data() + v;
    p[2] += bend * std::sin(0.7 * p[0]) * std::cos(0.4 * p[1]);
    p[1] *= stretch;
    for (std::size_t k = 0; k < 3; ++k)
    {
      p[k] += offset[k];
    }
  }
}

/** Removes cells: holes, bodies that fall apart, blocks that touch at a vertex. */
void punch(IndexedTestMesh& mesh, Random& random)
{
  const auto size = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const double share = random.uniform(0, 0.4);
  std::vector<std::int64_t> corners;
  for (std::size_t c = 0; c < mesh.corners.size(); c += size)
  {
    if (corners.empty() || !chance(random, share))
    {
      corners.insert(corners.end(), mesh.corners.begin() + static_cast<std::ptrdiff_t>(c),
        mesh.corners.begin() + static_cast<std::ptrdiff_t>(c + size));
    }
  }
  mesh.corners = corners;
}

/** Lets two vertices be one: bodies that touch, edges and facets of several cells, cells that
 * repeat a corner. */
void merge(IndexedTestMesh& mesh, Random& random)
{
  const std::int64_t from = random.below(mesh.vertices()), to = random.below(mesh.vertices());
  std::ranges::replace(mesh.corners, from, to);
}

/** Adds a cell on a facet of the mesh: an edge of three triangles, a face of three tetrahedra. */
void addFin(IndexedTestMesh& mesh, Random& random)
{
  const auto size = static_cast<std::int64_t>(cornersOf(mesh.cellType));
  const std::int64_t c = random.below(mesh.cells());
  std::vector<std::int64_t> corners(
    mesh.corners.begin() + c * size, mesh.corners.begin() + (c + 1) * size);
  corners[static_cast<std::size_t>(random.below(size))] = mesh.vertices();
  const double* p = &mesh.positions[3 * static_cast<std::size_t>(mesh.corners[c * size])];
  const std::array<double, 3> tip{ p[0] + random.uniform(-1, 1), p[1] + random.uniform(-1, 1),
    p[2] + random.uniform(0.1, 1) };
  mesh.positions.insert(mesh.positions.end(), tip.begin(), tip.end());
  mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
}

/** Moves a vertex near a neighbour: needles, slivers, clusters. */
void pinch(IndexedTestMesh& mesh, Random& random)
{
  const auto size = static_cast<std::int64_t>(cornersOf(mesh.cellType));
  const std::int64_t c = random.below(mesh.cells());
  const std::int64_t a = mesh.corners[c * size], b = mesh.corners[c * size + 1];
  const double distance = std::pow(10, random.uniform(-6, -0.5));
  for (std::int64_t k = 0; k < 3; ++k)
  {
    double& x = mesh.positions[3 * a + k];
    x = mesh.positions[3 * b + k] + distance * (x - mesh.positions[3 * b + k]);
  }
}

void repeat(IndexedTestMesh& mesh, Random& random)
{
  const auto size = static_cast<std::int64_t>(cornersOf(mesh.cellType));
  const std::int64_t c = random.below(mesh.cells());
  std::vector<std::int64_t> corners(
    mesh.corners.begin() + c * size, mesh.corners.begin() + (c + 1) * size);
  std::ranges::rotate(corners, corners.begin() + 1);
  mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
}

/** Moves some cells to the end: blocks without vertices. */
void defer(std::vector<std::int64_t>& corners, std::size_t size, Random& random)
{
  const auto cells = static_cast<std::int64_t>(corners.size() / size);
  for (std::int64_t k = std::min<std::int64_t>(cells - 1, between(random, 1, 6)); k > 0; --k)
  {
    const auto c =
      static_cast<std::ptrdiff_t>(random.below(cells)) * static_cast<std::ptrdiff_t>(size);
    std::rotate(
      corners.begin() + c, corners.begin() + c + static_cast<std::ptrdiff_t>(size), corners.end());
  }
}

} // namespace

IndexedTestMesh randomMesh(Random& random)
{
  const bool isSolid = chance(random, 0.4);
  const auto body = [&]
  {
    IndexedTestMesh mesh = isSolid ? solid(random) : surface(random);
    place(mesh, random);
    return mesh;
  };
  IndexedTestMesh mesh = body();
  while (mesh.cells() < 300 && chance(random, 0.25))
  {
    mesh = disjointUnion(mesh, body(), { random.uniform(-9, 9), random.uniform(-9, 9), 2.0 });
  }
  // The tolerance is that of all bodies together: they are of about the same size.
  const double size = chance(random, 0.3) ? std::pow(10, random.uniform(-4, 4)) : 1.0;
  std::ranges::for_each(mesh.positions, [size](double& x) { x *= size; });
  using Change = void (*)(IndexedTestMesh&, Random&);
  const std::vector<std::pair<double, Change>> changes{ { 0.3, punch }, { 0.2, merge },
    { 0.25, addFin }, { 0.25, pinch }, { 0.2, repeat } };
  for (const auto& [probability, change] : changes)
  {
    for (int k = between(random, 1, 3); k > 0 && chance(random, probability); --k)
    {
      change(mesh, random);
    }
  }
  if (chance(random, 0.3))
  {
    mesh = shuffled(mesh, random.bits());
  }
  if (chance(random, 0.4))
  {
    defer(mesh.corners, static_cast<std::size_t>(cornersOf(mesh.cellType)), random);
  }
  return mesh;
}

} // namespace smg::testing
