// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkOrdinaryMesh.h"

#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkPieceColumns.h"
#include "IO/vtkPieceStream.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

/**
 * Collects the error messages of VTK during its lifetime instead of printing them. Some are sent as
 * events, others only as text to VTK's output window, which is replaced for this time.
 */
class vtkComplaints
{
public:
  vtkComplaints()
    : Before(vtkOutputWindow::GetInstance())
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<vtkComplaints*>(self)->note(static_cast<const char*>(text)); });
    vtkNew<Window> window;
    window->Complaints = this;
    vtkOutputWindow::SetInstance(window);
  }
  ~vtkComplaints() { vtkOutputWindow::SetInstance(this->Before); }
  vtkComplaints(const vtkComplaints&) = delete;
  vtkComplaints& operator=(const vtkComplaints&) = delete;

  /** An observer for ErrorEvent. */
  vtkCommand* command() { return this->Command; }
  /** The first message, in one line; empty if there is none. */
  const std::string& text() const { return this->Text; }

private:
  class Window : public vtkOutputWindow
  {
  public:
    static Window* New() { VTK_STANDARD_NEW_BODY(Window); }
    vtkTypeMacro(Window, vtkOutputWindow);
    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override { this->Complaints->note(text); }
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}

    vtkComplaints* Complaints = nullptr;
  };

  /** VTK's text is "ERROR: In FILE, line N\nCLASS (ADDRESS): SENTENCE\n ...". */
  void note(const char* text)
  {
    if (!text || !this->Text.empty())
    {
      return;
    }
    this->Text = text;
    const std::size_t colon = this->Text.find("): ");
    const std::size_t line = this->Text.find('\n');
    this->Text.erase(0, colon != std::string::npos  ? colon + 3
                        : line != std::string::npos ? line + 1
                                                    : 0);
    this->Text.erase(std::min(this->Text.find('\n'), this->Text.size()));
    this->Text.erase(this->Text.find_last_not_of(" .:!") + 1);
    this->Text = this->Text.empty() ? "unknown error" : this->Text;
  }

  vtkSmartPointer<vtkOutputWindow> Before;
  vtkNew<vtkCallbackCommand> Command;
  std::string Text;
};

/** Has VTK's `Writer` of .vtp or .vtu files write the mesh as it is parsed as a stream. */
template <class Writer>
void writeRaw(vtkPointSet& mesh, const std::filesystem::path& path)
{
  vtkComplaints complaints;
  vtkNew<Writer> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  writer->SetInputData(&mesh);
  writer->Write();
  if (writer->GetErrorCode() != 0 || !complaints.text().empty())
  {
    throw Error(path.string() + ": VTK cannot write the mesh there: " +
                (complaints.text().empty() ? "unknown error" : complaints.text()) + '.');
  }
}

/** Whether cells use no point before one that is not a duplicate and has a lower number. */
bool areUsedInOrder(vtkPointSet& mesh, const std::vector<std::int64_t>& ids, std::int64_t first)
{
  std::int64_t used = first;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    mesh.GetCellPoints(cell, corners);
    for (const vtkIdType corner : *corners)
    {
      const std::int64_t id = ids[static_cast<std::size_t>(corner)];
      if (id > used)
      {
        return false;
      }
      used = std::max(used, id + 1);
    }
  }
  return true;
}

/** Whether the points that are no duplicates have consecutive GlobalIds, in the order in which
 * cells use them first. */
bool isNumberedAsPiece(vtkPointSet& mesh, vtkDataArray& array)
{
  vtkUnsignedCharArray* ghosts = mesh.GetPointGhostArray();
  const std::vector<std::int64_t> ids = integersOf(array);
  std::vector<std::int64_t> own;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
  {
    if (!ghosts || (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT) == 0)
    {
      own.push_back(ids[static_cast<std::size_t>(i)]);
    }
  }
  if (own.empty())
  {
    return true;
  }
  const std::int64_t first = *std::ranges::min_element(own);
  std::vector<bool> isSeen(own.size());
  for (const std::int64_t id : own)
  {
    // The difference of two numbers of 64 bits may not be one.
    const auto place = static_cast<std::size_t>(id) - static_cast<std::size_t>(first);
    if (place >= isSeen.size() || isSeen[place])
    {
      return false;
    }
    isSeen[place] = true;
  }
  return areUsedInOrder(mesh, ids, first);
}

/** The mesh without the arrays of pieces, which are those of another mesh, and without arrays of
 * another length, which some filters of VTK leave (the RegionId of the cells of Connectivity). */
vtkSmartPointer<vtkPointSet> withoutPieceArrays(vtkPointSet& mesh)
{
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance());
  copy->ShallowCopy(&mesh);
  for (const char* name : { GlobalIdsName, StreamFinalizedName })
  {
    copy->GetPointData()->RemoveArray(name);
  }
  const auto removeOthers = [](vtkDataSetAttributes& arrays, vtkIdType tuples)
  {
    for (int k = arrays.GetNumberOfArrays() - 1; k >= 0; --k)
    {
      if (arrays.GetAbstractArray(k)->GetNumberOfTuples() != tuples)
      {
        arrays.RemoveArray(k);
      }
    }
  };
  removeOthers(*copy->GetPointData(), copy->GetNumberOfPoints());
  removeOthers(*copy->GetCellData(), copy->GetNumberOfCells());
  return copy;
}

} // namespace

bool hasSeveralProcesses()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

CellChoice countingCells(vtkPointSet& mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh);
  for (vtkIdType cell = 0; grid && cell < grid->GetNumberOfCells(); ++cell)
  {
    if (isSolidOfVtk(grid->GetCellType(cell)))
    {
      return CellChoice::Tetrahedra;
    }
  }
  return CellChoice::Triangles;
}

bool isOrdinaryMesh(vtkDataObject& data)
{
  auto* mesh = vtkPointSet::SafeDownCast(&data);
  const bool isMesh = vtkPolyData::SafeDownCast(mesh) || vtkUnstructuredGrid::SafeDownCast(mesh);
  if (!isMesh || mesh->GetNumberOfCells() == 0)
  {
    return false;
  }
  vtkDataArray* ids = globalIdArray(*mesh);
  return !ids || (!isPreview(*mesh) && !hasSeveralProcesses() && !isNumberedAsPiece(*mesh, *ids));
}

StreamInfo ordinaryMeshInfo(vtkPointSet& mesh)
{
  StreamInfo info;
  const bool isSolid = countingCells(mesh) == CellChoice::Tetrahedra;
  info.cellType = isSolid ? CellType::Tetrahedron : CellType::Triangle;
  info.vertices = mesh.GetNumberOfPoints();
  if (auto* surface = vtkPolyData::SafeDownCast(&mesh))
  {
    for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
    {
      info.cells += cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells();
    }
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&mesh);
  for (vtkIdType cell = 0; grid && cell < grid->GetNumberOfCells(); ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (isSolidOfVtk(type) == isSolid)
    {
      info.cells += partsOfVtk(type, grid->GetCells()->GetCellSize(cell));
    }
  }
  info.vertexColumns = columnSpecs(*mesh.GetPointData());
  return info;
}

vtkSmartPointer<vtkPointSet> withoutOriginalNumbers(vtkPointSet& mesh)
{
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh.NewInstance());
  copy->ShallowCopy(&mesh);
  copy->GetPointData()->RemoveArray(OriginalIdName);
  copy->GetCellData()->RemoveArray(OriginalCellIdName);
  return copy;
}

ConversionReport writeOrdinaryMesh(
  vtkPointSet& mesh, const std::filesystem::path& path, const ConversionOptions& options)
{
  const ScratchFolder scratch(options.scratch);
  const bool isSurface = vtkPolyData::SafeDownCast(&mesh) != nullptr;
  const std::filesystem::path file = scratch / (isSurface ? "mesh.vtp" : "mesh.vtu");
  const vtkSmartPointer<vtkPointSet> plain = withoutPieceArrays(mesh);
  isSurface ? writeRaw<vtkXMLPolyDataWriter>(*plain, file)
            : writeRaw<vtkXMLUnstructuredGridWriter>(*plain, file);
  try
  {
    ConversionOptions given = options;
    given.cells = countingCells(mesh);
    ConversionReport report = convert(file, path, given);
    if (report.dropped_cells > 0)
    {
      report.notes.push_back(
        std::to_string(report.dropped_cells) +
        (given.cells == CellChoice::Tetrahedra ? " points, lines and surface cells are left out."
                                               : " points and lines are left out."));
    }
    return report;
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error& error)
  {
    // The temporary file is unknown to the user, and which cells count is no choice here.
    std::string message = error.what();
    const std::pair<std::string, std::string> words[] = { { file.string() + ": the file",
                                                            "The input" },
      { file.string(), "The input" }, { " (option --cells)", "" } };
    for (const auto& [from, to] : words)
    {
      for (std::size_t at; (at = message.find(from)) != std::string::npos;)
      {
        message.replace(at, from.size(), to);
      }
    }
    throw Error(message);
  }
}

} // namespace smg
