// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/PointTree.h"

#include <algorithm>

// A k-d tree in an array: the median of a range is in its middle and splits it along the longest
// side of its bounds; smaller points are on its left. So a tree needs no pointers, and one byte for
// the axis. Building takes about n log n steps. Of equally near points the one with the lowest
// index is found, whatever the shape of the tree.

namespace smg
{
namespace
{

/** Ranges of at most this many points are searched linearly. */
constexpr std::size_t LeafPoints = 8;

constexpr std::size_t middleOf(std::size_t begin, std::size_t end)
{
  return begin + (end - begin) / 2;
}

} // namespace

PointTree::PointTree(std::span<const double> positions)
  : Points(positions.size() / 3)
  , Axes(positions.size() / 3, 0)
{
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    std::copy_n(positions.data() + 3 * i, 3, this->Points[i].position.data());
    this->Points[i].number = static_cast<std::int64_t>(i);
  }
  this->build(0, this->Points.size());
}

/** Sorts the points [begin, end) into a tree. */
void PointTree::build(std::size_t begin, std::size_t end)
{
  if (end - begin <= LeafPoints)
  {
    return;
  }
  // The longest side keeps the boxes of subtrees compact.
  std::array<double, 3> low = this->Points[begin].position, high = low;
  for (std::size_t i = begin; i < end; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], this->Points[i].position[k]);
      high[k] = std::max(high[k], this->Points[i].position[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
  {
    axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
  }
  const std::size_t middle = middleOf(begin, end);
  const auto first = this->Points.begin();
  std::nth_element(first + begin, first + middle, first + end,
    [axis](const Point& a, const Point& b) { return a.position[axis] < b.position[axis]; });
  this->Axes[middle] = static_cast<std::uint8_t>(axis);
  this->build(begin, middle);
  this->build(middle + 1, end);
}

PointTree::Nearest PointTree::nearest(std::span<const double, 3> place, double limit) const
{
  Nearest found;
  found.squaredDistance = limit;
  this->search(0, this->Points.size(), place, found);
  return found;
}

/** Searches the side of the place first, and the other side only if it may have a point as near as
 * the best one. */
void PointTree::search(
  std::size_t begin, std::size_t end, std::span<const double, 3> place, Nearest& found) const
{
  const auto compare = [&found, place](const Point& point)
  {
    ++found.compared;
    const double squared = squaredDistance(point.position, place);
    const bool isFirst = found.point < 0 || point.number < found.point;
    if (squared < found.squaredDistance || (squared == found.squaredDistance && isFirst))
    {
      found.point = point.number;
      found.squaredDistance = squared;
    }
  };
  if (end - begin <= LeafPoints)
  {
    std::for_each(this->Points.begin() + begin, this->Points.begin() + end, compare);
    return;
  }
  const std::size_t middle = middleOf(begin, end);
  const std::size_t axis = this->Axes[middle];
  const double beyond = place[axis] - this->Points[middle].position[axis];
  compare(this->Points[middle]);
  const bool isLeft = beyond < 0.0;
  this->search(isLeft ? begin : middle + 1, isLeft ? middle : end, place, found);
  // Not skipped at equality, since there may be an equally near point with a lower index.
  if (beyond * beyond <= found.squaredDistance)
  {
    this->search(isLeft ? middle + 1 : begin, isLeft ? end : middle, place, found);
  }
}

} // namespace smg
