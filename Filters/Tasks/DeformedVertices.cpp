// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/DeformedVertices.h"

#include "IO/Results/MovedPoints.h"

#include <algorithm>
#include <vector>

namespace smg
{

namespace
{

VertexNormals normalsOf(std::unique_ptr<MeshSource> mesh, Solution& positions,
  const NormalsOptions& options, Report* report)
{
  MovedPoints moved(std::move(mesh), positions, report, options);
  return VertexNormals(moved, options);
}

} // namespace

DeformedVertices::DeformedVertices(std::unique_ptr<Solution> positions,
  std::unique_ptr<MeshSource> mesh, const NormalsOptions& options, Report* report)
  : Positions(std::move(positions))
  , Normals(normalsOf(std::move(mesh), *this->Positions, options, report))
{
}

void DeformedVertices::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  std::vector<double> positions(3 * count);
  std::vector<float> normals(3 * count);
  this->Positions->read(first, count, positions);
  this->Normals.read(first, count, normals);
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::copy_n(positions.begin() + 3 * i, 3, values.begin() + WithNormals * i);
    std::copy_n(normals.begin() + 3 * i, 3, values.begin() + WithNormals * i + 3);
  }
}

} // namespace smg
