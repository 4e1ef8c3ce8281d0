// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/StreamOrderMeasure.h"

#include <algorithm>

namespace smg::benchmark
{

void StreamOrderMeasure::append(std::span<const std::int64_t> corners)
{
  const auto [smallest, largest] = std::ranges::minmax(corners);
  const auto known = static_cast<std::int64_t>(this->LastCell.size());
  const std::int64_t vertices = std::max(known, largest + 1);
  const std::int64_t cell = this->cells();
  this->Span = std::max(this->Span, largest - smallest);
  this->LargestNeighbour.resize(static_cast<std::size_t>(vertices));
  this->LastCell.resize(static_cast<std::size_t>(vertices));
  this->Introduced.push_back(static_cast<std::uint8_t>(vertices - known));
  for (const std::int64_t corner : corners)
  {
    std::int64_t& neighbour = this->LargestNeighbour[static_cast<std::size_t>(corner)];
    neighbour = std::max(neighbour, largest);
    this->LastCell[static_cast<std::size_t>(corner)] = cell;
  }
}

std::int64_t StreamOrderMeasure::width() const
{
  std::vector<std::uint8_t> finalized(this->Introduced.size());
  for (const std::int64_t cell : this->LastCell)
  {
    ++finalized[static_cast<std::size_t>(cell)];
  }
  std::int64_t alive = 0, most = 0;
  for (std::size_t cell = 0; cell < finalized.size(); ++cell)
  {
    alive += this->Introduced[cell];
    most = std::max(most, alive);
    alive -= finalized[cell];
  }
  return most;
}

double StreamOrderMeasure::meanWindow() const
{
  std::int64_t reach = 0;
  double sum = 0;
  for (std::size_t i = 0; i < this->LargestNeighbour.size(); ++i)
  {
    reach = std::max(reach, this->LargestNeighbour[i]);
    sum += static_cast<double>(reach - static_cast<std::int64_t>(i));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, this->LargestNeighbour.size()));
}

} // namespace smg::benchmark
