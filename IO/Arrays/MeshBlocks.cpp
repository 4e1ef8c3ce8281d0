// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/MeshBlocks.h"

#include "IO/Arrays/ReadColumn.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace smg
{

MeshBlocks::MeshBlocks(const std::filesystem::path& file,
  std::shared_ptr<const OriginalOrder> order, std::shared_ptr<const AddedColumns> added,
  const MeshBlocksOptions& options)
  : Reader(file, nullptr, options.fingerprint)
  , Order(std::move(order))
  , Added(std::move(added))
  , Points(options.points)
{
  if (this->Points < 4)
  {
    throw ArgumentError("points: a block has at least 4 points, so that it can have a cell.");
  }
  std::vector<std::string> ofVertices, ofCells;
  this->choose(false, options.vertexColumns, this->OfVertices, ofVertices);
  this->choose(true, options.cellColumns, this->OfCells, ofCells);
  this->Reader.selectColumns(ofVertices, ofCells);
  const StreamInfo& info = this->Reader.info();
  // A first guess, which the blocks that follow correct.
  const auto all = static_cast<double>(info.cells);
  const double cells =
    0.7 * static_cast<double>(this->Points) * all / static_cast<double>(info.vertices);
  this->Guess = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(cells, all)));
}

void MeshBlocks::choose(bool ofCells, const std::optional<std::vector<std::string>>& names,
  Part& part, std::vector<std::string>& stored)
{
  const StoredMesh& mesh =
    this->Added ? static_cast<const StoredMesh&>(*this->Added) : this->Reader;
  const StreamInfo& info = mesh.info();
  const std::string& numbers =
    ofCells ? this->Order->cells().column : this->Order->vertices().column;
  for (const std::string& name :
    names.value_or(columnNames(ofCells ? info.cellColumns : info.vertexColumns)))
  {
    columnOf(info, ofCells, name);
    const AddedColumns::Added* const found =
      this->Added ? this->Added->find(ofCells, name) : nullptr;
    if (found)
    {
      part.added.push_back(found);
    }
    else if (name != PositionSpec.name && name != CornersName &&
             std::ranges::find(stored, name) == stored.end())
    {
      stored.push_back(name);
    }
  }
  if (!numbers.empty() && std::ranges::find(stored, numbers) == stored.end())
  {
    stored.push_back(numbers);
  }
}

bool MeshBlocks::next()
{
  this->NextCell += this->CellCount;
  this->CellCount = std::min(this->Guess, this->Reader.info().cells - this->NextCell);
  this->read();
  return this->CellCount > 0;
}

/** Reads the next cells, fewer if they have too many vertices. */
void MeshBlocks::read()
{
  this->Reader.readPiece(this->NextCell, this->NextCell + this->CellCount, this->Piece);
  if (this->CellCount == 0)
  {
    return;
  }
  const auto fitting = [this]
  {
    const double cells = 0.9 * static_cast<double>(this->CellCount) *
                         static_cast<double>(this->Points) /
                         static_cast<double>(this->Piece.vertices());
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(cells));
  };
  while (this->Piece.vertices() > this->Points)
  {
    this->CellCount = std::min(fitting(), this->CellCount - 1);
    this->Reader.readPiece(this->NextCell, this->NextCell + this->CellCount, this->Piece);
  }
  this->Guess = fitting();
  this->complete(false, this->OfVertices);
  this->complete(true, this->OfCells);
}

void MeshBlocks::complete(bool ofCells, Part& part)
{
  const OriginalRows& places = ofCells ? this->Order->cells() : this->Order->vertices();
  const std::vector<Column>& columns =
    ofCells ? this->Piece.cellColumns : this->Piece.vertexColumns;
  const Column* const numbers = places.numbersIn(columns);
  const auto count = static_cast<std::size_t>(ofCells ? this->CellCount : this->Piece.vertices());
  part.rows.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int64_t index =
      ofCells ? this->Piece.firstCell + static_cast<std::int64_t>(i) : this->Piece.ids[i];
    part.rows[i] = numbers ? places.row(index, numbers, i) : places.row(index, nullptr, 0);
  }
  part.columns.resize(part.added.size());
  for (std::size_t k = 0; k < part.added.size(); ++k)
  {
    Column& column = part.columns[k];
    column.spec = part.added[k]->spec;
    column.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      part.added[k]->values.copyRow(
        part.rows[i], column.bytes.data() + i * column.spec.tupleBytes());
    }
  }
}

namespace
{

ArrayView viewOfValues(const void* data, ScalarType type, std::size_t rows, int columns)
{
  const auto size = static_cast<std::int64_t>(sizeOf(type));
  return { data, type, static_cast<std::int64_t>(rows), columns, size * columns, size };
}

} // namespace

ArrayView MeshBlocks::rows(bool ofCells) const
{
  const std::vector<std::int64_t>& rows = (ofCells ? this->OfCells : this->OfVertices).rows;
  return viewOfValues(rows.data(), ScalarType::Int64, rows.size(), 1);
}

ArrayView MeshBlocks::ghosts() const
{
  return viewOfValues(this->Piece.ghost.data(), ScalarType::UInt8, this->Piece.ghost.size(), 1);
}

ArrayView MeshBlocks::array(bool ofCells, const std::string& name) const
{
  const Part& part = ofCells ? this->OfCells : this->OfVertices;
  const MeshPiece& piece = this->Piece;
  if (!ofCells && name == PositionSpec.name)
  {
    return viewOfValues(piece.positions.data(), ScalarType::Float64, piece.positions.size() / 3, 3);
  }
  if (ofCells && name == CornersName)
  {
    const int corners = cornersOf(this->Reader.info().cellType);
    return viewOfValues(
      piece.corners.data(), ScalarType::Int64, static_cast<std::size_t>(this->CellCount), corners);
  }
  for (const std::vector<Column>* columns :
    { &part.columns, ofCells ? &piece.cellColumns : &piece.vertexColumns })
  {
    const auto found =
      std::ranges::find(*columns, name, [](const Column& column) { return column.spec.name; });
    if (found != columns->end())
    {
      return viewOfValues(
        found->bytes.data(), found->spec.type, found->tuples(), found->spec.components);
    }
  }
  throw ArgumentError('\'' + name + "': the " + (ofCells ? "cells" : "vertices") +
                      " of the block have no array of this name: choose it when the blocks are "
                      "opened.");
}

} // namespace smg
