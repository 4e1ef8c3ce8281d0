// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/MeshMeasures.h"

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Fairing/ForCells.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smg
{

void MeshMeasures::add(const MeshBlock& block)
{
  this->Points.release(this->Finalized);
  if (this->Type == CellType::Triangle)
  {
    this->Parts.release(this->Finalized);
    this->Parts.extend(block.firstVertex + block.vertices());
  }
  this->Finalized = block.finalized;
  if (block.vertices() > 0)
  {
    this->Points.extendRaw(block.firstVertex + block.vertices());
    std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
    if (block.firstVertex == 0)
    {
      std::copy_n(block.positions.begin(), 3, this->Origin.begin());
    }
  }
  for (std::size_t k = 0; k < block.positions.size(); ++k)
  {
    this->Low[k % 3] = std::min(this->Low[k % 3], block.positions[k]);
    this->High[k % 3] = std::max(this->High[k % 3], block.positions[k]);
  }
  forCells(this->Type, block, [this](const std::int64_t* corners) { this->addCell(corners); });
}

void MeshMeasures::addCell(const std::int64_t* corners)
{
  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    const int* ends = edgeCorners(this->Type, e);
    const Vector edge =
      difference(this->Points.at(corners[ends[0]]), this->Points.at(corners[ends[1]]));
    this->Lengths += std::sqrt(dot(edge, edge));
    ++this->Edges;
  }
  if (this->Type == CellType::Triangle)
  {
    const auto corner = [&](int k)
    { return difference(this->Points.at(corners[k]), this->Origin.data()); };
    this->Parts.join(corners, 3);
    const auto label = static_cast<std::size_t>(this->Parts.label(corners[0]));
    if (label >= this->Volumes.size())
    {
      this->Volumes.resize(label + 1);
      this->OfVolumes.resize(static_cast<std::int64_t>(this->Volumes.capacity() * sizeof(double)));
    }
    this->Volumes[label] += dot(corner(0), cross(corner(1), corner(2)));
  }
}

std::vector<double> MeshMeasures::bodyVolumes() const
{
  std::vector<double> volumes(this->Volumes.size());
  for (std::size_t label = 0; label < volumes.size(); ++label)
  {
    const auto root = static_cast<std::size_t>(this->Bodies.root(static_cast<std::int32_t>(label)));
    volumes[root] += this->Volumes[label] / 6.0;
  }
  return volumes;
}

double MeshMeasures::volume() const
{
  const std::vector<double> volumes = this->bodyVolumes();
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

double MeshMeasures::turnedVolume() const
{
  const std::vector<double> volumes = this->bodyVolumes();
  return std::accumulate(volumes.begin(), volumes.end(), 0.0,
    [](double sum, double volume) { return sum + std::max(0.0, -volume); });
}

double MeshMeasures::diagonal() const
{
  return this->High[0] < this->Low[0]
           ? 0.0
           : std::hypot(this->High[0] - this->Low[0], this->High[1] - this->Low[1],
               this->High[2] - this->Low[2]);
}

double MeshMeasures::meanEdge() const
{
  return this->Edges == 0 ? 0.0 : this->Lengths / static_cast<double>(this->Edges);
}

} // namespace smg
