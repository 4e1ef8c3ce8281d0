// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Support/DirectSmoothing.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/Smooth.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace smg::testing
{

/** The mesh with each coordinate moved by up to `noise`. */
inline StreamMesh noisy(StreamMesh mesh, double noise, std::uint64_t seed = 7)
{
  Random random(seed);
  for (double& x : mesh.positions)
  {
    x += random.uniform(-noise, noise);
  }
  return mesh;
}

/** Options of one accurate step of size 1 that do no more than solve it. */
inline Smoothing plainStep(double size = 1.0)
{
  Smoothing options;
  options.size = { size, SmoothingSize::Mesh };
  options.keepVolume = false;
  options.boundary = SmoothedBoundary::Free;
  options.tolerance = 1e-11;
  return options;
}

/** t of a step of smooth(). */
inline double timeOf(double size, int steps)
{
  const double root = size / (2.0 * std::numbers::pi);
  return (std::exp2(1.0 / steps) - 1.0) * root * root;
}

/** Smooths a mesh in memory. */
inline Solved smoothed(
  const StreamMesh& mesh, const Smoothing& options, std::int64_t blockCells = 1000)
{
  const MemoryMesh stored(mesh, blockCells);
  const std::unique_ptr<Solution> solution = smooth(stored, options, options);
  return { valuesOf(*solution), solution->report() };
}

/** The length of the diagonal of the bounds. */
inline double diagonalOf(const Eigen::MatrixXd& points)
{
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

} // namespace smg::testing
