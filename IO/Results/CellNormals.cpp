// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/CellNormals.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

double length(const Vector& a)
{
  return std::sqrt(dot(a, a));
}

/** The unit vector from a to b; zero if they are equal. */
Vector direction(std::span<const double, 3> a, std::span<const double, 3> b)
{
  Vector edge = difference(b.data(), a.data());
  // Squares of the smallest and the largest numbers underflow and overflow.
  const double scale = std::max({ std::abs(edge[0]), std::abs(edge[1]), std::abs(edge[2]) });
  if (!(scale > 0.0))
  {
    return {};
  }
  edge = { edge[0] / scale, edge[1] / scale, edge[2] / scale };
  const double size = length(edge);
  return { edge[0] / size, edge[1] / size, edge[2] / size };
}

} // namespace

TriangleShape shapeOfTriangle(
  std::span<const double, 3> a, std::span<const double, 3> b, std::span<const double, 3> c)
{
  const Vector ab = direction(a, b);
  const Vector bc = direction(b, c);
  const Vector ca = direction(c, a);
  const Vector normal = cross(ca, ab);
  const double size = length(normal);
  if (!(size > 0.0) || ab == Vector{} || bc == Vector{})
  {
    return {};
  }
  TriangleShape shape;
  for (int axis = 0; axis < 3; ++axis)
  {
    shape.normal[axis] = normal[axis] / size;
  }
  const auto angle = [](const Vector& in, const Vector& out)
  { return std::atan2(length(cross(in, out)), -dot(in, out)); };
  shape.angles = { angle(ca, ab), angle(ab, bc), angle(bc, ca) };
  return shape;
}

CellNormals::CellNormals(const std::filesystem::path& scratch, std::int64_t memory)
  : Scratch(scratch)
  , Positions(this->Scratch.path(), memory)
{
}

void CellNormals::take(const MeshBlock& block)
{
  for (std::int64_t v = 0; v < block.vertices(); ++v)
  {
    std::copy_n(&block.positions[static_cast<std::size_t>(3 * v)], 3,
      this->Positions.at(block.firstVertex + v).begin());
  }
}

TriangleShape CellNormals::shape(const MeshBlock& block, std::size_t cell)
{
  std::array<std::array<double, 4>, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
  {
    corners[k] = this->Positions.get(block.corners[3 * cell + k]);
  }
  const auto point = [&corners](std::size_t k) { return std::span(corners[k]).first<3>(); };
  return shapeOfTriangle(point(0), point(1), point(2));
}

void CellNormals::release(const MeshBlock& block)
{
  this->Positions.discardBelow(block.finalized);
}

void CellNormals::read(const MeshBlock& block, std::span<float> normals)
{
  this->take(block);
  for (std::size_t cell = 0; cell < block.corners.size() / 3; ++cell)
  {
    const TriangleShape shape = this->shape(block, cell);
    std::copy_n(shape.normal.begin(), 3, &normals[3 * cell]);
  }
  this->release(block);
}

} // namespace smg
