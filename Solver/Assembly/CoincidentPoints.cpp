// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CoincidentPoints.h"

#include "Solver/Files/Checksum.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

// Whether the points of two vertices are equal is judged by 64 bits of a hash: with 65,536
// remembered places, two different ones have the same hash with a probability of 1e-10.

namespace smg
{
namespace
{

std::uint64_t hashOf(const double* point)
{
  // + 0.0 makes -0.0 the same place as 0.0.
  const std::array<double, 3> place{ point[0] + 0.0, point[1] + 0.0, point[2] + 0.0 };
  return checksum(std::as_bytes(std::span(place)));
}

/** Whether a place is in the sample that has one of 2^shift. */
bool isChosen(std::uint64_t place, int shift)
{
  return (place & ((std::uint64_t(1) << shift) - 1)) == 0;
}

} // namespace

void CoincidentPoints::add(const double* point, std::int32_t label)
{
  const std::uint64_t place = hashOf(point);
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
void CoincidentPoints::halve()
{
  constexpr int MaxShift = 63;
  while (this->Sample.size() > this->Most && this->Shift < MaxShift)
  {
    ++this->Shift;
    std::erase_if(
      this->Sample, [this](const Vertex& vertex) { return !isChosen(vertex.place, this->Shift); });
  }
  // Then the first ones stand for them.
  this->Sample.resize(std::min(this->Sample.size(), this->Most));
}

auto CoincidentPoints::count(const Components& components) const -> Count
{
  std::vector<Vertex> sorted = this->Sample;
  for (Vertex& vertex : sorted)
  {
    vertex.label = components.root(vertex.label);
  }
  std::ranges::sort(sorted, {}, [](const Vertex& v) { return std::tuple(v.place, v.label); });
  Count count{ 0, this->Shift == 0 };
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end)
  {
    while (end < sorted.size() && sorted[end].place == sorted[begin].place)
    {
      ++end;
    }
    count.places += sorted[begin].label != sorted[end - 1].label ? 1 : 0;
  }
  count.places <<= this->Shift;
  return count;
}

} // namespace smg
