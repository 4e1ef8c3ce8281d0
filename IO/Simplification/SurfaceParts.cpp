// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SurfaceParts.h"

#include "IO/Mesh/RowBytes.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace smg
{
SurfaceParts::SurfaceParts(
  MeshSource& source, Pool& pool, std::size_t triangles, std::function<void(double)> progress)
  : Source(source)
  , Least(triangles)
  , Progress(std::move(progress))
  , RowBytes(static_cast<std::size_t>(rowBytes(source.info().vertexColumns)))
  , Points(pool, 3)
  , Rows(pool, static_cast<int>(this->RowBytes))
{
}

bool SurfaceParts::next(StreamPart& part)
{
  this->Corners.clear();
  this->Points.release(this->Final);
  if (this->RowBytes > 0)
  {
    this->Rows.release(this->Final);
  }
  this->Released = this->Final;
  part.begin = this->Vertices;
  while (this->Corners.size() < 3 * this->Least && !this->IsAtEnd)
  {
    if (this->Source.next(this->Block))
    {
      this->add(this->Block);
    }
    else
    {
      this->IsAtEnd = true;
      this->Final = this->Vertices;
    }
  }
  part.end = this->Final;
  part.endVertex = this->Vertices;
  this->localise(part.surface);
  return !this->Corners.empty();
}

void SurfaceParts::add(const MeshBlock& block)
{
  if (this->Vertices == 0 && !block.positions.empty())
  {
    std::copy_n(block.positions.begin(), 3, this->Origin.begin());
  }
  std::ranges::copy(block.positions, this->Points.append(block.vertices()).begin());
  if (this->RowBytes > 0)
  {
    std::byte* rows = this->Rows.append(block.vertices()).data();
    for (const Column& column : block.vertexColumns)
    {
      const std::size_t bytes = column.spec.tupleBytes();
      for (std::size_t v = 0; v * bytes < column.bytes.size(); ++v)
      {
        std::memcpy(rows + v * this->RowBytes, column.bytes.data() + v * bytes, bytes);
      }
      rows += bytes;
    }
  }
  const Column* flags = block.flags();
  for (std::size_t i = 0; i + 2 < block.corners.size(); i += 3)
  {
    const std::int64_t* c = block.corners.data() + i;
    const bool isRepeated = flags && (flags->as<std::uint8_t>()[i / 3] & DuplicateCell) != 0;
    if (!isRepeated && c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
    {
      this->Corners.insert(this->Corners.end(), c, c + 3);
    }
  }
  this->Vertices += block.vertices();
  this->Cells += static_cast<std::int64_t>(block.corners.size() / 3);
  this->Final = std::max(this->Final, block.finalized);
  if (this->Progress && this->Source.info().vertices > 0)
  {
    this->Progress(
      static_cast<double>(this->Vertices) / static_cast<double>(this->Source.info().vertices));
  }
}

/** Makes the surface of the triangles, with its vertices in the order of the stream. */
void SurfaceParts::localise(SurfacePart& surface)
{
  constexpr std::uint32_t Unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(
    static_cast<std::size_t>(this->Vertices - this->Released), Unused);
  const auto placeOf = [&](std::int64_t id) -> std::uint32_t&
  { return place[static_cast<std::size_t>(id - this->Released)]; };
  std::size_t used = 0;
  for (const std::int64_t corner : this->Corners)
  {
    used += placeOf(corner) == Unused ? 1 : 0;
    placeOf(corner) = 0;
  }
  surface = {};
  surface.ids.reserve(used);
  surface.points.reserve(3 * used);
  surface.rows.reserve(used * this->RowBytes);
  surface.origin = this->Origin;
  for (std::int64_t id = this->Released; id < this->Vertices; ++id)
  {
    if (placeOf(id) == Unused)
    {
      continue;
    }
    placeOf(id) = static_cast<std::uint32_t>(surface.ids.size());
    surface.ids.push_back(id);
    const double* point = this->Points.at(id);
    surface.points.insert(surface.points.end(), point, point + 3);
    if (this->RowBytes > 0)
    {
      const std::byte* row = this->Rows.at(id);
      surface.rows.insert(surface.rows.end(), row, row + this->RowBytes);
    }
  }
  surface.corners.reserve(this->Corners.size());
  for (const std::int64_t corner : this->Corners)
  {
    surface.corners.push_back(placeOf(corner));
  }
}

} // namespace smg
