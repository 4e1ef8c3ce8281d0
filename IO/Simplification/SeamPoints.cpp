// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SeamPoints.h"

#include "Solver/Files/Checksum.h"

#include <algorithm>
#include <array>
#include <span>

// Places are told apart by 64 bits of a hash; which of them are remembered depends neither on the
// order of the points nor on how they are divided into parts.

namespace smg
{

void SeamPoints::add(const double* point)
{
  // + 0.0 makes -0.0 the same place as 0.0.
  const std::array<double, 3> at{ point[0] + 0.0, point[1] + 0.0, point[2] + 0.0 };
  const std::uint64_t place = checksum(std::as_bytes(std::span(at)));
  if (this->isChosen(place))
  {
    this->Sample.push_back(place);
    this->thin();
  }
}

void SeamPoints::add(const SeamPoints& other)
{
  this->Shift = std::max(this->Shift, other.Shift);
  this->Sample.insert(this->Sample.end(), other.Sample.begin(), other.Sample.end());
  std::erase_if(this->Sample, [this](std::uint64_t place) { return !this->isChosen(place); });
  this->thin();
}

/** Until the sample has room: all points may lie at one place. */
void SeamPoints::thin()
{
  constexpr std::size_t Most = std::size_t(1) << 13;
  constexpr std::int64_t MaxShift = 62;
  while (this->Sample.size() > Most && this->Shift < MaxShift)
  {
    ++this->Shift;
    std::erase_if(this->Sample, [this](std::uint64_t place) { return !this->isChosen(place); });
  }
  this->Sample.resize(std::min(this->Sample.size(), Most));
}

std::int64_t SeamPoints::places() const
{
  std::vector<std::uint64_t> sorted = this->Sample;
  std::ranges::sort(sorted);
  std::int64_t places = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k)
  {
    // Each place once, at the second of its points.
    places += sorted[k] == sorted[k - 1] && (k == 1 || sorted[k] != sorted[k - 2]) ? 1 : 0;
  }
  return places << this->Shift;
}

} // namespace smg
