// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/RawMeshBuilder.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/SolidSplit.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace smg
{

RawMeshBuilder::RawMeshBuilder(Workspace& workspace, CellChoice choice, Use use)
  : Space(workspace)
  , Choice(choice)
  , Used(use)
  , Mesh(workspace)
  , ElementGroups(workspace)
  , Further(workspace)
  , Lower{ GroupedElements(workspace), GroupedElements(workspace), GroupedElements(workspace) }
{
  if (choice != CellChoice::Only)
  {
    this->Mesh.cellType =
      choice == CellChoice::Triangles ? CellType::Triangle : CellType::Tetrahedron;
    this->Kind = this->Mesh.cellType;
  }
}

RawMeshBuilder::BuiltColumn* RawMeshBuilder::addColumn(ColumnOf of, const ColumnSpec& spec)
{
  std::deque<BuiltColumn>& columns = this->Columns[std::size_t(of)];
  // Leaves room for numbers, flags and results.
  constexpr std::size_t Most = VsmFormat::MaxColumns - 96;
  if (columns.size() >= Most)
  {
    const std::string note = "Columns after the first " + std::to_string(Most) +
                             " of the vertices or of the cells are left out.";
    if (this->Mesh.counts.notes.empty() || this->Mesh.counts.notes.back() != note)
    {
      this->note(note);
    }
    return nullptr;
  }
  const bool isTaken = std::ranges::any_of(
    columns, [&spec](const BuiltColumn& column) { return column.spec.name == spec.name; });
  // Flags of cells are computed; those of a file might be wrong.
  const bool isReserved = isReservedColumn(spec.name) ||
                          (of == ColumnOf::Elements && spec.name == CellFlagsName) ||
                          (isGroupColumn(spec.name) && !this->HasGroupColumns);
  if (isReserved || isTaken || spec.components < 1)
  {
    this->Mesh.counts.droppedColumns.push_back(spec.name);
    return nullptr;
  }
  // Many columns, which may be filled concurrently, share the memory of a few.
  const std::int64_t share = this->Space.available() / 16 / (std::ssize(columns) + 1);
  columns.push_back({ RawColumn{ spec, BucketFile(this->Space, 1, share) } });
  return this->looks() ? nullptr : &columns.back();
}

StreamInfo RawMeshBuilder::found(const CellTypeFound& cells) const
{
  StreamInfo info;
  info.cellType = cells.type;
  info.doublePositions = this->Mesh.doublePositions;
  info.vertexColumns = this->specs(ColumnOf::Vertices, cells.type);
  info.cellColumns = this->specs(ColumnOf::Elements, cells.type);
  return info;
}

std::vector<RawColumn> RawMeshBuilder::finishColumns(ColumnOf of, std::int64_t tuples)
{
  std::vector<RawColumn> kept;
  for (BuiltColumn& column : this->Columns[std::size_t(of)])
  {
    const bool isOfOthers = isOfOtherCells(column.spec, of, this->Mesh.cellType);
    if (isOfOthers)
    {
      this->note("The column " + inQuotes(column.spec.name) +
                 " is left out, since it is of other cells, as of a solid that was cut.");
    }
    if (isOfOthers || column.isDropped)
    {
      continue;
    }
    const auto bytes = static_cast<std::int64_t>(column.spec.tupleBytes());
    if (column.tuples.bytes() != bytes * tuples)
    {
      throw MeshError("the column " + inQuotes(column.spec.name) + " has " +
                      std::to_string(column.tuples.bytes() / bytes) + " values, not " +
                      std::to_string(tuples));
    }
    column.tuples.close();
    kept.push_back(std::move(column));
  }
  return kept;
}

void RawMeshBuilder::vertex(double x, double y, double z)
{
  const std::array<double, 3> doubles{ x, y, z };
  const std::array<float, 3> floats{ static_cast<float>(x), static_cast<float>(y),
    static_cast<float>(z) };
  const bool isDouble = this->Mesh.doublePositions;
  // A sum of products by zero is zero if and only if all are finite.
  const bool finite =
    isDouble ? x * 0 + y * 0 + z * 0 == 0 : floats[0] * 0 + floats[1] * 0 + floats[2] * 0 == 0;
  if (!finite)
  {
    throw MeshError(std::isfinite(x) && std::isfinite(y) && std::isfinite(z)
                      ? "a coordinate is beyond the range of single precision"
                      : "a coordinate is not finite");
  }
  if (this->Mesh.vertices >= MaxVertices)
  {
    throw MeshError("the mesh has more than 4294967294 vertices, which are too many");
  }
  ++this->Mesh.vertices;
  if (this->looks())
  {
    return;
  }
  isDouble ? this->Mesh.positions.put(0, doubles) : this->Mesh.positions.put(0, floats);
}

bool RawMeshBuilder::wants(CellType type)
{
  if (!this->Kind)
  {
    this->Kind = this->Mesh.cellType = type;
  }
  const bool mayTurn = this->Choice == CellChoice::Only && !this->IsSurface;
  if (*this->Kind == CellType::Triangle && type == CellType::Tetrahedron && mayTurn)
  {
    this->makeTrianglesFacets();
    this->Kind = this->Mesh.cellType = type;
  }
  if (!this->looks())
  {
    return *this->Kind == type;
  }
  if (*this->Kind == type && (type == CellType::Tetrahedron || !mayTurn))
  {
    throw CellTypeFound{ type };
  }
  return false;
}

void RawMeshBuilder::numberVertices(std::int64_t first, std::int64_t count, std::int64_t base)
{
  this->FirstNumber = first;
  this->NumberCount = std::min(count, MaxVertices);
  this->BaseVertex = base;
}

std::uint32_t RawMeshBuilder::vertexOf(std::int64_t corner)
{
  // Without overflow: numbers may be any.
  const std::uint64_t place =
    static_cast<std::uint64_t>(corner) - static_cast<std::uint64_t>(this->FirstNumber);
  if (place >= static_cast<std::uint64_t>(this->NumberCount))
  {
    this->failAtCorner(corner, this->NumberCount, 0);
  }
  const std::int64_t vertex = this->BaseVertex + static_cast<std::int64_t>(place);
  if (vertex > this->LargestCorner)
  {
    this->LargestCorner = vertex;
    this->LineOfLargest = this->Line;
  }
  return static_cast<std::uint32_t>(vertex);
}

void RawMeshBuilder::cell(std::span<const std::int64_t> corners)
{
  std::array<std::uint32_t, 4> vertices{};
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    vertices[k] = this->vertexOf(corners[k]);
  }
  this->Mesh.corners.put(std::span<const std::uint32_t>(vertices.data(), corners.size()));
  ++this->Mesh.cells;
}

bool RawMeshBuilder::keep(
  std::size_t dimension, std::span<const std::int64_t> corners, GroupSet set)
{
  if (set == GroupTable::None || this->looks())
  {
    return false;
  }
  GroupedElements& kept = this->Lower[dimension];
  for (const std::int64_t corner : corners)
  {
    kept.corners.put(this->vertexOf(corner));
  }
  kept.sets.put(set);
  return true;
}

bool RawMeshBuilder::keepFacets(std::span<const std::int64_t> corners, GroupSet set)
{
  if (this->Choice == CellChoice::Triangles || set == GroupTable::None)
  {
    return false;
  }
  // From the least corner, as the faces of solids are split.
  const std::size_t count = corners.size();
  const auto first = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
  bool kept = false;
  for (std::size_t k = 2; k < count; ++k)
  {
    kept = this->keep(2,
      std::array{ corners[first], corners[(first + k - 1) % count], corners[(first + k) % count] },
      set);
  }
  return kept;
}

void RawMeshBuilder::grouped(int dimension, std::span<const std::int64_t> corners, GroupSet set)
{
  dimension == 2 ? this->keepFacets(corners, set)
                 : dimension < 2 && this->keep(std::size_t(dimension), corners, set);
}

void RawMeshBuilder::alsoIn(
  std::int64_t element, int dimension, std::span<const std::int64_t> corners, GroupSet set)
{
  const int ofCells = this->Kind ? cornersOf(*this->Kind) - 1 : 3;
  if (dimension <= 2)
  {
    this->grouped(dimension, corners, set); // also of triangles: a tetrahedron may follow
  }
  if (dimension == ofCells && set != GroupTable::None && !this->looks())
  {
    this->Further.put({ static_cast<std::uint32_t>(element), set });
    ++this->GroupedCells;
  }
}

/** A tetrahedron follows: the triangles so far are facets. */
void RawMeshBuilder::makeTrianglesFacets()
{
  RawMesh& mesh = this->Mesh;
  mesh.corners = RecordFile<std::uint32_t>(this->Space);
  mesh.elements = RecordFile<std::uint32_t>(this->Space);
  mesh.cells = 0;
  mesh.counts.triangulatedPolygons = 0;
  mesh.counts.droppedCells += this->CellElements - this->GroupedCells;
  this->CellElements = this->GroupedCells = 0;
  this->ElementIsCell = mesh.elementCount == 0;
}

void RawMeshBuilder::checkCorners() const
{
  if (!this->Numbers && this->LargestCorner >= this->Mesh.vertices)
  {
    this->failAtCorner(
      this->LargestCorner + this->FirstNumber, this->Mesh.vertices, this->LineOfLargest);
  }
}

void RawMeshBuilder::failAtCorner(std::int64_t number, std::int64_t count, std::int64_t line) const
{
  const std::string first = std::to_string(this->FirstNumber);
  throw MeshError("the corner " + std::to_string(number) + " is not a vertex: " +
                    (count == 0              ? "there are none"
                      : count == MaxVertices ? "they count from " + first
                                             : "they are " + first + " to " +
                                                 std::to_string(this->FirstNumber + (count - 1))),
    line);
}

void RawMeshBuilder::take(CellType type, std::span<const std::int64_t> corners)
{
  const bool isCell = this->wants(type);
  const bool isFacet = type == CellType::Triangle && this->keepFacets(corners, this->Current);
  if (isCell)
  {
    this->cell(corners);
  }
  isCell || isFacet ? this->endElement(isCell ? 1 : 0) : this->dropped();
}

void RawMeshBuilder::endElement(std::int64_t cells)
{
  if (cells != 1 || !this->ElementIsCell)
  {
    this->noteElements(cells);
  }
  if (this->Current != GroupTable::None || this->ElementGroups.size() > 0)
  {
    this->noteGroups(cells);
  }
  this->CellElements += cells > 0 ? 1 : 0;
  ++this->Mesh.elementCount;
  if (std::max(this->Mesh.cells, this->Mesh.elementCount) > std::int64_t(NoIndex) - 1)
  {
    throw MeshError("the mesh has more than 4294967294 cells, which are too many");
  }
}

/** Stores the element of its cells, the last ones, from the first element that is not one cell. */
void RawMeshBuilder::noteElements(std::int64_t cells)
{
  if (this->ElementIsCell)
  {
    this->ElementIsCell = false;
    for (std::int64_t cell = 0; cell < this->Mesh.cells - cells; ++cell)
    {
      this->Mesh.elements.put(static_cast<std::uint32_t>(cell));
    }
  }
  for (std::int64_t i = 0; i < cells; ++i)
  {
    this->Mesh.elements.put(static_cast<std::uint32_t>(this->Mesh.elementCount));
  }
}

/** Stores the groups of the element, from the first element on that is in one. */
void RawMeshBuilder::noteGroups(std::int64_t cells)
{
  if (this->looks())
  {
    return;
  }
  while (this->ElementGroups.size() < this->Mesh.elementCount)
  {
    this->ElementGroups.put(GroupTable::None);
  }
  this->ElementGroups.put(this->Current);
  this->GroupedCells += cells > 0 && this->Current != GroupTable::None ? 1 : 0;
}

void RawMeshBuilder::polygon(std::span<const std::int64_t> corners)
{
  this->IsFacet = this->keepFacets(corners, this->Current);
  for (const std::int64_t corner : corners)
  {
    this->fanCorner(corner);
  }
  this->endTriangles();
}

void RawMeshBuilder::strip(std::span<const std::int64_t> corners)
{
  for (const std::int64_t corner : corners)
  {
    this->stripCorner(corner);
  }
  this->endTriangles();
}

void RawMeshBuilder::endTriangles()
{
  this->Corners = 0;
  const std::int64_t triangles = std::exchange(this->Triangles, 0);
  const bool isFacet = std::exchange(this->IsFacet, false);
  if (triangles == 0)
  {
    isFacet ? this->endElement(0) : this->dropped();
    return;
  }
  this->Mesh.counts.triangulatedPolygons += triangles > 1 ? 1 : 0;
  this->endElement(triangles);
}

void RawMeshBuilder::solid(std::span<const std::int64_t> corners)
{
  if (!this->wants(CellType::Tetrahedron))
  {
    this->dropped();
    return;
  }
  const TetrahedraOfSolid tetrahedra = splitSolid(corners);
  if (tetrahedra.all().empty())
  {
    this->dropped();
    return;
  }
  for (const auto& tetrahedron : tetrahedra.all())
  {
    this->cell(tetrahedron);
  }
  ++this->Mesh.counts.splitCells;
  this->endElement(static_cast<std::int64_t>(tetrahedra.all().size()));
}

void RawMeshBuilder::element(int dimension, std::span<const std::int64_t> c, bool isHigherOrder)
{
  const std::int64_t before = this->cells();
  if (dimension < 2)
  {
    this->keep(static_cast<std::size_t>(dimension), c, this->Current) ? this->endElement(0)
                                                                      : this->dropped();
    return;
  }
  c.size() == 3    ? this->triangle(c[0], c[1], c[2])
  : dimension == 2 ? this->polygon(c)
  : c.size() == 4  ? this->tetrahedron(c[0], c[1], c[2], c[3])
  : c.size() == 6  ? this->solid(std::array{ c[0], c[2], c[1], c[3], c[5], c[4] })
                   : this->solid(c);
  if (isHigherOrder && this->cells() > before)
  {
    this->noteHigherOrder();
  }
}

RawMesh RawMeshBuilder::finish()
{
  RawMesh& mesh = this->Mesh;
  if (this->looks() && this->Kind && this->Choice == CellChoice::Only)
  {
    throw CellTypeFound{ *this->Kind };
  }
  if (mesh.cells == 0)
  {
    throw MeshError(this->Choice == CellChoice::Only ? "the file has no triangles and no tetrahedra"
                    : this->Choice == CellChoice::Triangles
                      ? "the file has no triangles (option --cells)"
                      : "the file has no tetrahedra (option --cells)");
  }
  this->checkCorners();
  mesh.corners.close();
  this->renumber(mesh.corners, static_cast<std::size_t>(cornersOf(mesh.cellType)), "cell ");
  this->finishGroups();
  this->Numbers.reset();
  // Elements after the last cell need not be stored.
  mesh.positions.close();
  mesh.elements.close();
  mesh.vertexColumns = this->finishColumns(ColumnOf::Vertices, mesh.vertices);
  mesh.elementColumns = this->finishColumns(ColumnOf::Elements, mesh.elementCount);
  return std::move(mesh);
}

void RawMeshBuilder::renumber(
  RecordFile<std::uint32_t>& corners, std::size_t count, const std::string& what)
{
  if (!this->Numbers || corners.size() == 0)
  {
    return;
  }
  RecordFile<std::uint32_t> renumbered(this->Space);
  std::int64_t item = 0;
  this->Numbers->apply(corners, count,
    [&](std::span<const std::uint32_t> numbers)
    {
      if (std::ranges::find(numbers, NoIndex) != numbers.end())
      {
        throw MeshError(what + std::to_string(item) +
                        ", counted from 0, names a vertex that the file does not have");
      }
      ++item;
      renumbered.put(numbers);
    });
  corners = std::move(renumbered);
  corners.close();
}

/** Adds the groups of elements that were told after these. */
void RawMeshBuilder::addFurtherGroups()
{
  this->ElementGroups.close();
  this->Further.close();
  RecordFile<GroupSet> all(this->Space);
  RecordFile<GroupSet>::Reader sets(this->ElementGroups);
  RecordFile<FurtherGroups>::Reader further(this->Further);
  FurtherGroups next{};
  bool has = further.next(next);
  for (std::int64_t element = 0; element < this->Mesh.elementCount; ++element)
  {
    GroupSet set = GroupTable::None;
    sets.next(set);
    for (; has && next.element == element; has = further.next(next))
    {
      set = this->Groups.join(set, next.set);
    }
    all.put(set);
  }
  this->ElementGroups = std::move(all);
}

/** What elements below the cells are in the mesh: the next lower ones are facets, the vertices of
 * the others belong to groups themselves. */
void RawMeshBuilder::finishGroups()
{
  RawMesh& mesh = this->Mesh;
  if (this->Groups.empty())
  {
    return;
  }
  if (this->Further.size() > 0)
  {
    this->addFurtherGroups();
  }
  mesh.groups = this->Groups.finish(mesh.cellType);
  if (this->Groups.overflowed())
  {
    this->note(GroupSets::overflowNote());
  }
  const auto cells = static_cast<std::size_t>(cornersOf(mesh.cellType) - 1);
  for (std::size_t dimension = 0; dimension < cells; ++dimension)
  {
    GroupedElements& lower = this->Lower[dimension];
    lower.close();
    this->renumber(lower.corners, dimension + 1, "facet or point ");
    if (dimension == cells - 1)
    {
      mesh.facets = std::move(lower);
      continue;
    }
    RecordFile<std::uint32_t>::Reader corners(lower.corners);
    RecordFile<GroupSet>::Reader sets(lower.sets);
    std::uint32_t vertex = 0;
    for (GroupSet set = GroupTable::None; sets.next(set);)
    {
      for (std::size_t k = 0; k <= dimension && corners.next(vertex); ++k)
      {
        mesh.points.corners.put(vertex);
        mesh.points.sets.put(set);
      }
    }
  }
  mesh.points.close();
  if (this->GroupedCells > 0)
  {
    while (this->ElementGroups.size() < mesh.elementCount)
    {
      this->ElementGroups.put(GroupTable::None);
    }
    const ColumnSpec spec = MeshGroups::columnSpec(GroupOf::Cells, cornersOf(mesh.cellType));
    this->HasGroupColumns = true;
    if (BuiltColumn* column = this->addColumn(ColumnOf::Elements, spec))
    {
      column->tuples = std::move(this->ElementGroups.bytes());
    }
  }
}

RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace)
{
  const StreamInfo& info = source.info();
  const bool triangles = info.cellType == CellType::Triangle;
  RawMeshBuilder builder(workspace, CellChoice::Only);
  builder.setGroups(info.groups);
  if (!info.doublePositions)
  {
    builder.useSinglePrecision();
  }
  std::vector<ImportColumn> vertexColumns, cellColumns;
  for (const ColumnSpec& spec : info.vertexColumns)
  {
    vertexColumns.emplace_back(builder, ColumnOf::Vertices, spec);
  }
  for (const ColumnSpec& spec : info.cellColumns)
  {
    spec.name == CellFlagsName ? cellColumns.emplace_back()
                               : cellColumns.emplace_back(builder, ColumnOf::Elements, spec);
  }
  try
  {
    for (MeshBlock block; source.next(block);)
    {
      for (std::size_t i = 0; i < block.positions.size(); i += 3)
      {
        builder.vertex(block.positions[i], block.positions[i + 1], block.positions[i + 2]);
      }
      for (std::size_t c = 0; c < vertexColumns.size(); ++c)
      {
        vertexColumns[c].append(block.vertexColumns[c].bytes);
      }
      const std::int64_t* corner = block.corners.data();
      const std::int64_t* const end = corner + block.corners.size();
      for (; corner != end; corner += triangles ? 3 : 4)
      {
        triangles ? builder.triangle(corner[0], corner[1], corner[2])
                  : builder.tetrahedron(corner[0], corner[1], corner[2], corner[3]);
      }
      for (std::size_t c = 0; c < cellColumns.size(); ++c)
      {
        cellColumns[c].append(block.cellColumns[c].bytes);
      }
    }
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(name + ": the stream cannot be brought into another order: " + error.what() + '.');
  }
}

} // namespace smg
