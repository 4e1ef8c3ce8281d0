// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

namespace smg::testing
{

/** The mesh of an original file, from which a mesh stream is made: polygons or tetrahedra, isolated
 * vertices among the others, and numbers of elements that are not cells. */
struct MeshOfFile
{
  CellType cellType = CellType::Triangle;
  bool doublePositions = true;
  std::vector<double> points;
  std::vector<std::vector<std::int64_t>> cells;
  std::vector<std::int64_t> numbers; ///< OriginalCellId of each cell, ascending
  std::vector<Column> vertexColumns; ///< a tuple per point
  std::vector<Column> cellColumns;   ///< a tuple per cell

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->points.size() / 3); }
};

/** A triangle or tetrahedron of a cell. */
struct Part
{
  std::size_t cell;
  std::vector<std::int64_t> corners;
};

inline std::vector<Part> partsOf(const MeshOfFile& mesh, std::uint64_t seed)
{
  std::vector<Part> parts;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    const std::vector<std::int64_t>& cell = mesh.cells[c];
    if (mesh.cellType == CellType::Tetrahedron)
    {
      parts.push_back({ c, cell });
      continue;
    }
    for (std::size_t i = 2; i < cell.size(); ++i)
    {
      parts.push_back({ c, { cell[0], cell[i - 1], cell[i] } });
    }
  }
  Random random(seed);
  for (std::size_t i = parts.size(); i > 1; --i)
  {
    std::swap(parts[i - 1], parts[std::size_t(random.below(std::int64_t(i)))]);
  }
  return parts;
}

/** The tuples `rows` of each column, in the rows' order. */
template <class Rows>
std::vector<Column> gathered(const std::vector<Column>& columns, const Rows& rows)
{
  std::vector<Column> result;
  for (const Column& column : columns)
  {
    Column& some = result.emplace_back(Column{ column.spec, {} });
    const auto bytes = static_cast<std::ptrdiff_t>(column.spec.tupleBytes());
    for (const auto row : rows)
    {
      const auto tuple = column.bytes.begin() + static_cast<std::ptrdiff_t>(row) * bytes;
      some.bytes.insert(some.bytes.end(), tuple, tuple + bytes);
    }
  }
  return result;
}

inline Column numbersColumn(const char* name, const std::vector<std::int64_t>& numbers)
{
  const auto bytes = std::as_bytes(std::span(numbers));
  return { { name, ScalarType::Int64, 1 }, { bytes.begin(), bytes.end() } };
}

inline std::vector<double> positionsOf(const MeshOfFile& mesh, const std::vector<std::int64_t>& ids)
{
  std::vector<double> positions;
  for (const std::int64_t id : ids)
  {
    positions.insert(
      positions.end(), mesh.points.begin() + 3 * id, mesh.points.begin() + 3 * id + 3);
  }
  return positions;
}

inline void fillColumns(std::vector<Column>& columns, std::size_t tuples, Random& random)
{
  for (Column& column : columns)
  {
    column.resize(tuples);
    dispatch(column.spec.type,
      [&]<class T>(T)
      {
        for (T& value : column.as<T>())
        {
          value = static_cast<T>(random.uniform(0, 100));
        }
      });
  }
}

/** Random points; random polygons of up to `maxCorners` corners, or tetrahedra. */
inline MeshOfFile randomMeshOfFile(
  CellType cellType, int maxCorners, bool doublePositions, std::uint64_t seed = 1)
{
  Random random(seed);
  MeshOfFile mesh;
  mesh.cellType = cellType;
  mesh.doublePositions = doublePositions;
  constexpr std::int64_t vertices = 300;
  for (std::int64_t i = 0; i < 3 * vertices; ++i)
  {
    // Of very different sizes, so that all digits count.
    const double x = random.uniform(-1, 1) * std::array{ 1.0, 1e-7, 1e9 }[std::size_t(i % 3)];
    mesh.points.push_back(doublePositions ? x : static_cast<float>(x));
  }
  std::int64_t number = 0;
  for (int c = 0; c < 200; ++c)
  {
    const auto size = cellType == CellType::Tetrahedron
                        ? std::size_t(4)
                        : std::size_t(3 + random.below(maxCorners - 2));
    std::set<std::int64_t> used;
    std::vector<std::int64_t> cell;
    while (cell.size() < size)
    {
      // Some vertices, the first and the last among them, belong to no cell.
      const std::int64_t corner = 5 + random.below(vertices - 10);
      if (corner % 10 != 0 && used.insert(corner).second)
      {
        cell.push_back(corner);
      }
    }
    mesh.cells.push_back(cell);
    mesh.numbers.push_back(number += 1 + random.below(3));
  }
  mesh.vertexColumns = { { { "Normals", ScalarType::Float32, 3 }, {} },
    { { "Colors", ScalarType::UInt8, 4 }, {} }, { { "height", ScalarType::Float64, 1 }, {} },
    { { "label", ScalarType::Int64, 1 }, {} } };
  mesh.cellColumns = { { { "group", ScalarType::Int32, 1 }, {} },
    { { "Colors", ScalarType::UInt8, 3 }, {} } };
  fillColumns(mesh.vertexColumns, vertices, random);
  fillColumns(mesh.cellColumns, mesh.cells.size(), random);
  return mesh;
}

/** Writes the mesh like a conversion: polygons as fans, cells in a random order, vertices by first
 * use, isolated ones separate from the stream. */
inline void writeVsmOf(
  const MeshOfFile& mesh, const std::filesystem::path& path, std::uint64_t seed = 1)
{
  MeshBlock block;
  std::vector<std::int64_t> place(std::size_t(mesh.vertices()), -1), ids, numbers, isolated;
  std::vector<std::size_t> cells;
  for (const Part& part : partsOf(mesh, seed))
  {
    for (const std::int64_t corner : part.corners)
    {
      std::int64_t& known = place[std::size_t(corner)];
      if (known < 0)
      {
        known = std::int64_t(ids.size());
        ids.push_back(corner);
      }
      block.corners.push_back(known);
    }
    cells.push_back(part.cell);
    numbers.push_back(mesh.numbers[part.cell]);
  }
  for (std::int64_t v = mesh.vertices() - 1; v >= 0; --v)
  {
    if (place[std::size_t(v)] < 0)
    {
      isolated.push_back(v);
    }
  }
  block.positions = positionsOf(mesh, ids);
  block.vertexColumns = gathered(mesh.vertexColumns, ids);
  block.vertexColumns.insert(block.vertexColumns.begin(), numbersColumn("OriginalId", ids));
  block.cellColumns = gathered(mesh.cellColumns, cells);
  block.cellColumns.push_back(numbersColumn("OriginalCellId", numbers));
  Column flags{ { CellFlagsName, ScalarType::UInt8, 1 }, {} };
  flags.resize(cells.size());
  block.cellColumns.push_back(std::move(flags));

  StreamInfo info;
  info.cellType = mesh.cellType;
  info.doublePositions = mesh.doublePositions;
  for (const Column& column : block.vertexColumns)
  {
    info.vertexColumns.push_back(column.spec);
  }
  for (const Column& column : block.cellColumns)
  {
    info.cellColumns.push_back(column.spec);
  }
  VsmWriter writer(path, info);
  std::vector<Column> columns = gathered(mesh.vertexColumns, isolated);
  columns.insert(columns.begin(), numbersColumn("OriginalId", isolated));
  writer.isolated(isolated, positionsOf(mesh, isolated), columns);
  writer.append(block);
  writer.finish();
}

} // namespace smg::testing
