// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/MovedPoints.h"

#include "IO/Mesh/SinglePrecision.h"

#include <algorithm>
#include <utility>

namespace smg
{

MovedPoints::MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions, Report* report,
  const NormalsOptions& options)
  : Source(std::move(source))
  , Info(this->Source->info())
  , Positions(positions)
  , Judged(report)
{
  this->Info.bounds = {};
  if (report)
  {
    this->Inverted.emplace(this->Info, options.scratch, options.memory / 2);
  }
}

bool MovedPoints::next(MeshBlock& block)
{
  if (!this->Source->next(block))
  {
    if (this->Inverted)
    {
      this->Inverted->finish(*this->Judged);
      this->Inverted.reset();
    }
    return false;
  }
  if (this->Inverted)
  {
    this->Rest = block.positions;
  }
  if (block.vertices() > 0)
  {
    this->Positions.read(block.firstVertex, block.vertices(), block.positions);
  }
  for (std::int64_t v = 0; v < block.vertices() && !this->Info.doublePositions; ++v)
  {
    const std::span<double, 3> position(block.positions.data() + 3 * v, 3);
    std::ranges::copy(
      singlePrecision(position, block.firstVertex + v, "The moved mesh"), position.begin());
  }
  if (this->Inverted)
  {
    this->Inverted->add(this->Rest, block);
  }
  return true;
}

} // namespace smg
