// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/DistanceTesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

// Surfaces of random triangles, up to 1 : 10,000, flat, folded, in cones of any angle, with holes
// and in several bodies. Where the surface unfolds into the plane, exact distances are known
// without any method.

namespace smg::testing
{

/** A rectangle of random triangles, y divided by `flatness`. */
inline KnownSurface flatSurface(double flatness, double jitter)
{
  IndexedTestMesh mesh = unitSquare(22, jitter);
  std::vector<std::array<double, 2>> plane;
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k + 1] /= flatness;
    plane.push_back({ mesh.positions[k], mesh.positions[k + 1] });
  }
  return unfolding("flat, 1 : " + std::to_string(flatness), mesh, std::move(plane), &straight);
}

/** A sheet that is folded along lines of constant x to and fro. */
inline KnownSurface foldedSurface(double angle, double flatness)
{
  constexpr int n = 20;
  IndexedTestMesh mesh = unitSquare(n, 0);
  Random random(3);
  std::vector<std::array<double, 2>> plane;
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    double& x = mesh.positions[k];
    double& y = mesh.positions[k + 1];
    y += y > 0 && y < 1 ? random.uniform(-0.4, 0.4) / n : 0.0;
    y /= flatness;
    plane.push_back({ x, y });
    const int line = static_cast<int>(std::lround(x * n));
    mesh.positions[k + 2] = line % 2 * std::sin(angle) / n;
    x *= std::cos(angle);
  }
  return unfolding("folded by " + std::to_string(angle), mesh, std::move(plane), &straight);
}

/** Rings of random triangles around the tip of a cone with this angle around it: of a spherical
 * kind below 2 pi, of a saddle above it. Points of the plane are radius and angle. */
inline KnownSurface coneSurface(double whole)
{
  constexpr int Rings = 12, Sides = 30;
  Random random(9);
  IndexedTestMesh mesh;
  std::vector<std::array<double, 2>> polar{ { 0, 0 } };
  mesh.positions = { 0, 0, 0 };
  const double side = whole / Sides;
  for (int ring = 1; ring <= Rings; ++ring)
  {
    for (int k = 0; k < Sides; ++k)
    {
      const bool isInside = ring < Rings;
      const double r = (ring + (isInside ? random.uniform(-0.3, 0.3) : 0.0)) / Rings;
      // Sectors of the unfolded cone are flat; one leans against the next as the cone needs.
      polar.push_back({ r, side * k });
      const std::int64_t a = 1 + (ring - 1) * Sides + k,
                         b = 1 + (ring - 1) * Sides + (k + 1) % Sides;
      if (ring == 1)
      {
        mesh.corners.insert(mesh.corners.end(), { 0, a, b });
      }
      else
      {
        const bool rising = (ring + k) % 2 == 0;
        mesh.corners.insert(mesh.corners.end(),
          { a - Sides, a, rising ? b : b - Sides, rising ? a - Sides : a, b, b - Sides });
      }
    }
  }
  // In space: a chord of each sector, with heights to and fro where the angle is too large, so that
  // neighbouring rays have the angle `side` between them.
  for (std::size_t v = 1; v < polar.size(); ++v)
  {
    const int k = (static_cast<int>(v) - 1) % Sides;
    const double turn = 2 * std::numbers::pi * k / Sides;
    const double flat = 2 * std::numbers::pi / Sides;
    // Rays (c cos turn, c sin turn, +-s): for a cone the same sign, for a saddle in turn.
    const bool isSaddle = whole > 2 * std::numbers::pi;
    // cos(side) = c^2 cos(flat) +- s^2, with c^2 + s^2 = 1.
    const double square = isSaddle ? (std::cos(side) + 1) / (std::cos(flat) + 1)
                                   : (1 - std::cos(side)) / (1 - std::cos(flat));
    const double c = std::sqrt(std::min(square, 1.0)), s = std::sqrt(std::max(1 - square, 0.0));
    const double r = polar[v][0];
    mesh.positions.insert(mesh.positions.end(),
      { r * c * std::cos(turn), r * c * std::sin(turn), r * (isSaddle && k % 2 == 1 ? -s : s) });
  }
  return unfolding("cone of " + std::to_string(whole), mesh, std::move(polar),
    [whole](const std::array<double, 2>& a, const std::array<double, 2>& b)
    {
      const double between = std::abs(a[1] - b[1]), angle = std::min(between, whole - between);
      const double x = a[0] - b[0] * std::cos(angle), y = b[0] * std::sin(angle);
      return angle < std::numbers::pi ? std::hypot(x, y) : a[0] + b[0];
    });
}

/** A curved surface with holes, of several bodies. */
inline KnownSurface tornSurface(std::uint64_t seed, int n = 24)
{
  Random random(seed);
  IndexedTestMesh mesh = unitSquare(n);
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k + 2] =
      0.2 * std::sin(7 * mesh.positions[k]) * std::cos(5 * mesh.positions[k + 1]) +
      random.uniform(-0.01, 0.01);
  }
  std::vector<std::int64_t> kept;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
  {
    if (random.below(6) > 0)
    {
      kept.insert(kept.end(), mesh.corners.begin() + std::ptrdiff_t(c),
        mesh.corners.begin() + std::ptrdiff_t(c) + 3);
    }
  }
  mesh.corners = std::move(kept);
  return { "torn", toStream(mesh), {} };
}

inline std::vector<KnownSurface> surfaces()
{
  std::vector<KnownSurface> all;
  for (const double flatness : { 1.0, 10.0, 100.0, 10'000.0 })
  {
    all.push_back(flatSurface(flatness, 0.24));
  }
  all.push_back(flatSurface(100.0, 0.0));
  for (const double angle : { 0.3, 1.2, 1.5 })
  {
    all.push_back(foldedSurface(angle, 1.0));
    all.push_back(foldedSurface(angle, 50.0));
  }
  for (const double whole : { 1.0, 3.0, 5.5, 6.6, 8.0, 12.0 })
  {
    all.push_back(coneSurface(whole));
  }
  all.push_back(tornSurface(1));
  all.push_back(tornSurface(2));
  return all;
}

inline std::vector<std::int64_t> someVertices(const StreamMesh& mesh, int count, Random& random)
{
  std::vector<std::int64_t> ids;
  for (int k = 0; k < count; ++k)
  {
    ids.push_back(random.below(mesh.vertices()));
  }
  // Neighbours, too: the corners of a triangle.
  ids.insert(ids.end(), mesh.corners.begin(), mesh.corners.begin() + 2);
  return ids;
}

} // namespace smg::testing
