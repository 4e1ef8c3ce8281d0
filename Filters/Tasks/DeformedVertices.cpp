// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/DeformedVertices.h"

#include "IO/Results/MovedPoints.h"

#include <algorithm>
#include <vector>

namespace smg
{

void DeformedVertices::addNormals(
  std::unique_ptr<MeshSource> mesh, const NormalsOptions& options, Report* report)
{
  MovedPoints moved(std::move(mesh), *this->Positions, report, options);
  this->Normals.emplace(moved, options);
}

void DeformedVertices::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  if (!this->Normals)
  {
    this->Positions->read(first, count, values);
    return;
  }
  std::vector<double> positions(3 * count);
  std::vector<float> normals(3 * count);
  this->Positions->read(first, count, positions);
  this->Normals->read(first, count, normals);
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::copy_n(positions.begin() + 3 * i, 3, values.begin() + WithNormals * i);
    std::copy_n(normals.begin() + 3 * i, 3, values.begin() + WithNormals * i + 3);
  }
}

} // namespace smg
