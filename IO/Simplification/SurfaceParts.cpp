// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SurfaceParts.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Assembly/Elements.h"
#include "Solver/Mesh/VisitCells.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

// Parts of a surface with their vertices, and the cutting of a stream into parts. Vertices that
// later cells may use stay in a window (OpenValues); a part gets copies of those that it uses, in
// the order of the stream, so it needs nothing else.

namespace smg
{

namespace
{

constexpr std::uint32_t Unused = std::numeric_limits<std::uint32_t>::max();

/** Sets 0 for each vertex that a triangle uses. */
void markUsed(
  const std::vector<std::uint32_t>& corners, std::vector<std::uint32_t>& used, const Poll& poll)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    poll.at(i);
    used[corners[i]] = 0;
  }
}

/** Appends a row of a table whose rows have so many values. */
template <class T>
void appendRow(std::vector<T>& to, const std::vector<T>& from, std::size_t row, std::size_t values)
{
  const T* const begin = from.data() + row * values;
  to.insert(to.end(), begin, begin + values);
}

/** Copies a row of such a table to the place of another one. */
template <class T>
void moveRow(std::vector<T>& table, std::size_t from, std::size_t to, std::size_t values)
{
  std::copy_n(table.data() + from * values, values, table.data() + to * values);
}

/** Appends the tuples of a row to columns. */
void appendTuples(const std::byte* row, std::span<Column> columns)
{
  for (Column& column : columns)
  {
    const std::size_t bytes = column.spec.tupleBytes();
    column.bytes.insert(column.bytes.end(), row, row + bytes);
    row += bytes;
  }
}

/** Whether triangles carry a column of cells. */
bool isCarried(const ColumnSpec& spec)
{
  // Facets of tetrahedra are not those of the triangles of their boundary.
  const bool isOfTetrahedra = spec == MeshGroups::columnSpec(GroupOf::Facets, 4);
  return spec.name != OriginalCellIdName && spec.name != CellFlagsName && !isOfTetrahedra;
}

/** See SurfacePart::edgeGroups. */
std::optional<std::size_t> edgeGroupsIn(const std::vector<ColumnSpec>& columns)
{
  std::size_t begin = 0;
  for (const ColumnSpec& spec : columns)
  {
    if (spec == MeshGroups::columnSpec(GroupOf::Facets, 3))
    {
      return begin;
    }
    begin += spec.tupleBytes();
  }
  return std::nullopt;
}

} // namespace

void SurfacePart::reserve(std::size_t triangles, const SurfacePart& like)
{
  const double share = static_cast<double>(like.vertices()) /
                       static_cast<double>(std::max<std::size_t>(1, like.triangles()));
  const auto vertices = static_cast<std::size_t>(share * static_cast<double>(triangles));
  this->ids.reserve(vertices);
  this->points.reserve(3 * vertices);
  this->quadrics.reserve(vertices);
  this->lacksBoundary.reserve(vertices);
  this->rows.reserve(vertices * like.rowBytes());
  this->corners.reserve(3 * triangles);
  this->cellRows.reserve(triangles * like.cellRowBytes());
}

void SurfacePart::addVertex(const SurfacePart& from, std::size_t vertex)
{
  this->ids.push_back(from.ids[vertex]);
  appendRow(this->points, from.points, vertex, 3);
  appendRow(this->rows, from.rows, vertex, from.rowBytes());
}

void SurfacePart::copyVertex(
  std::size_t vertex, std::vector<double>& positions, std::span<Column> columns) const
{
  appendRow(positions, this->points, vertex, 3);
  appendTuples(this->rows.data() + vertex * this->rowBytes(), columns);
}

void SurfacePart::copyTriangle(std::size_t triangle, std::span<Column> columns) const
{
  appendTuples(this->cellRows.data() + triangle * this->cellRowBytes(), columns);
}

void SurfacePart::moveTriangle(std::size_t from, std::size_t to)
{
  moveRow(this->corners, from, to, 3);
  if (!this->wedges.empty())
  {
    moveRow(this->wedges, from, to, 3);
  }
  moveRow(this->cellRows, from, to, this->cellRowBytes());
}

void SurfacePart::keepTriangles(std::size_t number)
{
  this->cellRows.resize(number * this->cellRowBytes());
  this->corners.resize(3 * number);
  this->wedges.resize(this->wedges.empty() ? 0 : 3 * number);
}

SurfacePart SurfacePart::extract(
  const std::vector<std::uint32_t>& triangles, const Poll& poll) const
{
  const std::size_t stride = this->cellRowBytes();
  std::vector<std::uint32_t> some;
  SurfacePart part;
  for (std::size_t k = 0; k < triangles.size(); ++k)
  {
    poll.at(k);
    appendRow(some, this->corners, triangles[k], 3);
    appendRow(part.cellRows, this->cellRows, triangles[k], stride);
  }
  std::vector<std::uint32_t> place(this->vertices(), Unused);
  markUsed(some, place, poll);
  part.origin = this->origin;
  part.marksHeld = this->marksHeld;
  for (std::size_t v = 0; v < place.size(); ++v)
  {
    poll.at(v);
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

void SurfacePart::dropUnusedVertices(const Poll& poll)
{
  std::vector<std::uint32_t> place(this->vertices(), Unused);
  markUsed(this->corners, place, poll);
  markUsed(this->wedges, place, poll);
  const std::size_t stride = this->rowBytes();
  // In place: a vertex never moves up.
  const bool hasQuadrics = !this->quadrics.empty();
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < place.size(); ++v)
  {
    poll.at(v);
    if (place[v] == Unused)
    {
      continue;
    }
    place[v] = kept;
    this->ids[kept] = this->ids[v];
    moveRow(this->points, v, kept, 3);
    if (hasQuadrics)
    {
      this->quadrics[kept] = this->quadrics[v];
      this->lacksBoundary[kept] = this->lacksBoundary[v];
    }
    moveRow(this->rows, v, kept, stride);
    if (!this->atPlace.empty())
    {
      this->atPlace[kept] = this->atPlace[v];
    }
    ++kept;
  }
  this->ids.resize(kept);
  this->points.resize(3 * std::size_t(kept));
  this->quadrics.resize(hasQuadrics ? kept : 0);
  this->lacksBoundary.resize(hasQuadrics ? kept : 0);
  this->rows.resize(kept * stride);
  this->atPlace.resize(this->atPlace.empty() ? 0 : kept);
  for (std::vector<std::uint32_t>* const list : { &this->corners, &this->wedges })
  {
    for (std::uint32_t& corner : *list)
    {
      corner = place[corner];
    }
  }
}

std::vector<ColumnSpec> carriedColumns(const StreamInfo& info)
{
  std::vector<ColumnSpec> carried = info.cellColumns;
  std::erase_if(carried, std::not_fn(isCarried));
  return carried;
}

SurfaceParts::SurfaceParts(MeshSource& source, bool marksHeld, Pool& pool, std::size_t triangles,
  std::function<void(double)> progress, const Poll& poll)
  : Source(source)
  , MarksHeld(marksHeld)
  , Least(triangles)
  , Progress(std::move(progress))
  , Polled(poll)
  , RowBytes(static_cast<std::size_t>(rowBytes(source.info().vertexColumns)))
  , Points(pool, 3)
  , Rows(pool, static_cast<int>(this->RowBytes))
  , Labels(carriedColumns(source.info()), pool)
{
}

bool SurfaceParts::next(StreamPart& part)
{
  this->Corners.clear();
  this->CellRows.clear();
  // What no later cell uses goes before the next blocks are read.
  this->Points.release(this->Final);
  if (this->RowBytes > 0)
  {
    this->Rows.release(this->Final);
  }
  this->Released = this->Final;
  part.begin = this->Vertices;
  if (this->Source.info().cells > 0)
  {
    this->Corners.reserve(
      3 * std::min(this->Least, static_cast<std::size_t>(this->Source.info().cells)));
  }
  while (this->Corners.size() < 3 * this->Least && !this->IsAtEnd)
  {
    if (this->Source.next(this->Block))
    {
      this->add(this->Block);
    }
    else
    {
      this->IsAtEnd = true;
      // At the end of the stream all vertices are final.
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
    // The origin of all quadrics, the same for all parts, since quadrics of different parts are
    // added.
    std::copy_n(block.positions.begin(), 3, this->Origin.begin());
  }
  std::ranges::copy(block.positions, this->Points.append(block.vertices()).begin());
  if (this->RowBytes > 0)
  {
    std::byte* rows = this->Rows.append(block.vertices()).data();
    // The tuples of all columns of a vertex follow each other, so that they move with it as one
    // row.
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
  this->Labels.add(block);
  const Column* flags = block.flags();
  for (std::size_t i = 0; i + 2 < block.corners.size(); i += 3)
  {
    const std::int64_t* c = block.corners.data() + i;
    // Triangles that lie on each other or have no area would only keep edges from collapsing.
    if (!isDistinctCell(c, 3, flags ? flags->as<std::uint8_t>()[i / 3] : 0))
    {
      continue;
    }
    this->Corners.insert(this->Corners.end(), c, c + 3);
    for (const Column& column : block.cellColumns)
    {
      if (isCarried(column.spec))
      {
        appendRow(this->CellRows, column.bytes, i / 3, column.spec.tupleBytes());
      }
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

/** Makes a surface of the collected triangles, whose vertices are numbered in the order of the
 * stream. */
void SurfaceParts::localise(SurfacePart& surface)
{
  std::vector<std::uint32_t> place(
    static_cast<std::size_t>(this->Vertices - this->Released), Unused);
  const auto placeOf = [&](std::int64_t id) -> std::uint32_t&
  { return place[static_cast<std::size_t>(id - this->Released)]; };
  std::size_t used = 0;
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    this->Polled.at(i);
    std::uint32_t& mark = placeOf(this->Corners[i]);
    used += mark == Unused ? 1 : 0;
    mark = 0;
  }
  surface = {};
  surface.ids.reserve(used);
  surface.points.reserve(3 * used);
  surface.rows.reserve(used * this->RowBytes);
  surface.origin = this->Origin;
  for (std::int64_t id = this->Released; id < this->Vertices; ++id)
  {
    this->Polled.at(static_cast<std::size_t>(id));
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
  surface.cellRows = this->CellRows;
  surface.labels = this->Labels.places();
  surface.edgeGroups = edgeGroupsIn(carriedColumns(this->Source.info()));
  surface.marksHeld = this->MarksHeld;
  surface.corners.reserve(this->Corners.size());
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    this->Polled.at(i);
    surface.corners.push_back(placeOf(this->Corners[i]));
  }
  this->addAreas(CellLabels::Given, surface);
}

void SurfaceParts::addAreas(CellLabels::Surface on, const SurfacePart& surface)
{
  const std::size_t stride = surface.cellRowBytes();
  for (std::size_t t = 0; t < surface.triangles(); ++t)
  {
    this->Polled.at(t);
    const std::uint32_t* c = surface.corners.data() + 3 * t;
    const Vector twice = surface.area(c[0], c[1], c[2]);
    const double area = std::sqrt(dot(twice, twice));
    this->Areas[on] += area;
    if (stride > 0)
    {
      this->Labels.addArea(on, surface.cellRows.data() + t * stride, area);
    }
  }
}

} // namespace smg
