// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/PointNormals.h"

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Fairing/ForCells.h"

#include <cmath>

namespace smg
{

void PointNormals::add(const MeshBlock& block, std::span<const std::uint8_t> held)
{
  this->Points.startBlock(block);
  this->Sums.extend(block.firstVertex + block.vertices());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    this->Sums.at(block.firstVertex + static_cast<std::int64_t>(i))[3] = held[i];
  }
  forCells(
    CellType::Triangle, block, [this](const std::int64_t* corners) { this->addCell(corners); });
  this->write(block.finalized);
}

void PointNormals::addCell(const std::int64_t* corners)
{
  Vector edge[3]; // opposite to each corner
  for (int k = 0; k < 3; ++k)
  {
    edge[k] =
      difference(this->Points.at(corners[(k + 2) % 3]), this->Points.at(corners[(k + 1) % 3]));
  }
  const Vector area = cross(edge[0], edge[1]);
  const double size = std::sqrt(dot(area, area));
  if (!(size > 0.0))
  {
    return;
  }
  for (int k = 0; k < 3; ++k)
  {
    const double angle = std::atan2(size, -dot(edge[(k + 1) % 3], edge[(k + 2) % 3]));
    double* sum = this->Sums.at(corners[k]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum[axis] += angle * area[axis] / size;
    }
  }
}

void PointNormals::write(std::int64_t finalized)
{
  this->Units.clear();
  for (std::int64_t v = this->Normals.vertices(); v < finalized; ++v)
  {
    const double* sum = this->Sums.at(v);
    const double size = sum[3] != 0.0 ? 0.0 : std::hypot(sum[0], sum[1], sum[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Units.push_back(size > 0.0 ? sum[axis] / size : 0.0);
    }
  }
  if (!this->Units.empty())
  {
    this->Normals.append(this->Units);
    this->Sums.release(this->Normals.vertices());
  }
}

void PointNormals::finish()
{
  this->write(this->Sums.end());
}

} // namespace smg
