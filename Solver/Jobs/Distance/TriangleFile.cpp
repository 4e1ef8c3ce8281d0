// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/TriangleFile.h"

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/DistanceRun.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstddef>

// Triangles that straight lines may end at: walls, and the facets of sources. Their number is not
// known beforehand, so they are collected on a scratch file, and taken in parts that fit into the
// memory limit, as a rule all at once. Of equally near triangles the first one counts, in a part
// and among parts: so the answer is the same for any number of parts.

namespace smg
{

void TriangleWriter::add(const NumberedTriangle& triangle)
{
  this->Block.push_back(triangle);
  if (std::ssize(this->Block) == BlockTriangles)
  {
    this->writeBlock();
  }
}

void TriangleWriter::finish()
{
  if (!this->Block.empty())
  {
    this->writeBlock();
  }
}

void TriangleWriter::writeBlock()
{
  this->To.write(this->Count / BlockTriangles, std::as_bytes(std::span(this->Block)));
  this->Count += std::ssize(this->Block);
  this->Block.clear();
}

std::int64_t TrianglePart::lengthFor(std::int64_t triangles, std::int64_t other, const Pool& pool)
{
  constexpr std::int64_t TriangleBytes =
    std::int64_t(sizeof(NumberedTriangle)) + TriangleTree::BytesPerTriangle;
  constexpr std::int64_t Block = TriangleWriter::BlockTriangles;
  // Something for small allocations.
  const std::int64_t rest = other + (1 << 16);
  const std::int64_t room = (pool.limit() - pool.used() - rest) / TriangleBytes;
  if (room < std::min(triangles, Block))
  {
    throw MemoryLimitError(pool.used() + rest + std::min(triangles, Block) * TriangleBytes,
      pool.limit(), DistanceMemory);
  }
  return room < triangles ? room / Block * Block : triangles;
}

TrianglePart::TrianglePart(BlockStore& file, std::int64_t first, std::int64_t count, Pool& pool)
  : PointMemory(pool, static_cast<std::size_t>(count) * sizeof(TrianglePoints))
  , NumberMemory(pool, static_cast<std::size_t>(count) * sizeof(std::array<std::int64_t, 3>))
  , Points(this->PointMemory.values<TrianglePoints>(count))
  , Numbers(this->NumberMemory.values<std::array<std::int64_t, 3>>(count))
{
  this->read(file, first);
  this->Tree.emplace(pool, this->Points);
}

std::int64_t TrianglePart::numberNearest(std::int64_t triangle, const double* point) const
{
  const auto squareTo = [point](const double* corner)
  {
    const Vector way = difference(point, corner);
    return dot(way, way);
  };
  const auto& corners = this->Points[static_cast<std::size_t>(triangle)].point;
  const auto nearest = std::ranges::min_element(corners, {}, squareTo) - corners;
  return this->Numbers[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(nearest)];
}

void TrianglePart::read(BlockStore& file, std::int64_t first)
{
  std::vector<NumberedTriangle> block;
  std::size_t done = 0;
  for (std::int64_t b = first / TriangleWriter::BlockTriangles; done < this->Points.size(); ++b)
  {
    block.resize(file.bytes(b) / sizeof(NumberedTriangle));
    file.read(b, std::as_writable_bytes(std::span(block)));
    for (const NumberedTriangle& triangle : block)
    {
      this->Points[done] = triangle.points;
      this->Numbers[done++] = triangle.numbers;
    }
  }
}

} // namespace smg
