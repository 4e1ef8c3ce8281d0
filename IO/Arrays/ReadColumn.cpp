// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/ReadColumn.h"

#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Rounded.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

/** Rows of a table of numbers. */
class Rows
{
public:
  Rows(std::byte* values, const ColumnSpec& column)
    : Values(values)
    , Spec(column)
  {
  }

  const ColumnSpec& spec() const { return this->Spec; }
  std::byte* row(std::int64_t row) const
  {
    return this->Values + row * static_cast<std::int64_t>(this->Spec.tupleBytes());
  }
  void put(std::int64_t row, const std::byte* tuple) const
  {
    std::memcpy(this->row(row), tuple, this->Spec.tupleBytes());
  }
  /** Sets all components of a row to a number. */
  void fill(std::int64_t row, double value) const
  {
    dispatch(this->Spec.type,
      [&]<class T>(T)
      {
        const T number = static_cast<T>(value);
        for (int k = 0; k < this->Spec.components; ++k)
        {
          std::memcpy(this->row(row) + static_cast<std::size_t>(k) * sizeof(T), &number, sizeof(T));
        }
      });
  }
  void fillAll(std::int64_t count) const
  {
    const bool isFloat = isReal(this->Spec.type);
    for (std::int64_t k = 0; k < count; ++k)
    {
      this->fill(k, isFloat ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    }
  }

private:
  std::byte* Values;
  ColumnSpec Spec;
};

/** A column and, unless it is that, the one that says the rows. */
std::vector<std::string> withNumbers(std::vector<std::string> names, const OriginalRows& rows)
{
  if (!rows.column.empty() && std::ranges::find(names, rows.column) == names.end())
  {
    names.push_back(rows.column);
  }
  return names;
}

/** The tuples of a column of vertices, or their positions; null: they do not have it. */
const std::byte* tuplesOf(const ColumnSpec& column, const std::vector<double>& positions,
  const std::vector<Column>& columns)
{
  if (column == PositionSpec)
  {
    return reinterpret_cast<const std::byte*>(positions.data());
  }
  const std::ptrdiff_t place = findColumn(columns, column);
  return place < 0 ? nullptr : columns[static_cast<std::size_t>(place)].bytes.data();
}

/** Reads the rows of vertices of no cell, and fills all others. */
void readIsolated(
  const StoredMesh& mesh, const OriginalOrder& order, const AddedColumns* added, const Rows& rows)
{
  rows.fillAll(order.vertices().count);
  forEachIsolated(mesh.file(), mesh.fileFingerprint(),
    [&](std::int64_t first, IsolatedVertices& vertices)
    {
      if (added)
      {
        added->completeIsolated(first, vertices);
      }
      const ColumnSpec& column = rows.spec();
      const std::byte* const tuples = tuplesOf(column, vertices.positions, vertices.columns);
      for (std::size_t i = 0; i < vertices.ids.size(); ++i)
      {
        const std::int64_t row =
          order.isolatedRow(first + static_cast<std::int64_t>(i), vertices.ids[i]);
        if (column.isolated)
        {
          rows.fill(row, *column.isolated);
        }
        else if (tuples)
        {
          rows.put(row, tuples + i * column.tupleBytes());
        }
      }
    });
}

void readVertices(const StoredMesh& mesh, const OriginalRows& places, const Rows& rows,
  const ProgressFunction& progress)
{
  const ColumnSpec& column = rows.spec();
  std::vector<std::string> names;
  if (column != PositionSpec)
  {
    names.push_back(column.name);
  }
  const auto source = mesh.source(withNumbers(std::move(names), places), {});
  visitBlocks(*source, progress, 0.0, 1.0,
    [&](const MeshBlock& block)
    {
      const Column* const numbers = places.numbersIn(block.vertexColumns);
      const std::byte* const tuples = tuplesOf(column, block.positions, block.vertexColumns);
      for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
      {
        rows.put(places.row(block.firstVertex, numbers, i), tuples + i * column.tupleBytes());
      }
    });
}

void readCells(const StoredMesh& mesh, const OriginalOrder& order, const Rows& rows,
  const ProgressFunction& progress)
{
  const OriginalRows& places = order.cells();
  const std::size_t size = rows.spec().tupleBytes();
  const auto source = mesh.source({}, withNumbers({ rows.spec().name }, places));
  visitBlocks(*source, progress, 0.0, 1.0,
    [&](const MeshBlock& block)
    {
      const Column* const numbers = places.numbersIn(block.cellColumns);
      const Column& column = block.cellColumns.front();
      for (std::size_t i = 0; i < column.tuples(); ++i)
      {
        rows.put(places.row(block.firstCell, numbers, i), column.bytes.data() + i * size);
      }
    });
}

void readCorners(const StoredMesh& mesh, const OriginalOrder& order, const Rows& rows,
  const ProgressFunction& progress)
{
  const OriginalRows& vertices = order.vertices();
  const OriginalRows& cells = order.cells();
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.info().cellType));
  std::vector<std::int64_t> rowsOfVertices;
  rowsOfVertices.reserve(static_cast<std::size_t>(mesh.info().vertices));
  const auto source = mesh.source(vertices.columns(), cells.columns());
  visitBlocks(*source, progress, 0.0, 1.0,
    [&](const MeshBlock& block)
    {
      vertices.append(block, rowsOfVertices);
      const Column* const cellNumbers = cells.numbersIn(block.cellColumns);
      std::array<std::int64_t, 4> tuple{};
      for (std::size_t i = 0; i < block.corners.size() / corners; ++i)
      {
        for (std::size_t k = 0; k < corners; ++k)
        {
          tuple[k] = rowsOfVertices[static_cast<std::size_t>(block.corners[i * corners + k])];
        }
        rows.put(cells.row(block.firstCell, cellNumbers, i),
          reinterpret_cast<const std::byte*>(tuple.data()));
      }
    });
}

} // namespace

ColumnSpec columnOf(const StreamInfo& mesh, bool ofCells, const std::string& name)
{
  if (!ofCells && name == PositionSpec.name)
  {
    return PositionSpec;
  }
  if (ofCells && name == CornersName)
  {
    return { CornersName, ScalarType::Int64, cornersOf(mesh.cellType) };
  }
  const std::vector<ColumnSpec>& specs = ofCells ? mesh.cellColumns : mesh.vertexColumns;
  const auto found = std::ranges::find(specs, name, &ColumnSpec::name);
  if (found == specs.end())
  {
    throw ArgumentError(
      '\'' + name + "': the " + (ofCells ? "cells" : "vertices") + " have no column of this name.");
  }
  return *found;
}

void readColumn(const StoredMesh& mesh, const OriginalOrder& order, const AddedColumns* added,
  bool ofCells, const std::string& name, std::byte* values, const ProgressFunction& progress)
{
  const Rows rows(values, columnOf(mesh.info(), ofCells, name));
  if (!ofCells)
  {
    readIsolated(mesh, order, added, rows);
    readVertices(mesh, order.vertices(), rows, progress);
  }
  else if (name == CornersName)
  {
    readCorners(mesh, order, rows, progress);
  }
  else
  {
    readCells(mesh, order, rows, progress);
  }
}

void readSolution(const StoredMesh& mesh, const OriginalOrder& order, const AddedColumns* added,
  Solution& solution, int first, const ColumnSpec& column, std::byte* values,
  const ProgressFunction& progress)
{
  const OriginalRows& places = order.vertices();
  const Rows rows(values, column);
  readIsolated(mesh, order, added, rows);
  const bool isRounded = column == PositionSpec && !mesh.info().doublePositions;
  const auto stride = static_cast<std::size_t>(solution.columns());
  const auto components = static_cast<std::size_t>(column.components);
  std::vector<double> numbers;
  const auto source = mesh.source(places.columns(), {});
  visitBlocks(*source, progress, 0.0, 1.0,
    [&](const MeshBlock& block)
    {
      const auto vertices = static_cast<std::size_t>(block.vertices());
      numbers.resize(vertices * stride);
      solution.read(block.firstVertex, block.vertices(), numbers);
      for (double& number : std::span(numbers).first(isRounded ? numbers.size() : 0))
      {
        number = static_cast<float>(number);
      }
      const Column* const ids = places.numbersIn(block.vertexColumns);
      dispatch(column.type,
        [&]<class T>(T)
        {
          for (std::size_t i = 0; i < vertices; ++i)
          {
            std::byte* const to = rows.row(places.row(block.firstVertex, ids, i));
            for (std::size_t k = 0; k < components; ++k)
            {
              const T number =
                rounded<T>(numbers[i * stride + static_cast<std::size_t>(first) + k]);
              std::memcpy(to + k * sizeof(T), &number, sizeof(T));
            }
          }
        });
    });
  fillMerged(order, column, values);
}

void fillMerged(const OriginalOrder& order, const ColumnSpec& column, std::byte* values)
{
  const Rows rows(values, column);
  for (const MergedRow& merged : order.merged())
  {
    rows.put(merged.row, rows.row(merged.kept));
  }
}

} // namespace smg
