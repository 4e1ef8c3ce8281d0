// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CoincidentPoints.h"

#include <algorithm>
#include <bit>
#include <tuple>

// Whether the points of two vertices are equal is judged by 64 bits of a hash: with 65,536
// remembered places, two different ones have the same hash with a probability of 1e-10.

namespace smg
{
namespace
{

/** The last step of SplitMix64 (Steele, Lea and Flood 2014): each bit depends on all bits. */
std::uint64_t mixed(std::uint64_t bits)
{
  bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ bits >> 27) * 0x94D049BB133111EBU;
  return bits ^ bits >> 31;
}

std::uint64_t hashOf(const double* point)
{
  constexpr std::uint64_t Increment = 0x9E3779B97F4A7C15U;
  std::uint64_t hash = 0;
  for (int d = 0; d < 3; ++d)
  {
    // + 0.0 makes -0.0 the same place as 0.0.
    hash = mixed(hash + Increment + std::bit_cast<std::uint64_t>(point[d] + 0.0));
  }
  return hash;
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
