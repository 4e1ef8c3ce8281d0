// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SurfacePart.h"

#include <algorithm>
#include <limits>

namespace smg
{

namespace
{

constexpr std::uint32_t Unused = std::numeric_limits<std::uint32_t>::max();

/** Of each vertex: 0 if a triangle uses it, else Unused. */
std::vector<std::uint32_t> usedBy(const std::vector<std::uint32_t>& corners, std::size_t vertices)
{
  std::vector<std::uint32_t> used(vertices, Unused);
  for (const std::uint32_t corner : corners)
  {
    used[corner] = 0;
  }
  return used;
}

} // namespace

void SurfacePart::addVertex(const SurfacePart& from, std::size_t vertex)
{
  this->ids.push_back(from.ids[vertex]);
  const auto point = from.points.begin() + 3 * static_cast<std::ptrdiff_t>(vertex);
  this->points.insert(this->points.end(), point, point + 3);
  const std::size_t stride = from.rowBytes();
  const auto row = from.rows.begin() + static_cast<std::ptrdiff_t>(vertex * stride);
  this->rows.insert(this->rows.end(), row, row + static_cast<std::ptrdiff_t>(stride));
}

void SurfacePart::copyVertex(
  std::size_t vertex, std::vector<double>& positions, std::span<Column> columns) const
{
  const auto point = this->points.begin() + 3 * static_cast<std::ptrdiff_t>(vertex);
  positions.insert(positions.end(), point, point + 3);
  const std::byte* from = this->rows.data() + vertex * this->rowBytes();
  for (Column& column : columns)
  {
    const std::size_t bytes = column.spec.tupleBytes();
    column.bytes.insert(column.bytes.end(), from, from + bytes);
    from += bytes;
  }
}

SurfacePart SurfacePart::extract(const std::vector<std::uint32_t>& some) const
{
  std::vector<std::uint32_t> place = usedBy(some, this->vertices());
  SurfacePart part;
  part.origin = this->origin;
  for (std::size_t v = 0; v < place.size(); ++v)
  {
    if (place[v] != Unused)
    {
      place[v] = static_cast<std::uint32_t>(part.vertices());
      part.addVertex(*this, v);
    }
  }
  part.corners.reserve(some.size());
  for (const std::uint32_t corner : some)
  {
    part.corners.push_back(place[corner]);
  }
  return part;
}

void SurfacePart::dropUnusedVertices()
{
  std::vector<std::uint32_t> place = usedBy(this->corners, this->vertices());
  const std::size_t stride = this->rowBytes();
  const bool hasQuadrics = !this->quadrics.empty();
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < place.size(); ++v)
  {
    if (place[v] == Unused)
    {
      continue;
    }
    place[v] = kept;
    this->ids[kept] = this->ids[v];
    std::copy_n(this->points.begin() + 3 * static_cast<std::ptrdiff_t>(v), 3,
      this->points.begin() + 3 * static_cast<std::ptrdiff_t>(kept));
    if (hasQuadrics)
    {
      this->quadrics[kept] = this->quadrics[v];
      this->lacksBoundary[kept] = this->lacksBoundary[v];
    }
    std::copy_n(this->rows.begin() + static_cast<std::ptrdiff_t>(v * stride), stride,
      this->rows.begin() + static_cast<std::ptrdiff_t>(kept * stride));
    ++kept;
  }
  this->ids.resize(kept);
  this->points.resize(3 * std::size_t(kept));
  this->quadrics.resize(hasQuadrics ? kept : 0);
  this->lacksBoundary.resize(hasQuadrics ? kept : 0);
  this->rows.resize(kept * stride);
  for (std::uint32_t& corner : this->corners)
  {
    corner = place[corner];
  }
}

} // namespace smg
