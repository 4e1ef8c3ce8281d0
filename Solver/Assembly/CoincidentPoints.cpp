// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CoincidentPoints.h"

#include "Solver/Files/Checksum.h"

// Whether the points of two vertices are equal is judged by 64 bits of a hash: with 65,536
// remembered places, two different ones have the same hash with a probability of 1e-10.

namespace smg
{
namespace
{

/** Whether a place is in the sample that has one of 2^shift. */
bool isChosen(std::uint64_t place, int shift)
{
  return (place & ((std::uint64_t(1) << shift) - 1)) == 0;
}

} // namespace

std::uint64_t PlaceSample::placeOf(const double* point)
{
  // + 0.0 makes -0.0 the same place as 0.0.
  const std::array<double, 3> place{ point[0] + 0.0, point[1] + 0.0, point[2] + 0.0 };
  return checksum(std::as_bytes(std::span(place)));
}

std::uint64_t PlaceSample::placeOf(std::array<std::uint64_t, 3> corners)
{
  std::ranges::sort(corners);
  return checksum(std::as_bytes(std::span(corners)));
}

void PlaceSample::add(std::uint64_t place, std::int32_t label)
{
  if (!isChosen(place, this->Shift))
  {
    return;
  }
  this->Sample.push_back({ place, label });
  if (this->Sample.size() > this->Most)
  {
    this->halve();
  }
}

/** Until the sample has room: all vertices of a mesh may lie at one place. */
void PlaceSample::halve()
{
  constexpr int MaxShift = 63;
  while (this->Sample.size() > this->Most && this->Shift < MaxShift)
  {
    ++this->Shift;
    std::erase_if(
      this->Sample, [this](const Entry& entry) { return !isChosen(entry.place, this->Shift); });
  }
  // Then the first ones stand for them.
  this->Sample.resize(std::min(this->Sample.size(), this->Most));
}

auto CoincidentPoints::count(const Components& components) const -> Count
{
  std::vector<PlaceSample::Entry> entries = this->Places.entries();
  for (PlaceSample::Entry& entry : entries)
  {
    entry.label = components.root(entry.label);
  }
  Count count{ 0, this->Places.shift() == 0 };
  PlaceSample::forPlaces(entries, [&count](std::span<const PlaceSample::Entry> place)
    { count.places += place.front().label != place.back().label ? 1 : 0; });
  count.places <<= this->Places.shift();
  return count;
}

} // namespace smg
