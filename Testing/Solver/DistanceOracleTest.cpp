// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceSurfaces.h"
#include "Testing/Solver/DistanceTesting.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

// Exact distances on curved surfaces, against all straight paths: from each vertex every sequence
// of triangles is unfolded that it sees something through, no triangle twice, and the shortest
// chains of what vertices see of each other are found. That takes no windows, no queue and no
// pruning but by length.

namespace smg::testing
{
namespace
{

using Plane = Eigen::Vector2d;

double crossOf(const Plane& a, const Plane& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

class StraightPaths
{
public:
  explicit StraightPaths(const StreamMesh& mesh)
    : Mesh(mesh)
    , Used(mesh.corners.size() / 3, false)
    , Lengths(Eigen::MatrixXd::Constant(mesh.vertices(), mesh.vertices(), HUGE_VAL))
  {
    for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    {
      const std::int64_t a = mesh.corners[c], b = mesh.corners[c % 3 == 2 ? c - 2 : c + 1];
      this->Beside[std::minmax(a, b)].push_back(c / 3);
      this->Lengths(a, b) = this->Lengths(b, a) = this->edge(a, b);
    }
    this->AlongEdges = this->shortest();
    for (this->From = 0; this->From < mesh.vertices(); ++this->From)
    {
      const auto row = this->AlongEdges.row(this->From).array();
      this->Most = row.isFinite().select(row, 0.0).maxCoeff();
      for (std::size_t t = 0; t < this->Used.size(); ++t)
      {
        this->begin(t);
      }
    }
  }

  /** The shortest paths along edges. */
  const Eigen::MatrixXd& alongEdges() const { return this->AlongEdges; }
  /** The shortest chains (Floyd and Warshall). */
  Eigen::MatrixXd shortest() const
  {
    Eigen::MatrixXd all = this->Lengths;
    all.diagonal().setZero();
    for (Eigen::Index k = 0; k < all.rows(); ++k)
    {
      all = all.cwiseMin(all.col(k).replicate(1, all.cols()) + all.row(k).replicate(all.rows(), 1));
    }
    return all;
  }

private:
  double edge(std::int64_t a, std::int64_t b) const
  {
    return straightFrom(this->Mesh, a)(&this->Mesh.positions[3 * std::size_t(b)]);
  }

  /** Through the edge of a triangle that is opposite to the vertex, from the right to the left. */
  void begin(std::size_t triangle)
  {
    const std::int64_t* const corner = &this->Mesh.corners[3 * triangle];
    const std::int64_t k = std::find(corner, corner + 3, this->From) - corner;
    if (k == 3)
    {
      return;
    }
    const std::int64_t right = corner[(k + 1) % 3], left = corner[(k + 2) % 3];
    const double r = this->edge(this->From, right), l = this->edge(this->From, left),
                 across = this->edge(right, left);
    const double cosine = (r * r + l * l - across * across) / (2 * r * l);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    const Plane atRight(r, 0), atLeft(l * std::cos(angle), l * std::sin(angle));
    this->go(triangle, right, left, atRight, atLeft, atRight, atLeft);
  }

  /** On through the edge between `right` and `left`, between two rays. */
  void go(std::size_t triangle, std::int64_t right, std::int64_t left, const Plane& atRight,
    const Plane& atLeft, const Plane& firstRay, const Plane& lastRay)
  {
    this->Used[triangle] = true;
    for (const std::size_t next : this->Beside.at(std::minmax(right, left)))
    {
      if (this->Used[next])
      {
        continue;
      }
      const std::int64_t* const corner = &this->Mesh.corners[3 * next];
      const std::int64_t apex =
        *std::find_if(corner, corner + 3, [&](std::int64_t v) { return v != right && v != left; });
      const Plane along = atLeft - atRight;
      const double whole = along.norm(), r = this->edge(right, apex), l = this->edge(left, apex);
      const double x = (r * r + whole * whole - l * l) / (2 * whole);
      const double height = std::sqrt(std::max(r * r - x * x, 0.0));
      // Away from the origin, which lies to the left of the way from right to left.
      const Plane at = atRight + x / whole * along + height / whole * Plane(along[1], -along[0]);
      const double size = 1e-12 * at.norm();
      if (crossOf(firstRay, at) >= -size * firstRay.norm() &&
          crossOf(at, lastRay) >= -size * lastRay.norm())
      {
        double& known = this->Lengths(this->From, apex);
        known = std::min(known, at.norm());
      }
      if (crossOf(firstRay, at) > 0 && isNear(atRight, at))
      {
        this->go(next, right, apex, atRight, at, firstRay, crossOf(at, lastRay) > 0 ? at : lastRay);
      }
      if (crossOf(at, lastRay) > 0 && isNear(at, atLeft))
      {
        this->go(next, apex, left, at, atLeft, crossOf(firstRay, at) > 0 ? at : firstRay, lastRay);
      }
    }
    this->Used[triangle] = false;
  }

  bool isNear(const Plane& a, const Plane& b) const
  {
    const Plane edge = b - a;
    const double share = std::clamp(-a.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (a + share * edge).norm() <= this->Most;
  }

  const StreamMesh& Mesh;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> Beside;
  std::vector<bool> Used;
  Eigen::MatrixXd Lengths, AlongEdges; ///< of straight paths; the shortest along edges
  std::int64_t From = 0;
  double Most = 0;
};

/** The mesh with triangles on some of its edges, at which more than two meet. */
IndexedTestMesh finned(IndexedTestMesh mesh, Random& random)
{
  const std::int64_t corners = std::ssize(mesh.corners);
  for (int fin = 0; fin < 20; ++fin)
  {
    const auto c = static_cast<std::size_t>(random.below(corners));
    const std::int64_t a = mesh.corners[c], b = mesh.corners[c % 3 == 2 ? c - 2 : c + 1];
    mesh.corners.insert(mesh.corners.end(), { a, b, mesh.vertices() });
    for (std::size_t k = 0; k < 3; ++k)
    {
      mesh.positions.push_back(
        random.uniform(0.5, 0.8) * (mesh.positions[3 * static_cast<std::size_t>(a) + k] +
                                     mesh.positions[3 * static_cast<std::size_t>(b) + k]));
    }
  }
  return mesh;
}

/** Small surfaces of any curvature: closed and open, rough, of long triangles, of several bodies,
 * with fins.
 */
std::vector<KnownSurface> curvedSurfaces()
{
  std::vector<KnownSurface> all;
  Random random(41);
  const auto rough = [&random](IndexedTestMesh mesh, double noise, double flatness)
  {
    for (std::size_t k = 0; k < mesh.positions.size(); ++k)
    {
      mesh.positions[k] += random.uniform(-noise, noise);
      mesh.positions[k] /= k % 3 == 2 ? flatness : 1.0;
    }
    return toStream(mesh);
  };
  for (const double noise : { 0.0, 0.05, 0.2 })
  {
    for (const double flatness : { 1.0, 8.0 })
    {
      const std::string name = std::to_string(noise) + ", 1 : " + std::to_string(flatness);
      all.push_back({ "torus, " + name, rough(torus(15, 11, noise), noise, flatness), {} });
      all.push_back({ "sphere, " + name, rough(sphere(2), 0.3 * noise, flatness), {} });
      all.push_back(
        { "fins, " + name, rough(finned(sphere(2), random), 0.3 * noise, flatness), {} });
    }
  }
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    all.push_back(tornSurface(seed, 12));
  }
  return all;
}

} // namespace

TEST(DistanceOracle, ExactOnesAreTheShortestOfAllPaths)
{
  for (const KnownSurface& surface : curvedSurfaces())
  {
    SCOPED_TRACE(surface.name);
    const MemoryMesh mesh(surface.mesh);
    const StraightPaths paths(surface.mesh);
    const Eigen::MatrixXd exact = paths.shortest();
    EXPECT_GT((paths.alongEdges().array() > 1.01 * exact.array()).count(), exact.size() / 3);
    for (std::int64_t source = 0; source < surface.mesh.vertices(); source += 7)
    {
      const Eigen::VectorXd found =
        measure(mesh, fromPoints({ source }, PathAccuracy::Exact)).values.col(0);
      for (std::int64_t v = 0; v < surface.mesh.vertices(); ++v)
      {
        EXPECT_TRUE(found[v] == exact(source, v) ||
                    std::abs(found[v] - exact(source, v)) <= 1e-9 * exact(source, v))
          << found[v] << " instead of " << exact(source, v) << " from " << source << " to " << v;
      }
    }
  }
}

} // namespace smg::testing
