// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/VertexNormals.h"

#include "IO/External/PagedArray.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Vector.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace smg
{
namespace
{

/** Sums the normals at the vertices that are not final. */
class OpenSums
{
public:
  OpenSums(const StreamInfo& info, const std::filesystem::path& scratch, std::int64_t memory)
    : Flags(findColumn(info.cellColumns, { CellFlagsName, ScalarType::UInt8, 1 }))
    , Shapes(scratch, memory / 2)
    , Sums(scratch, memory / 2)
  {
  }

  void take(const MeshBlock& block)
  {
    this->Shapes.take(block);
    for (std::size_t cell = 0; cell < block.corners.size() / 3; ++cell)
    {
      if (this->Flags < 0 || block.cellColumns[this->Flags].as<std::uint8_t>()[cell] == 0)
      {
        this->addCell(block, cell);
      }
    }
    this->Shapes.release(block);
    this->Vertices = block.firstVertex + block.vertices();
  }

  std::int64_t vertices() const { return this->Vertices; }

  /** Returns the normals of the vertices [first, end) and releases them. */
  void give(std::int64_t first, std::int64_t end, std::vector<float>& normals)
  {
    normals.clear();
    for (std::int64_t v = first; v < end; ++v)
    {
      const std::array<double, 4> sum = this->Sums.get(v);
      const std::array<float, 3> normal = unitNormal(std::span(sum).first<3>());
      normals.insert(normals.end(), normal.begin(), normal.end());
    }
    this->Sums.discardBelow(end);
  }

private:
  void addCell(const MeshBlock& block, std::size_t cell)
  {
    const TriangleShape shape = this->Shapes.shape(block, cell);
    for (std::size_t k = 0; k < 3; ++k)
    {
      addNormal(shape, k, std::span(this->Sums.at(block.corners[3 * cell + k])).first<3>());
    }
  }

  int Flags;
  CellNormals Shapes;
  PagedArray<std::array<double, 4>> Sums; ///< three numbers per vertex, by stream index
  std::int64_t Vertices = 0;              ///< so far
};

constexpr std::int64_t BytesPerVertex = 3 * sizeof(float);

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

TriangleShape shapeOf(const TriangleView& triangles, std::size_t cell)
{
  const auto point = [&](std::size_t k)
  {
    const auto vertex = static_cast<std::size_t>(triangles.corners[3 * cell + k]);
    return triangles.positions.subspan(3 * vertex).first<3>();
  };
  return shapeOfTriangle(point(0), point(1), point(2));
}

} // namespace

VertexNormals::VertexNormals(MeshSource& mesh, const NormalsOptions& options)
{
  const StreamInfo& info = mesh.info();
  if (info.cellType != CellType::Triangle)
  {
    throw Error("Normals are those of triangles, but the mesh has tetrahedra: leave them out.");
  }
  const ScratchFolder scratch(options.scratch);
  this->File.create(scratch.path());
  OpenSums sums(info, scratch.path(), options.memory);
  Progress reported(options.progress);
  std::vector<float> normals;
  const auto write = [&](std::int64_t end)
  {
    sums.give(this->Vertices, end, normals);
    this->File.append(std::as_bytes(std::span(normals)));
    this->Vertices = end;
  };
  for (MeshBlock block; mesh.next(block);)
  {
    sums.take(block);
    write(std::max(this->Vertices, block.finalized));
    if (info.cells > 0)
    {
      reported.update(static_cast<double>(block.firstCell) / static_cast<double>(info.cells));
    }
  }
  write(sums.vertices());
  reported.update(1.0);
}

void VertexNormals::read(std::int64_t first, std::int64_t count, std::span<float> normals) const
{
  assert(first >= 0 && first + count <= this->Vertices);
  this->File.read(first * BytesPerVertex,
    std::as_writable_bytes(normals.first(static_cast<std::size_t>(3 * count))));
}

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

std::array<float, 3> unitNormal(std::span<const double, 3> sum)
{
  const double size = std::hypot(sum[0], sum[1], sum[2]);
  std::array<float, 3> normal{};
  for (std::size_t axis = 0; axis < 3 && size > 0.0; ++axis)
  {
    normal[axis] = static_cast<float>(sum[axis] / size);
  }
  return normal;
}

std::vector<double> normalSums(const TriangleView& triangles)
{
  std::vector<double> sums(triangles.positions.size());
  for (std::size_t cell = 0; cell < triangles.corners.size() / 3; ++cell)
  {
    if (!triangles.flags.empty() && triangles.flags[cell] != 0)
    {
      continue;
    }
    const TriangleShape shape = shapeOf(triangles, cell);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto vertex = static_cast<std::size_t>(triangles.corners[3 * cell + k]);
      addNormal(shape, k, std::span(sums).subspan(3 * vertex).first<3>());
    }
  }
  return sums;
}

std::vector<float> unitNormals(std::span<const double> sums)
{
  std::vector<float> normals;
  normals.reserve(sums.size());
  for (std::size_t k = 0; k < sums.size(); k += 3)
  {
    const std::array<float, 3> normal = unitNormal(sums.subspan(k).first<3>());
    normals.insert(normals.end(), normal.begin(), normal.end());
  }
  return normals;
}

std::vector<float> normalsOf(const TriangleView& triangles)
{
  std::vector<float> normals;
  normals.reserve(triangles.corners.size());
  for (std::size_t cell = 0; cell < triangles.corners.size() / 3; ++cell)
  {
    for (const double number : shapeOf(triangles, cell).normal)
    {
      normals.push_back(static_cast<float>(number));
    }
  }
  return normals;
}

} // namespace smg
