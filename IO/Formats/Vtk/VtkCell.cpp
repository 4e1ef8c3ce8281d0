// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkCell.h"

#include "IO/External/Workspace.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Import/Polygons.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>

namespace smg
{
namespace
{

enum class Shape : std::uint8_t
{
  Unknown,
  PointOrLine,
  Polygon,
  QuadraticPolygon,
  Pixel,
  Strip,
  Tetrahedron,
  Voxel,
  Solid
};

/** The description of a type of VTK: corners first, then any number of other points. */
struct TypeOfCell
{
  Shape shape = Shape::Unknown;
  std::uint8_t corners = 0; ///< 0: any number
  bool higherOrder = false;
};

constexpr std::array<TypeOfCell, 82> makeVtkTypes()
{
  std::array<TypeOfCell, 82> types{};
  for (const int type : { 1, 2, 3, 4, 21, 35, 60, 68, 75 })
  {
    types[type] = { Shape::PointOrLine, 0, false };
  }
  types[5] = { Shape::Polygon, 3, false };
  types[6] = { Shape::Strip, 0, false };
  types[7] = { Shape::Polygon, 0, false };
  types[8] = { Shape::Pixel, 4, false };
  types[9] = { Shape::Polygon, 4, false };
  types[10] = { Shape::Tetrahedron, 4, false };
  types[11] = { Shape::Voxel, 8, false };
  types[12] = { Shape::Solid, 8, false };
  types[13] = { Shape::Solid, 6, false };
  types[14] = { Shape::Solid, 5, false };
  types[36] = { Shape::QuadraticPolygon, 0, true };
  // Quadratic ones, those of any order, Lagrange's and Bezier's.
  for (const int type : { 22, 34, 61, 69, 76 })
  {
    types[type] = { Shape::Polygon, 3, true };
  }
  for (const int type : { 23, 28, 30, 62, 70, 77 })
  {
    types[type] = { Shape::Polygon, 4, true };
  }
  for (const int type : { 24, 64, 71, 78 })
  {
    types[type] = { Shape::Tetrahedron, 4, true };
  }
  for (const int type : { 25, 29, 33, 67, 72, 79 })
  {
    types[type] = { Shape::Solid, 8, true };
  }
  for (const int type : { 26, 31, 32, 65, 73, 80 })
  {
    types[type] = { Shape::Solid, 6, true };
  }
  for (const int type : { 27, 37, 66, 74, 81 })
  {
    types[type] = { Shape::Solid, 5, true };
  }
  return types;
}

constexpr std::array<TypeOfCell, 82> VtkTypes = makeVtkTypes();

const TypeOfCell& typeOf(int type)
{
  static constexpr TypeOfCell Unknown;
  return type >= 0 && type < static_cast<int>(VtkTypes.size()) ? VtkTypes[std::size_t(type)]
                                                               : Unknown;
}

[[noreturn]] void failForType(int type)
{
  throw MeshError("its type is " + nameOfVtkType(type) +
                  ", which is not read: cut the mesh into triangles or tetrahedra first");
}

/** Memory for the parts on their way; more go through scratch files. */
constexpr std::int64_t Memory = std::int64_t(64) << 20;

std::vector<std::int64_t> numbersIn(RecordFile<std::uint32_t>& file)
{
  std::vector<std::int64_t> numbers;
  numbers.reserve(static_cast<std::size_t>(file.size()));
  RecordFile<std::uint32_t>::Reader reader(file);
  for (std::uint32_t number = 0; reader.next(number);)
  {
    numbers.push_back(number);
  }
  return numbers;
}

} // namespace

/** Of those that other programs write and are not read. */
std::string nameOfVtkType(int type)
{
  switch (type)
  {
    case 15:
      return "pentagonal prism";
    case 16:
      return "hexagonal prism";
    case 41:
      return "convex point set";
    case 42:
      return "polyhedron";
    default:
      return "VTK's type " + std::to_string(type);
  }
}

bool isReadFromVtk(int type)
{
  return typeOf(type).shape != Shape::Unknown;
}

bool isPointOrLine(int type)
{
  return typeOf(type).shape == Shape::PointOrLine;
}

int dimensionOfVtk(int type)
{
  constexpr int Vertex = 1;
  return isSolidOfVtk(type)                                   ? 3
         : !isPointOrLine(type)                               ? 2
         : type == Vertex || type == VtkCellTypes::PolyVertex ? 0
                                                              : 1;
}

bool isSolidOfVtk(int type)
{
  const Shape shape = typeOf(type).shape;
  return shape == Shape::Tetrahedron || shape == Shape::Voxel || shape == Shape::Solid;
}

std::int64_t partsOfVtk(int type, std::int64_t points)
{
  const TypeOfCell& cell = typeOf(type);
  const std::int64_t corners = cell.shape == Shape::QuadraticPolygon ? points / 2
                               : cell.corners > 0                    ? cell.corners
                                                                     : points;
  switch (cell.shape)
  {
    case Shape::Unknown:
    case Shape::PointOrLine:
      return 0;
    case Shape::Tetrahedron:
      return 1;
    case Shape::Voxel:
    case Shape::Solid:
      return corners == 8 ? 6 : corners - 3;
    default:
      return std::max<std::int64_t>(corners - 2, 0);
  }
}

namespace
{

/** Of a polyline each line; of other lines both ends, which come first. */
void takePointsOrLines(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder)
{
  const int dimension = dimensionOfVtk(type);
  const auto size = static_cast<std::size_t>(dimension) + 1;
  if (points.size() < size)
  {
    builder.dropped();
    return;
  }
  builder.element(dimension, points.first(size));
  const bool areMany = type == VtkCellTypes::PolyVertex || type == VtkCellTypes::PolyLine;
  for (std::size_t k = 1; areMany && k + size <= points.size(); ++k)
  {
    builder.grouped(dimension, points.subspan(k, size), builder.currentGroups());
  }
}

} // namespace

void takeVtkCell(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder)
{
  if (type == VtkCellTypes::Tetrahedron && points.size() == 4)
  {
    // The most frequent cells of a volume.
    builder.tetrahedron(points[0], points[1], points[2], points[3]);
    return;
  }
  const TypeOfCell& cell = typeOf(type);
  const bool sound = cell.higherOrder ? points.size() >= cell.corners
                                      : cell.corners == 0 || points.size() == cell.corners;
  if (!sound)
  {
    throw MeshError("it has " + std::to_string(points.size()) + " points, which its type, VTK's " +
                    std::to_string(type) + ", cannot have");
  }
  const auto corners = cell.corners > 0 ? points.first(cell.corners) : points;
  const auto& p = corners;
  const std::int64_t before = builder.cells();
  switch (cell.shape)
  {
    case Shape::Tetrahedron:
      builder.tetrahedron(p[0], p[1], p[2], p[3]);
      break;
    case Shape::Polygon:
      p.size() == 3 ? builder.triangle(p[0], p[1], p[2]) : builder.polygon(p);
      break;
    case Shape::QuadraticPolygon:
      builder.polygon(p.first(p.size() / 2));
      break;
    case Shape::Pixel:
      builder.polygon(std::array{ p[0], p[1], p[3], p[2] });
      break;
    case Shape::Strip:
      builder.strip(p);
      break;
    case Shape::Voxel:
      builder.solid(std::array{ p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6] });
      break;
    case Shape::Solid:
      builder.solid(p);
      break;
    case Shape::PointOrLine:
      takePointsOrLines(type, points, builder);
      break;
    default:
      failForType(type);
  }
  if (cell.higherOrder && builder.cells() > before)
  {
    builder.noteHigherOrder();
  }
}

VtkCellParts cutVtkCells(std::int64_t points, const VtkPointAt& pointAt, std::int64_t cells,
  CellChoice choice, const VtkCellAt& at, const std::filesystem::path& scratch)
{
  std::vector<std::int64_t> ofCell;
  Workspace space(scratch, Memory);
  RawMeshBuilder builder(space, choice);
  for (std::int64_t point = 0; point < points; ++point)
  {
    const auto [x, y, z] = pointAt(point);
    builder.vertex(x, y, z);
  }
  builder.numberVertices(0, points);
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    try
    {
      const int type = at(cell, ofCell);
      takeVtkCell(type, ofCell, builder);
    }
    catch (const MeshError& error)
    {
      throw Error("The input: cell " + std::to_string(cell) + ": " + error.what() + '.');
    }
  }
  try
  {
    RawMesh mesh = builder.finish();
    cutPolygons(mesh, space);
    VtkCellParts parts{ mesh.cellType, numbersIn(mesh.corners), numbersIn(mesh.elements) };
    if (parts.cellOf.empty())
    {
      parts.cellOf.resize(static_cast<std::size_t>(mesh.cells));
      std::iota(parts.cellOf.begin(), parts.cellOf.end(), 0);
    }
    return parts;
  }
  catch (const MeshError& error)
  {
    throw Error("The input: " + std::string(error.what()) + '.');
  }
}

} // namespace smg
