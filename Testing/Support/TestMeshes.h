// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace smg::testing
{

/** A mesh as in a file: points and cells in any order. */
struct IndexedTestMesh
{
  CellType cellType = CellType::Triangle;
  std::vector<double> positions;     ///< x, y, z per vertex
  std::vector<std::int64_t> corners; ///< cornersOf(cellType) per cell

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->corners.size() / cornersOf(this->cellType));
  }
};

/**
 * A flat lattice of nx x ny vertices (at least 2 x 2) in triangles of side 1, equilateral for
 * jitter 0. Vertices move by up to `jitter` in x and y; all angles stay acute below about 0.1.
 */
IndexedTestMesh grid(int nx, int ny, double jitter = 0.0, std::uint64_t seed = 1);

/** The grid with every sixth row of vertices `height` below the next one, with chains of slivers
 * between the two. */
IndexedTestMesh sliverChains(int nx, int ny, double height);

/** The grid with a triangle of this height outside of the edge from vertex nx / 2, the last vertex
 * its tip. */
IndexedTestMesh gridWithNeedle(int nx, int ny, double height);

/** A torus with radii 2 and 1 of nu x nv vertices (at least 3 x 3), jittered in its parameters. */
IndexedTestMesh torus(int nu, int nv, double jitter = 0.0, std::uint64_t seed = 1);

/** The triangles with each `every`-th cut into three by a point next to one of its edges: caps of
 * 179.4 to 179.9 degrees. */
IndexedTestMesh withCaps(const IndexedTestMesh& triangles, int every, std::uint64_t seed = 1);

/** The unit sphere: an icosahedron whose triangles are split into four `subdivisions` times. */
IndexedTestMesh sphere(int subdivisions);

/**
 * A box of nx x ny x nz vertices (at least 2 each) at unit distances, each cube cut into six
 * tetrahedra around its diagonal. Vertices move by up to `jitter` in each coordinate; below about
 * 0.2, no cell is inverted.
 */
IndexedTestMesh tetBox(int nx, int ny, int nz, double jitter = 0.0, std::uint64_t seed = 1);

/** Both meshes without a connection, with b moved by `offset`. The cell types must agree. */
IndexedTestMesh disjointUnion(
  const IndexedTestMesh& a, const IndexedTestMesh& b, const std::array<double, 3>& offset = {});

/** The mesh scaled by a factor about the origin. */
IndexedTestMesh resized(IndexedTestMesh mesh, double factor);

/** A surface with the triangles turned for whose numbers `isTurned` is true. */
IndexedTestMesh turned(
  IndexedTestMesh mesh, const std::function<bool(std::int64_t cell)>& isTurned);

/** The same mesh with its vertices and cells in a random order. */
IndexedTestMesh shuffled(const IndexedTestMesh& mesh, std::uint64_t seed = 1);

/** A small random generator with the same numbers for every compiler and library. */
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : State(seed)
  {
  }
  std::uint64_t bits();
  /** Uniform in [low, high). */
  double uniform(double low = 0.0, double high = 1.0);
  /** Uniform in 0 ... count-1. */
  std::int64_t below(std::int64_t count);

private:
  std::uint64_t State;
};

} // namespace smg::testing
