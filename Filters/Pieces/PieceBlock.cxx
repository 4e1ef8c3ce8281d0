// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/PieceBlock.h"

#include "IO/Mesh/Columns.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Mesh/AddedColumn.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace smg
{
namespace
{

constexpr const char* Piece = "The input";

/** The columns of these names, with all tuples. */
std::vector<Column> columnsOf(vtkDataSetAttributes& arrays, const std::set<std::string>& names)
{
  std::vector<ColumnSpec> specs = columnSpecs(arrays);
  std::erase_if(specs, [&names](const ColumnSpec& spec) { return !names.contains(spec.name); });
  std::vector<Column> columns = emptyColumns(specs);
  std::vector<std::int64_t> rows(static_cast<std::size_t>(arrays.GetNumberOfTuples()));
  std::iota(rows.begin(), rows.end(), 0);
  for (Column& column : columns)
  {
    copyColumn(arrays, rows, Piece, column);
  }
  return columns;
}

std::vector<ColumnSpec> specsOf(const std::vector<Column>& columns)
{
  std::vector<ColumnSpec> specs;
  for (const Column& column : columns)
  {
    specs.push_back(column.spec);
  }
  return specs;
}

/** A column with the ids of the points for error messages, if the mesh has no original ids. */
Column numbersOf(vtkPointSet& piece)
{
  const std::vector<std::int64_t> ids = globalIdsOf(piece, Piece);
  Column column{ OriginalIdSpec, {} };
  column.resize(ids.size());
  std::ranges::copy(ids, column.as<std::int64_t>().begin());
  return column;
}

} // namespace

PieceBlock::PieceBlock(vtkPointSet& piece, std::set<std::string> names)
{
  names.insert({ CellFlagsName, OriginalIdName, OriginalCellIdName });
  const vtkIdType points = piece.GetNumberOfPoints();
  this->Block.positions.resize(3 * static_cast<std::size_t>(points));
  for (vtkIdType i = 0; i < points; ++i)
  {
    piece.GetPoint(i, this->Block.positions.data() + 3 * i);
  }
  this->Info.cellType = cellTypeOf(piece, Piece);
  this->Block.corners = cellCorners(piece, this->Info.cellType, Piece);
  this->Block.vertexColumns = columnsOf(*piece.GetPointData(), names);
  this->Block.cellColumns = columnsOf(*piece.GetCellData(), names);
  if (piece.GetPointData()->GetGlobalIds() &&
      findColumn(this->Block.vertexColumns, OriginalIdSpec) < 0)
  {
    this->Block.vertexColumns.push_back(numbersOf(piece));
  }
  this->Block.finalized = points;

  this->Info.vertices = points;
  this->Info.cells = piece.GetNumberOfCells();
  this->Info.doublePositions = piece.GetPoints()->GetDataType() != VTK_FLOAT;
  piece.GetBounds(this->Info.bounds.data());
  this->Info.vertexColumns = specsOf(this->Block.vertexColumns);
  this->Info.cellColumns = specsOf(this->Block.cellColumns);
  this->Info.groups = groupsIn(piece);
}

std::unique_ptr<MeshSource> PieceBlock::source() const
{
  return std::make_unique<OneBlockSource>(this->Info, this->Block);
}

} // namespace smg
