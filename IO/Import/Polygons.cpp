// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Polygons.h"

#include "IO/External/ExternalSort.h"
#include "IO/Import/PolygonTriangulation.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <tuple>
#include <vector>

// Polygons become fans while a file is parsed, when positions may not be known yet. Here their
// corners meet their positions, by two external sorts: by vertex, then back to the order of the
// cells. Then those polygons are cut anew whose fans do not cover them. A polygon keeps the number
// of its triangles, so that nothing else of the mesh changes.

namespace smg
{

namespace
{

/** The triangles of a mesh, with those that begin and end an element. */
class ElementTriangles
{
public:
  explicit ElementTriangles(const RawMesh& mesh)
    : Corners(mesh.corners)
    , Elements(mesh.elements)
  {
    this->read();
  }

  /** Goes to the next triangle; returns false at the end. */
  bool next()
  {
    if (!this->Ahead)
    {
      return false;
    }
    const bool begins = this->Place < 0 || this->AheadElement != this->Element;
    this->Triangle = *this->Ahead;
    this->Element = this->AheadElement;
    ++this->Place;
    this->read();
    this->Begins = begins;
    this->Ends = !this->Ahead || this->AheadElement != this->Element;
    return true;
  }

  std::span<const std::uint32_t, 3> corners() const { return this->Triangle; }
  std::int64_t place() const { return this->Place; }
  bool begins() const { return this->Begins; }
  bool ends() const { return this->Ends; }

private:
  void read()
  {
    std::array<std::uint32_t, 3> corners{};
    this->Ahead.reset();
    if (this->Corners.next(std::span<std::uint32_t>(corners)) &&
        this->Elements.next(this->AheadElement))
    {
      this->Ahead = corners;
    }
  }

  RecordFile<std::uint32_t>::Reader Corners, Elements;
  std::optional<std::array<std::uint32_t, 3>> Ahead;
  std::uint32_t AheadElement = 0;
  std::array<std::uint32_t, 3> Triangle{};
  std::uint32_t Element = 0;
  std::int64_t Place = -1;
  bool Begins = false, Ends = false;
};

/** A corner of an element of several triangles, by its place among those of all triangles. */
struct PlacedCorner
{
  std::uint32_t vertex;
  std::int64_t place;

  bool operator<(const PlacedCorner& other) const
  {
    return std::tie(this->vertex, this->place) < std::tie(other.vertex, other.place);
  }
};

/** The corners of an element that a triangle adds, if the element is a fan: its first triangle adds
 * all three, the others their last one. None if it is a triangle. */
std::span<const std::uint32_t> addedCorners(const ElementTriangles& triangles)
{
  const std::size_t known = !triangles.begins() ? 2 : triangles.ends() ? 3 : 0;
  return triangles.corners().subspan(known);
}

/** Puts the positions of the added corners of the next triangles, by their places: of whole
 * elements until there are `least` corners. Returns the place after the last triangle. */
std::int64_t joinPositions(const RawMesh& mesh, ElementTriangles& triangles, std::int64_t least,
  Workspace& workspace, std::int64_t memory, RowSort& placed)
{
  ExternalSort<PlacedCorner> corners(workspace, memory);
  while (triangles.next())
  {
    std::int64_t place = 3 * triangles.place() + (triangles.begins() ? 0 : 2);
    for (const std::uint32_t vertex : addedCorners(triangles))
    {
      corners.put({ vertex, place++ });
    }
    if (triangles.ends() && corners.size() >= least)
    {
      break;
    }
  }
  corners.sort();
  BucketFile::Reader positions(mesh.positions);
  std::vector<std::byte> position(mesh.positionBytes());
  std::int64_t vertex = -1;
  for (PlacedCorner corner{}; corners.next(corner);)
  {
    for (; vertex < corner.vertex; ++vertex)
    {
      positions.read(position);
    }
    std::ranges::copy(position, placed.put(static_cast<std::uint64_t>(corner.place)));
  }
  placed.sort();
  return triangles.place() + 1;
}

/** The polygons of a mesh, which are cut anew where their fans do not cover them. */
class PolygonCutter
{
public:
  PolygonCutter(const RawMesh& mesh, Workspace& workspace, std::size_t maxCorners)
    : Space(workspace)
    , Corners(workspace)
    , Positions(mesh.doublePositions)
    , MaxCorners(maxCorners)
    , Poll([this] { this->Space.poll(); })
  {
  }

  /** Takes the next triangle, with the positions of the corners that it adds. */
  void take(const ElementTriangles& triangles, RowSort& placed)
  {
    if (const auto added = addedCorners(triangles); !added.empty())
    {
      this->add(triangles, added, placed);
      if (triangles.ends())
      {
        this->endElement();
      }
      return;
    }
    this->Corners.put(triangles.corners());
  }

  RecordFile<std::uint32_t>& corners() { return this->Corners; }
  void note(ImportCounts& counts) const
  {
    if (this->Overlapping > 0)
    {
      counts.notes.push_back(counted(this->Overlapping, "polygon crosses itself: its",
                               "polygons cross themselves: their") +
                             " triangles overlap.");
    }
    if (this->Large > 0)
    {
      counts.notes.push_back(
        counted(this->Large, "polygon has", "polygons have") + " more than " +
        std::to_string(this->MaxCorners) +
        " corners, which is more than the memory holds, and became triangles around the first "
        "corner, which is wrong unless the polygon is convex: allow more memory.");
    }
  }

private:
  void add(const ElementTriangles& triangles, std::span<const std::uint32_t> added, RowSort& placed)
  {
    const std::span<const std::uint32_t, 3> corners = triangles.corners();
    if (triangles.begins())
    {
      this->Fan.clear();
      this->Coordinates.clear();
      this->IsFan = true;
      this->IsLarge = false;
    }
    // Not so for the triangles of a strip.
    this->IsFan = this->IsFan && (triangles.begins() ||
                                   (corners[0] == this->Fan.front() && corners[1] == this->Last));
    this->Last = corners[2];
    if (this->Fan.size() + added.size() > this->MaxCorners)
    {
      this->writeFan();
      this->IsLarge = true;
    }
    for (const std::uint32_t vertex : added)
    {
      RowSort::Row row;
      placed.next(row);
      this->Positions.append({ row.bytes, this->Positions.size() }, this->Coordinates);
      this->Fan.push_back(vertex);
    }
    this->Triangles.insert(this->Triangles.end(), corners.begin(), corners.end());
  }

  void endElement()
  {
    if (this->IsFan && !this->IsLarge)
    {
      this->Triangulation.cut(this->Coordinates, this->Poll);
      this->Overlapping += this->Triangulation.overlaps() ? 1 : 0;
      if (!this->Triangulation.isFan())
      {
        this->Triangles.clear();
        for (const PolygonTriangulation::Triangle& triangle : this->Triangulation.triangles())
        {
          for (const std::uint32_t place : triangle)
          {
            this->Triangles.push_back(this->Fan[place]);
          }
        }
      }
    }
    this->Large += this->IsFan && this->IsLarge ? 1 : 0;
    this->writeFan();
  }

  /** Writes the collected triangles as they are. */
  void writeFan()
  {
    this->Corners.put(std::span<const std::uint32_t>(this->Triangles));
    this->Triangles.clear();
    this->Fan.resize(std::min<std::size_t>(this->Fan.size(), 1));
    this->Coordinates.clear();
  }

  Workspace& Space;
  RecordFile<std::uint32_t> Corners;
  FilePositions Positions;
  std::size_t MaxCorners;
  std::function<void()> Poll;

  // Of the current element.
  std::vector<std::uint32_t> Fan, Triangles; ///< its corners as a fan; those of its triangles
  std::vector<double> Coordinates;
  std::uint32_t Last = 0; ///< corner of its last triangle
  bool IsFan = true, IsLarge = false;

  PolygonTriangulation Triangulation;
  std::int64_t Overlapping = 0, Large = 0;
};

} // namespace

void cutPolygons(RawMesh& mesh, Workspace& workspace)
{
  if (mesh.cellType != CellType::Triangle || mesh.counts.triangulatedPolygons == 0)
  {
    return;
  }
  const std::int64_t memory = workspace.available() / 3;
  const std::int64_t bytes = static_cast<std::int64_t>(mesh.positionBytes());
  const std::int64_t corners = mesh.cells + 2 * mesh.counts.triangulatedPolygons;
  const Reservation reserved(workspace.pool(), memory / 2);
  PolygonCutter cutter(
    mesh, workspace, static_cast<std::size_t>(memory / 2) / PolygonTriangulation::BytesPerCorner);
  // In several parts, so that the files of the sorts stay smaller than those that come later; each
  // takes a pass over the positions.
  constexpr std::int64_t MostParts = 4;
  const std::int64_t least =
    std::max(corners / MostParts, memory / (bytes + std::int64_t(sizeof(PlacedCorner))));
  ElementTriangles joined(mesh);
  for (ElementTriangles triangles(mesh); triangles.place() + 1 < mesh.cells;)
  {
    RowSort placed(workspace, memory, mesh.positionBytes());
    const std::int64_t end = joinPositions(mesh, joined, least, workspace, memory, placed);
    while (triangles.place() + 1 < end && triangles.next())
    {
      cutter.take(triangles, placed);
    }
  }
  cutter.note(mesh.counts);
  mesh.corners = std::move(cutter.corners());
  mesh.corners.close();
}

} // namespace smg
