// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/ProcessParts.h"

#include "Filters/Processes/StreamNumbers.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Error.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace smg
{

namespace
{

constexpr const char* Piece = "The input";

/** The first cell of a piece, with its points and arrays. */
vtkSmartPointer<vtkPointSet> firstCellOf(vtkPointSet& piece)
{
  const auto sample = vtkSmartPointer<vtkPointSet>::Take(piece.NewInstance());
  vtkNew<vtkIdList> corners;
  piece.GetCellPoints(0, corners);
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdList> ids;
  sample->GetPointData()->CopyAllOn();
  sample->GetPointData()->CopyAllocate(piece.GetPointData(), corners->GetNumberOfIds());
  for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
  {
    points->InsertNextPoint(piece.GetPoint(corners->GetId(k)));
    sample->GetPointData()->CopyData(piece.GetPointData(), corners->GetId(k), k);
    ids->InsertNextId(k);
  }
  sample->SetPoints(points);
  if (auto* surface = vtkPolyData::SafeDownCast(sample))
  {
    surface->AllocateEstimate(1, 3);
    surface->InsertNextCell(piece.GetCellType(0), ids);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(sample))
  {
    grid->Allocate(1);
    grid->InsertNextCell(piece.GetCellType(0), ids);
  }
  sample->GetCellData()->CopyAllOn();
  sample->GetCellData()->CopyAllocate(piece.GetCellData(), 1);
  sample->GetCellData()->CopyData(piece.GetCellData(), vtkIdType(0), vtkIdType(0));
  sample->GetFieldData()->ShallowCopy(piece.GetFieldData());
  return sample;
}

/** The specs of the arrays of these names. */
std::vector<ColumnSpec> specsOf(vtkDataSetAttributes& arrays, const std::set<std::string>& names)
{
  std::vector<ColumnSpec> specs = columnSpecs(arrays);
  std::erase_if(specs, [&names](const ColumnSpec& spec) { return !names.contains(spec.name); });
  return specs;
}

/** The tuples `rows` of the arrays; without rows, the arrays may be missing. */
std::vector<Column> columnsOf(vtkDataSetAttributes& arrays, const std::vector<ColumnSpec>& specs,
  const std::vector<std::int64_t>& rows)
{
  std::vector<Column> columns = emptyColumns(specs);
  for (Column& column : columns)
  {
    if (!rows.empty())
    {
      copyColumn(arrays, rows, Piece, column);
    }
  }
  return columns;
}

/** Throws Error if the points have no ids. */
void checkHasGlobalIds(vtkPointSet& piece)
{
  vtkDataArray* ids = globalIdArray(piece);
  if (!ids || ids->GetNumberOfComponents() != 1)
  {
    throw Error("The input has no point GlobalIds, by which the processes know their common "
                "points: apply the filter Generate Global Ids to it, after Redistribute DataSet if "
                "the mesh is in one process.");
  }
}

/** The box around the points of all processes. */
std::array<double, 6> boundsOf(vtkPointSet& piece, Team& team)
{
  constexpr double Far = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{ Far, Far, Far }, high{ -Far, -Far, -Far };
  if (piece.GetNumberOfPoints() > 0)
  {
    std::array<double, 6> box{};
    piece.GetBounds(box.data());
    low = { box[0], box[2], box[4] };
    high = { box[1], box[3], box[5] };
  }
  team.least(std::span<double>(low));
  team.largest(std::span<double>(high));
  return { low[0], high[0], low[1], high[1], low[2], high[2] };
}

/** Numbers the points as vertices of the part, and returns a point of each vertex. */
std::vector<std::int64_t> placePoints(const StreamNumbers& numbers, PiecePart& result)
{
  std::vector<std::int64_t> points(numbers.numbers.size());
  std::iota(points.begin(), points.end(), std::int64_t(0));
  const auto numberOf = [&numbers](std::int64_t point)
  { return numbers.numbers[static_cast<std::size_t>(point)]; };
  std::ranges::stable_sort(points, {}, numberOf);
  result.places.resize(points.size());
  std::vector<std::int64_t>& ids = result.part.ids;
  std::vector<std::int64_t> rows;
  for (const std::int64_t point : points)
  {
    if (ids.empty() || ids.back() != numberOf(point))
    {
      ids.push_back(numberOf(point));
      rows.push_back(point);
    }
    result.places[static_cast<std::size_t>(point)] = static_cast<std::int64_t>(ids.size()) - 1;
  }
  return rows;
}

} // namespace

vtkSmartPointer<vtkPointSet> sampleOf(
  vtkPointSet& piece, Team& team, vtkMultiProcessController& controller)
{
  const int isGrid = vtkUnstructuredGrid::SafeDownCast(&piece) ? 1 : 0;
  const std::vector<int> kinds =
    team.gather(std::vector<int>{ piece.GetNumberOfCells() > 0 ? isGrid : -1 });
  const auto first = std::ranges::find_if(kinds, [](int kind) { return kind >= 0; });
  if (first == kinds.end())
  {
    throw Error("The input has no cells in any process.");
  }
  const auto root = static_cast<int>(first - kinds.begin());
  vtkSmartPointer<vtkPointSet> sample;
  if (team.rank() == root)
  {
    sample = firstCellOf(piece);
  }
  else if (*first == 1)
  {
    sample = vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  else
  {
    sample = vtkSmartPointer<vtkPolyData>::New();
  }
  team.agree();
  if (team.size() > 1)
  {
    controller.Broadcast(sample, root);
  }
  return sample;
}

PiecePart partOfPiece(
  vtkPointSet& piece, vtkPointSet& sample, const std::set<std::string>& names, Team& team)
{
  PiecePart result;
  StreamInfo& info = result.part.info;
  MeshBlock& block = result.part.block;
  info.cellType = cellTypeOf(sample, Piece);
  info.bounds = boundsOf(piece, team);
  info.vertexColumns = specsOf(*sample.GetPointData(), names);
  info.cellColumns = specsOf(*sample.GetCellData(), names);

  block.corners = cellCorners(piece, info.cellType, Piece);
  const std::vector<std::int64_t> cells =
    keepOwnCells(piece, cornersOf(info.cellType), block.corners);
  std::vector<std::int64_t> ids;
  if (piece.GetNumberOfPoints() > 0)
  {
    checkHasGlobalIds(piece);
    ids = globalIdsOf(piece, Piece);
  }
  std::vector<char> isUsed(ids.size());
  for (const std::int64_t corner : block.corners)
  {
    isUsed.at(static_cast<std::size_t>(corner)) = 1;
  }
  const StreamNumbers numbers = numberPoints(team, ids, isUsed);
  const std::vector<std::int64_t> points = placePoints(numbers, result);
  for (std::int64_t& corner : block.corners)
  {
    corner = result.places[static_cast<std::size_t>(corner)];
  }
  block.positions.resize(3 * points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    piece.GetPoint(points[v], block.positions.data() + 3 * v);
  }
  block.vertexColumns = columnsOf(*piece.GetPointData(), info.vertexColumns, points);
  block.cellColumns = columnsOf(*piece.GetCellData(), info.cellColumns, cells);
  if (findColumn(block.vertexColumns, OriginalIdSpec) < 0)
  {
    // Messages name these, and problems refer to vertices by them.
    Column column{ OriginalIdSpec, {} };
    column.resize(points.size());
    std::ranges::transform(points, column.as<std::int64_t>().begin(),
      [&ids](std::int64_t point) { return ids[static_cast<std::size_t>(point)]; });
    info.vertexColumns.push_back(column.spec);
    block.vertexColumns.push_back(std::move(column));
  }

  const std::vector<std::int64_t> counts =
    team.gather(std::vector<std::int64_t>{ static_cast<std::int64_t>(cells.size()) });
  block.firstCell = std::accumulate(counts.begin(), counts.begin() + team.rank(), std::int64_t(0));
  info.cells = std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
  info.vertices = numbers.total;
  result.part.firstOwned = numbers.first;
  result.part.endOwned = numbers.end;
  return result;
}

namespace
{

MPI_Comm requiredCommunicator(vtkMultiProcessController* controller)
{
  const MPI_Comm communicator = communicatorOf(controller);
  if (communicator == MPI_COMM_NULL)
  {
    throw Error("The distributed engine needs processes that communicate by MPI: start pvbatch or "
                "pvserver with mpiexec, or choose the Engine Streaming.");
  }
  return communicator;
}

} // namespace

MPI_Comm communicatorOf(vtkMultiProcessController* controller)
{
  auto* communicator =
    controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
  vtkMPICommunicatorOpaqueComm* handle = communicator ? communicator->GetMPIComm() : nullptr;
  return handle ? *handle->GetHandle() : MPI_COMM_NULL;
}

ProcessParts::ProcessParts(
  vtkPointSet& piece, vtkMultiProcessController* controller, const Begin& begin)
  : Processes(requiredCommunicator(controller))
{
  this->Processes.run(
    [&]
    {
      if (isPreview(piece))
      {
        throw Error("The input is a preview of the mesh, but the distributed engine needs the "
                    "mesh: raise MaximumPointsInMemory of the reader, or choose the Engine "
                    "Streaming.");
      }
      const vtkSmartPointer<vtkPointSet> sample = sampleOf(piece, this->Processes, *controller);
      this->Piece = partOfPiece(piece, *sample, begin(*sample), this->Processes);
    });
  this->Solver.emplace(this->Processes.communicator(), this->Piece.part);
  this->Solver->checkCells();
}

void ProcessParts::requireSame(const std::string& what, const std::string& value)
{
  this->Processes.run([&] { this->Processes.requireSame(what, value); });
}

SolveSummary ProcessParts::summarize(Report& report, const std::vector<std::string>& notes,
  const std::vector<double>& values, int columns, std::vector<double>& atPoints)
{
  SolveSummary summary;
  this->Processes.run(
    [&]
    {
      atPoints.clear();
      atPoints.reserve(this->Piece.places.size() * static_cast<std::size_t>(columns));
      for (const std::int64_t vertex : this->Piece.places)
      {
        const auto first = values.begin() + vertex * columns;
        atPoints.insert(atPoints.end(), first, first + columns);
      }
      report.notes.insert(report.notes.end(), notes.begin(), notes.end());
      summary = SolveSummary::of(report, columns);
    });
  return summary;
}

DistributedOptions distributedOptions(const SolveOptions& options, const ProgressFunction& progress)
{
  // Its memory limit is for the streaming engine.
  return { options.tolerance, options.maxCycles, INT64_MAX, progress };
}

void checkForProcesses(const SolveOptions& options)
{
  refuseAutomaticTolerance(options, "the distributed engine");
  if (!options.checkpoint.folder.empty())
  {
    throw Error("The distributed engine has no checkpoints: leave CheckpointDirectory empty, or "
                "choose the Engine Streaming.");
  }
}

} // namespace smg
