// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceStream.h"

#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceInput.h"
#include "Solver/Core/Workers.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace smg
{
namespace
{

std::int64_t tupleBytes(const std::vector<ColumnSpec>& columns)
{
  std::int64_t bytes = 0;
  for (const ColumnSpec& column : columns)
  {
    bytes += column.components * static_cast<std::int64_t>(sizeOf(column.type));
  }
  return bytes;
}

/** Bytes of a point and of a cell in VTK data objects, as setPiece() makes them. */
std::int64_t bytesOfPoint(const StreamInfo& info)
{
  constexpr std::int64_t IdBytes = 8, MarkBytes = 2;
  return 3 * (info.doublePositions ? 8 : 4) + IdBytes + MarkBytes + tupleBytes(info.vertexColumns);
}
std::int64_t bytesOfCell(const StreamInfo& info)
{
  constexpr std::int64_t IdBytes = 8, OffsetBytes = 8, TypeBytes = 1;
  return OffsetBytes + TypeBytes + IdBytes * cornersOf(info.cellType) +
         tupleBytes(info.cellColumns);
}

/** The number of pieces of at most so many bytes. */
std::int64_t piecesOf(const StreamInfo& info, std::int64_t pieceBytes)
{
  const std::int64_t pointBytes = bytesOfPoint(info), cellBytes = bytesOfCell(info);
  // Besides its own points a piece has those that are alive at its first cell.
  const std::int64_t ownBytes =
    std::max(pieceBytes - pointBytes * std::max<std::int64_t>(0, info.width), pieceBytes / 2 + 1);
  return (info.vertices * pointBytes + info.cells * cellBytes) / ownBytes + 1;
}

/** About the bytes of a layer of ghost cells: at both ends of a piece, a point for each that is
 * alive there, with half of the cells around it. */
std::int64_t layerBytes(const StreamInfo& info)
{
  const std::int64_t cellsOfPoint = info.cellType == CellType::Triangle ? 3 : 12;
  return 2 * std::max<std::int64_t>(1, info.width) *
         (bytesOfPoint(info) + cellsOfPoint * bytesOfCell(info));
}

} // namespace

PieceCount PieceCount::within(int given, std::int64_t memoryLimit)
{
  // Reader, filters and the mesh stream copy a piece several times.
  constexpr std::int64_t Copies = 16;
  return { .given = given, .pieceBytes = std::max<std::int64_t>(1, memoryLimit / Copies) };
}

int PieceCount::first(PieceInput& input) const
{
  if (this->given > 0)
  {
    return this->given;
  }
  const std::optional<StreamInfo> info = input.meshInfo();
  if (!info)
  {
    return Usual;
  }
  return static_cast<int>(
    std::clamp<std::int64_t>(piecesOf(*info, this->pieceBytes), this->least, Most));
}

int PieceCount::ghostLevels(PieceInput& input, int pieces) const
{
  const int wanted = input.ghostLevels(pieces);
  const std::optional<StreamInfo> info = wanted > 0 ? input.meshInfo() : std::nullopt;
  return info && layerBytes(*info) <= this->pieceBytes / 2 / wanted ? wanted : 0;
}

int PieceCount::enough(int pieces, vtkDataObject& piece) const
{
  if (this->given > 0)
  {
    return this->given;
  }
  constexpr double Kibibyte = 1024;
  const double bytes = Kibibyte * static_cast<double>(piece.GetActualMemorySize());
  const double wanted = pieces * bytes / static_cast<double>(this->pieceBytes) + 1.0;
  return static_cast<int>(std::clamp(wanted, double(this->least), double(Most)));
}

namespace
{

bool isDuplicate(vtkUnsignedCharArray* ghosts, vtkIdType i)
{
  return ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT);
}

} // namespace

PieceStream::PieceStream(PieceInput& input, const PieceCount& pieces, PieceColumns columns)
  : Input(input)
  , Pieces(pieces.first(input))
  , Columns(std::move(columns))
  , IsFiltered(input.isFiltered())
  , GhostLevels(pieces.ghostLevels(input, this->Pieces))
{
  if (pieces.given == 0)
  {
    input.hidePieces();
  }
  this->First = this->pull();
  if (const int enough = this->First ? pieces.enough(this->Pieces, *this->First) : 0;
      enough > this->Pieces)
  {
    this->Input.release();
    this->Pieces = enough;
    this->GhostLevels = pieces.ghostLevels(input, enough);
    this->NextPiece = 0;
    this->First = this->pull();
  }
  if (!this->First)
  {
    throw Error(
      "The input has no cells: look at what " + this->Input.producerName() + " delivers.");
  }
  this->learn(*this->First);
}

std::string PieceStream::where() const
{
  return this->Input.placeOfPiece(this->NextPiece - 1, this->Pieces);
}

vtkPointSet* PieceStream::pull()
{
  while (this->NextPiece < this->Pieces)
  {
    vtkDataObject* data =
      this->Input.update(this->NextPiece++, this->Pieces, true, this->GhostLevels);
    vtkPointSet* piece = vtkPointSet::SafeDownCast(data);
    if (!piece)
    {
      throw Error(this->where() + " is a " + data->GetClassName() +
                  ": a vtkPolyData or vtkUnstructuredGrid is needed.");
    }
    if (isPreview(*piece))
    {
      throw Error(this->where() + " is a preview of the mesh, not the mesh itself: take away the "
                                  "Streaming Mesh Preview, or whatever else does not pass "
                                  "streaming requests on, between the reader and this filter.");
    }
    if (piece->GetNumberOfPoints() > 0 || piece->GetNumberOfCells() > 0)
    {
      return piece;
    }
    this->Input.release();
  }
  return nullptr;
}

void PieceStream::learn(vtkPointSet& piece)
{
  this->Info.cellType = cellTypeOf(piece, this->where());
  this->Info.doublePositions = piece.GetPoints() && piece.GetPoints()->GetDataType() != VTK_FLOAT;
  this->Info.vertexColumns = columnSpecs(*piece.GetPointData());
  this->Info.cellColumns = columnSpecs(*piece.GetCellData());
  this->Info.groups = groupsIn(piece);
  const auto isForeign = [this](const ColumnSpec& spec, bool ofVertices)
  {
    return isGroupColumn(spec.name) &&
           (this->Info.groups.empty() ||
             !MeshGroups::isOfMesh(spec, ofVertices, cornersOf(this->Info.cellType)));
  };
  std::erase_if(
    this->Info.vertexColumns, [&](const ColumnSpec& spec) { return isForeign(spec, true); });
  std::erase_if(
    this->Info.cellColumns, [&](const ColumnSpec& spec) { return isForeign(spec, false); });
  if (this->Columns.all)
  {
    return;
  }
  requireArrays(piece, this->Columns.required);
  const auto isUnwanted = [this](const ColumnSpec& spec)
  {
    return !this->Columns.required.contains(spec.name) &&
           !this->Columns.optional.contains(spec.name);
  };
  std::erase_if(this->Info.vertexColumns, isUnwanted);
  std::erase_if(this->Info.cellColumns, isUnwanted);
}

bool PieceStream::next(MeshBlock& block)
{
  if (!this->nextPiece(block))
  {
    return false;
  }
  this->Input.release();
  this->IsHeld = false;
  return true;
}

vtkPointSet* PieceStream::nextPiece(MeshBlock& block)
{
  if (this->IsHeld)
  {
    this->Input.release();
  }
  vtkPointSet* piece = this->First ? this->First : this->pull();
  this->First = nullptr;
  this->IsHeld = piece != nullptr;
  if (piece)
  {
    this->convert(*piece, block);
  }
  if (this->NextPiece == this->Pieces)
  {
    this->checkEnd();
  }
  return piece;
}

void PieceStream::convert(vtkPointSet& piece, MeshBlock& block)
{
  const std::vector<std::int64_t> ids = globalIdsOf(piece, this->where());
  const std::vector<std::int64_t> own = this->ownPoints(piece, ids);
  block.firstVertex = this->Vertices;
  block.firstCell = this->Cells;
  this->copyPoints(piece, own, block);
  this->Vertices += static_cast<std::int64_t>(own.size());
  this->copyCells(piece, ids, block);
  this->useCorners(block.corners);
  this->Cells += static_cast<std::int64_t>(block.corners.size() / cornersOf(this->Info.cellType));
  this->noteFinalized(piece, ids);
  const auto isFinal = [this](std::int64_t id)
  { return id < this->Finalized || this->IsFinal[static_cast<std::size_t>(id - this->Finalized)]; };
  if (this->Pieces > 1 && this->IsFiltered &&
      this->Shared.add(piece, ids, block, isFinal, this->where()))
  {
    this->Input.noteDifference();
  }
  block.finalized = this->NextPiece == this->Pieces ? this->Vertices : this->Finalized;
}

std::vector<std::int64_t> PieceStream::ownPoints(
  vtkPointSet& piece, const std::vector<std::int64_t>& ids) const
{
  vtkUnsignedCharArray* ghosts = piece.GetPointGhostArray();
  std::vector<std::int64_t> own;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (!isDuplicate(ghosts, static_cast<vtkIdType>(i)))
    {
      own.push_back(static_cast<std::int64_t>(i));
    }
  }
  std::sort(
    own.begin(), own.end(), [&ids](std::int64_t a, std::int64_t b) { return ids[a] < ids[b]; });
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    const std::int64_t expected = this->Vertices + static_cast<std::int64_t>(k);
    const std::int64_t id = ids[own[k]];
    if (id < expected && id >= 0)
    {
      throw Error(
        this->where() + " owns the point with GlobalId " + std::to_string(id) +
        " once more: the input gives the same data for every piece (then set Number Of Pieces to "
        "1) or does not mark points that an earlier piece owns in vtkGhostType.");
    }
    if (id != expected)
    {
      throw Error(this->where() + " has the GlobalId " + std::to_string(id) + " where " +
                  std::to_string(expected) +
                  " comes next: GlobalIds must number the points in the order of their first use. "
                  "Behind a filter that takes points or cells away, raise Maximum Points In Memory "
                  "of the reader, so that it shows the mesh as a whole.");
    }
  }
  // Points of ghost cells alone may be those of a later piece.
  const bool hasGhostCells = piece.GetCellGhostArray() != nullptr;
  for (std::size_t i = 0; i < ids.size() && !hasGhostCells; ++i)
  {
    this->requireOwned(ids[i], this->Vertices + static_cast<std::int64_t>(own.size()));
  }
  return own;
}

void PieceStream::requireOwned(std::int64_t id, std::int64_t end) const
{
  if (id < 0 || id >= end)
  {
    throw Error(this->where() + " marks the point with GlobalId " + std::to_string(id) +
                " as a duplicate, but no earlier piece owns it.");
  }
}

void PieceStream::copyPoints(
  vtkPointSet& piece, const std::vector<std::int64_t>& own, MeshBlock& block) const
{
  block.positions.resize(3 * own.size());
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    double* point = block.positions.data() + 3 * k;
    piece.GetPoint(own[k], point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw Error(this->where() + " has a coordinate that is not a finite number at the GlobalId " +
                  std::to_string(this->Vertices + static_cast<std::int64_t>(k)) + ".");
    }
  }
  block.vertexColumns = emptyColumns(this->Info.vertexColumns);
  for (Column& column : block.vertexColumns)
  {
    copyColumn(*piece.GetPointData(), own, this->where(), column);
  }
}

void PieceStream::copyCells(
  vtkPointSet& piece, const std::vector<std::int64_t>& ids, MeshBlock& block) const
{
  block.corners = cellCorners(piece, this->Info.cellType, this->where());
  for (std::int64_t& corner : block.corners)
  {
    if (corner < 0 || corner >= static_cast<std::int64_t>(ids.size()))
    {
      throw Error(this->where() + " has a cell with the point " + std::to_string(corner) +
                  ", which does not exist.");
    }
    corner = ids[corner];
  }
  const std::vector<std::int64_t> kept =
    keepOwnCells(piece, cornersOf(this->Info.cellType), block.corners);
  for (const std::int64_t corner : block.corners)
  {
    this->requireOwned(corner, this->Vertices);
  }
  block.cellColumns = emptyColumns(this->Info.cellColumns);
  for (Column& column : block.cellColumns)
  {
    copyColumn(*piece.GetCellData(), kept, this->where(), column);
  }
}

void PieceStream::useCorners(const std::vector<std::int64_t>& corners)
{
  for (const std::int64_t corner : corners)
  {
    if (corner > this->Used)
    {
      throw Error(this->where() + " has a cell that uses the point with GlobalId " +
                  std::to_string(corner) + " before any cell uses that with GlobalId " +
                  std::to_string(this->Used) +
                  ": number the points in the order in which cells use them first, or write the "
                  "mesh to a file and read that with the Streaming Mesh Reader.");
    }
    if (corner < this->Finalized)
    {
      throw Error(this->where() + " has a cell that uses the point with GlobalId " +
                  std::to_string(corner) +
                  ", which an earlier piece calls final in StreamFinalized: correct or take away "
                  "that array.");
    }
    this->Used = std::max(this->Used, corner + 1);
  }
}

void PieceStream::checkEnd() const
{
  if (this->Used < this->Vertices)
  {
    throw Error("The point with GlobalId " + std::to_string(this->Used) +
                " of the input belongs to no cell: take such points away, or write the mesh to a "
                "file and read that with the Streaming Mesh Reader.");
  }
}

void PieceStream::noteFinalized(vtkPointSet& piece, const std::vector<std::int64_t>& ids)
{
  this->IsFinal.resize(this->Vertices - this->Finalized, 0);
  // The array is optional: without it, no vertex is known to be final before the end.
  if (vtkDataArray* finalized = piece.GetPointData()->GetArray(StreamFinalizedName))
  {
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      if (ids[i] >= this->Finalized && ids[i] < this->Vertices &&
          finalized->GetTuple1(static_cast<vtkIdType>(i)) != 0.0)
      {
        this->IsFinal[ids[i] - this->Finalized] = 1;
      }
    }
  }
  while (this->Finalized < this->Used && this->IsFinal.front())
  {
    this->IsFinal.pop_front();
    ++this->Finalized;
  }
}

vtkDataArray* globalIdArray(vtkPointSet& piece)
{
  vtkDataArray* attribute = piece.GetPointData()->GetGlobalIds();
  return attribute ? attribute : piece.GetPointData()->GetArray(GlobalIdsName);
}

std::vector<std::int64_t> globalIdsOf(vtkPointSet& piece, const std::string& where)
{
  vtkDataArray* array = globalIdArray(piece);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw Error(
      where +
      " has no point GlobalIds, so it is not a piece of a mesh stream: read the mesh with the "
      "Streaming Mesh Reader, which makes them, and keep them in the filters between, or "
      "raise Maximum Points In Memory of the reader, so that it shows the mesh as a whole; save a "
      "mesh of another source as .vsm first.");
  }
  return integersOf(*array);
}

StreamInfo writeContainer(PieceStream& stream, const std::filesystem::path& path, bool forScratch,
  Progress& progress, const std::filesystem::path& isolatedFrom, const std::string& fingerprint)
{
  Workers workers; // not worth their memory for fast compression
  VsmWriter writer(path, stream.info(),
    { .codec = forScratch ? Codec::Lz4 : Codec::Zstd,
      .scratch = std::filesystem::absolute(path).parent_path(),
      .workers = forScratch ? nullptr : &workers });
  MeshBlock block;
  while (stream.next(block))
  {
    writer.append(block);
    progress.update(stream.fraction());
  }
  if (!isolatedFrom.empty())
  {
    copyIsolated(isolatedFrom, stream.info(), writer, {}, fingerprint);
  }
  return writer.finish();
}

} // namespace smg
