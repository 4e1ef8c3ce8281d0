// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/DirectElements.h"
#include "Testing/Support/ElementProblem.h"

#include <cmath>
#include <string>
#include <vector>

namespace smg::testing
{

/** A wavy patch with open edges: a jittered grid, bent. */
inline StreamMesh patch(int nx = 16, int ny = 13)
{
  IndexedTestMesh mesh = shuffled(grid(nx, ny, 0.25));
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k + 2] = std::sin(0.5 * mesh.positions[k]) + 0.1 * mesh.positions[k + 1];
  }
  return toStream(mesh);
}

/** A solid with cells of different sizes. */
inline StreamMesh block(int nx = 7, int ny = 6, int nz = 8)
{
  IndexedTestMesh mesh = shuffled(tetBox(nx, ny, nz, 0.15));
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k] *= 1.0 + 0.1 * mesh.positions[k];
  }
  return toStream(mesh);
}

using Point = ElementProblem::Point;

/** A function of position and column, as a field of `columns` values. */
template <class F>
ElementProblem::Values columnsOf(int columns, F f)
{
  return [columns, f](const Point& p)
  {
    Eigen::VectorXd values(columns);
    for (int k = 0; k < columns; ++k)
    {
      values[k] = f(p, k);
    }
    return values;
  };
}

inline ElementProblem::Where below(int axis, double at)
{
  return [=](const Point& p) { return p[axis] < at; };
}
inline ElementProblem::Where above(int axis, double at)
{
  return [=](const Point& p) { return p[axis] > at; };
}

/** A full tensor that depends on the position. */
inline Eigen::Matrix3d someTensor(const Point& p)
{
  Eigen::Matrix3d k;
  k << 2, 0.5, 0.1, 0.5, 3 + std::sin(p[0]), -0.4, 0.1, -0.4, 1;
  return k;
}

} // namespace smg::testing
