// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/ImportArrays.h"

#include "IO/Import/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"

#include <array>
#include <string>

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
  if (points.type == ScalarType::Float32)
  {
    builder.useSinglePrecision();
  }
  Progress reported(progress);
  std::int64_t vertex = 0;
  try
  {
    forEachRow(points, reported, 0.0, 0.5,
      [&](std::int64_t row)
      {
        vertex = row;
        builder.vertex(
          points.value<double>(row, 0), points.value<double>(row, 1), points.value<double>(row, 2));
      });
  }
  catch (const MeshError& error)
  {
    throw ArgumentError(inRow("points", vertex) + error.what() + '.');
  }
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

} // namespace smg
