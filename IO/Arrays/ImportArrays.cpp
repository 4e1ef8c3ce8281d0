// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/ImportArrays.h"

#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

std::string inRow(const char* array, std::int64_t row)
{
  return std::string(array) + ": row " + std::to_string(row) + ": ";
}

/** Calls add(row) for all rows of an array and reports a progress from `begin` to `end`. */
template <class Add>
void forEachRow(
  const ArrayView& array, Progress& progress, double begin, double end, const Add& add)
{
  constexpr std::int64_t Rows = 1 << 16;
  for (std::int64_t row = 0; row < array.rows; ++row)
  {
    add(row);
    if (row % Rows == 0)
    {
      progress.update(
        begin + (end - begin) * static_cast<double>(row) / static_cast<double>(array.rows));
    }
  }
}

/** Adds the vertices. `place(row)` begins the error of one that cannot be a vertex. */
template <class ThrownError, class Place>
void addPoints(const ArrayView& points, RawMeshBuilder& builder, Progress& progress, double end,
  const Place& place)
{
  if (points.type == ScalarType::Float32)
  {
    builder.useSinglePrecision();
  }
  std::int64_t vertex = 0;
  try
  {
    forEachRow(points, progress, 0.0, end,
      [&](std::int64_t row)
      {
        vertex = row;
        builder.vertex(
          points.value<double>(row, 0), points.value<double>(row, 1), points.value<double>(row, 2));
      });
  }
  catch (const MeshError& error)
  {
    throw ThrownError(place(vertex) + error.what() + '.');
  }
}

/** The corners of cells of integers of type T. */
template <class T>
void addCells(const ArrayView& cells, RawMeshBuilder& builder, Progress& progress)
{
  const auto count = static_cast<std::uint64_t>(builder.vertices());
  std::array<std::int64_t, 4> corners{};
  forEachRow(cells, progress, 0.5, 1.0,
    [&](std::int64_t row)
    {
      for (std::int64_t k = 0; k < cells.columns; ++k)
      {
        T corner{};
        std::memcpy(&corner, cells.at(row, k), sizeof corner);
        if (static_cast<std::uint64_t>(corner) >= count)
        {
          throw ArgumentError(inRow("cells", row) + "the corner " + std::to_string(corner) +
                              " is not a row of points: these are 0 to " +
                              std::to_string(static_cast<std::int64_t>(count) - 1) + '.');
        }
        corners[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(corner);
      }
      cells.columns == 3 ? builder.triangle(corners[0], corners[1], corners[2])
                         : builder.tetrahedron(corners[0], corners[1], corners[2], corners[3]);
    });
}

} // namespace

void checkArrays(const ArrayView& points, const ArrayView& cells)
{
  if (points.columns != 3)
  {
    throw ArgumentError("points: must have 3 columns, x, y and z, but there are " +
                        std::to_string(points.columns) + '.');
  }
  if (!cells.isInteger())
  {
    throw ArgumentError("cells: must be integers, the rows of points.");
  }
  if (cells.columns != 3 && cells.columns != 4)
  {
    throw ArgumentError("cells: must have 3 columns, the corners of triangles, or 4 of tetrahedra, "
                        "but there are " +
                        std::to_string(cells.columns) + '.');
  }
  if (points.rows == 0 || cells.rows == 0)
  {
    throw ArgumentError(std::string(points.rows == 0 ? "points" : "cells") + ": has no rows.");
  }
}

RawMesh importArrays(const ArrayView& points, const ArrayView& cells, Workspace& workspace,
  const ProgressFunction& progress)
{
  RawMeshBuilder builder(
    workspace, cells.columns == 3 ? CellChoice::Triangles : CellChoice::Tetrahedra);
  Progress reported(progress);
  addPoints<ArgumentError>(
    points, builder, reported, 0.5, [](std::int64_t row) { return inRow("points", row); });
  try
  {
    dispatch(cells.type,
      [&]<class T>(T)
      {
        if constexpr (std::is_integral_v<T>)
        {
          addCells<T>(cells, builder, reported);
        }
      });
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw ArgumentError(std::string("cells: ") + error.what() + '.');
  }
}

namespace
{

/** Adds the cells and the attributes of a mesh as VTK has it. */
class MeshArraysImport
{
public:
  MeshArraysImport(const MeshArrays& mesh, const std::string& name, RawMeshBuilder& builder,
    const ProgressFunction& progress)
    : Mesh(mesh)
    , Name(name)
    , Builder(builder)
    , Reported(progress)
  {
  }

  void run()
  {
    constexpr double Points = 0.3, Cells = 0.7;
    addPoints<Error>(this->Mesh.points, this->Builder, this->Reported, Points,
      [this](std::int64_t row) { return this->Name + ", point " + std::to_string(row) + ": "; });
    this->Builder.numberVertices(0, this->Builder.vertices());
    for (const CellArrays& list : this->Mesh.cells)
    {
      this->addCells(list, Points, Cells);
    }
    this->addColumns(this->Mesh.ofPoints, ColumnOf::Vertices);
    this->Reported.update(0.5 * (Cells + 1.0));
    this->addColumns(this->Mesh.ofCells, ColumnOf::Elements);
    noteArrays(this->Builder, this->Others, this->Repeated);
    noteGhosts(this->Builder, this->Ghosts);
  }

private:
  bool isOwn(std::int64_t cell) const
  {
    return !this->Mesh.ghosts || isOwnVtkCell(this->Mesh.ghosts->value<std::int64_t>(cell, 0));
  }

  void addCells(const CellArrays& list, double begin, double end)
  {
    const ArrayView each{ .rows = list.cells() };
    try
    {
      forEachRow(each, this->Reported, begin, end,
        [&](std::int64_t cell)
        {
          this->addCell(list, cell);
          ++this->Cell;
        });
    }
    catch (const MeshError& error)
    {
      throw Error(this->Name + ", cell " + std::to_string(this->Cell) + ": " + error.what() + '.');
    }
  }

  void addCell(const CellArrays& list, std::int64_t cell)
  {
    const auto begin = list.offsets.value<std::int64_t>(cell, 0);
    const auto end = list.offsets.value<std::int64_t>(cell + 1, 0);
    if (begin < 0 || end < begin || end > list.corners.rows)
    {
      throw MeshError("its points should be the numbers from " + std::to_string(begin) + " up to " +
                      std::to_string(end) + " of " + std::to_string(list.corners.rows) +
                      ", which cannot be");
    }
    if (!this->isOwn(this->Cell))
    {
      ++this->Ghosts;
      return;
    }
    this->Points.resize(static_cast<std::size_t>(end - begin));
    for (std::int64_t k = begin; k < end; ++k)
    {
      this->Points[static_cast<std::size_t>(k - begin)] = list.corners.value<std::int64_t>(k, 0);
    }
    takeVtkCell(
      list.types ? list.types->value<int>(cell, 0) : list.type, this->Points, this->Builder);
  }

  void addColumns(const AttributeArrays& attributes, ColumnOf of)
  {
    std::vector<NamedArray> named;
    VtkArrayNames names;
    for (NamedArray array : attributes.arrays)
    {
      names.nameApart(array, this->Repeated);
      named.push_back(std::move(array));
    }
    for (const NamedArray& array : named)
    {
      const auto components = static_cast<int>(array.values.columns);
      const std::string name = columnName(array.name, components, named, attributes.normals);
      ImportColumn column(this->Builder, of, { name, array.values.type, components });
      if (column.exists())
      {
        this->addTuples(array.values, of, column);
        column.close();
      }
      this->Reported.update(0.0); // asks whether to go on
    }
    this->Others.insert(attributes.others.begin(), attributes.others.end());
  }

  void addTuples(const ArrayView& values, ColumnOf of, ImportColumn& column)
  {
    const std::size_t size = sizeOf(values.type) * static_cast<std::size_t>(values.columns);
    const std::size_t tuples = std::max<std::size_t>((std::size_t(1) << 16) / size, 1);
    std::vector<std::byte> chunk(tuples * size);
    std::size_t used = 0;
    for (std::int64_t row = 0; row < values.rows; ++row)
    {
      if (of == ColumnOf::Elements && !this->isOwn(row))
      {
        continue;
      }
      values.copyRow(row, chunk.data() + used);
      used += size;
      if (used == chunk.size())
      {
        column.append(chunk);
        used = 0;
      }
    }
    column.append(std::span(chunk).first(used));
  }

  const MeshArrays& Mesh;
  const std::string& Name;
  RawMeshBuilder& Builder;
  Progress Reported;
  std::int64_t Cell = 0;            ///< the next one of all lists
  std::int64_t Ghosts = 0;          ///< cells that are left out
  std::vector<std::int64_t> Points; ///< of a cell
  std::set<std::string> Others, Repeated;
};

} // namespace

RawMesh importArrays(const MeshArrays& mesh, const std::string& name, CellChoice choice,
  Workspace& workspace, const ProgressFunction& progress)
{
  RawMeshBuilder builder(workspace, choice);
  if (!mesh.groups.empty())
  {
    builder.setGroups(mesh.groups);
  }
  MeshArraysImport(mesh, name, builder, progress).run();
  if (builder.cells() == 0)
  {
    throw Error(name + " has no " +
                (choice == CellChoice::Only         ? "triangles and no tetrahedra"
                  : choice == CellChoice::Triangles ? "triangles"
                                                    : "tetrahedra") +
                '.');
  }
  try
  {
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(name + ": " + error.what() + '.');
  }
}

} // namespace smg
