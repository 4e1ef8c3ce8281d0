// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkStreamingMeshReader.h"

#include "IO/External/BlockFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/UsedFiles.h"
#include "IO/Preview/StreamPreview.h"
#include "IO/vtkFailures.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkPieceColumns.h"
#include "IO/vtkStreamingMeshKeys.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkDataArraySelection.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimeStamp.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using vtkSDDP = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkStreamingMeshReader);

struct vtkStreamingMeshReader::Internals
{
  /** The state that the output depends on. */
  struct Stamp
  {
    vtkMTimeType Properties = 0;
    smg::InputState File, Container;

    bool areFilesUnchanged() const
    {
      return this->File.isUnchanged() && this->Container.isUnchanged();
    }
  };

  smg::Failures Failures;
  vtkNew<vtkDataArraySelection> PointArrays;
  vtkNew<vtkDataArraySelection> CellArrays;
  std::string Name, Scratch;
  std::unique_ptr<smg::OpenedMesh> Mesh;
  std::vector<double> Times; ///< of the time steps; empty: the file has none
  std::int64_t Step = 0;     ///< which is wanted
  std::int64_t OpenedStep = 0;
  /** Of a file with time steps: the folder of the one that is open, whose name does not change. */
  std::optional<smg::ScratchFolder> OfSteps;
  Stamp Opened; ///< of the opened mesh
  /** Of the last failure to open the mesh: a repeated request neither retries nor reports again. */
  Stamp Failed;
  std::string Reason;    ///< of that failure; empty: none
  vtkTimeStamp Outdated; ///< when a failure was found to be out of date
  /** The columns read with the pieces of the file; none before the first piece. */
  std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> Columns;
  smg::KeptPreview Preview;
  std::string Shown, Outcome; ///< storage of the sentence that is returned

  static Stamp stampOf(vtkStreamingMeshReader& self)
  {
    return { self.GetMTime(), smg::InputState(self.FileName ? self.FileName : ""),
      smg::InputState(self.GetContainerName()) };
  }

  /** Opens the container unless it is open and up to date. Throws Error if it is another one than
   * before although nothing has been modified: what was made of it does not go with its pieces. */
  smg::VsmReader& open(vtkStreamingMeshReader& self)
  {
    const bool isAsked = this->Mesh && this->Opened.Properties == self.GetMTime();
    if (isAsked && !this->Opened.areFilesUnchanged())
    {
      this->requireSameMesh(self);
      this->Opened = stampOf(self);
    }
    if (isAsked && this->OpenedStep == this->Step)
    {
      return this->Mesh->reader();
    }
    self.UpdateContainer();
    const std::string name = self.GetContainerName();
    const std::string folder = self.ScratchDirectory ? self.ScratchDirectory : "";
    if (!this->Mesh || this->Name != name || this->Scratch != folder ||
        !this->Opened.Container.isUnchanged())
    {
      this->close();
      this->Times = smg::timesOf(name);
      this->Step = std::clamp<std::int64_t>(
        this->Step, 0, std::max<std::int64_t>(0, std::ssize(this->Times) - 1));
      if (this->Name != name && !this->Name.empty())
      {
        this->PointArrays->RemoveAllArrays();
        this->CellArrays->RemoveAllArrays();
      }
      this->Name = name;
      this->Scratch = folder;
      this->openStep(smg::progressOf(self));
    }
    else if (this->OpenedStep != this->Step)
    {
      this->openStep(smg::progressOf(self));
    }
    this->Opened = stampOf(self);
    this->Reason.clear();
    return this->Mesh->reader();
  }

  /** Opens the file, of one with time steps the wanted one. */
  void openStep(const smg::ProgressFunction& progress)
  {
    const std::int64_t step = this->Step;
    this->closeMesh();
    smg::ConversionOptions options;
    options.scratch = this->Scratch;
    options.progress = progress;
    if (this->Times.size() < 2)
    {
      this->Mesh = smg::openMesh(this->Name, options);
    }
    else
    {
      if (!this->OfSteps)
      {
        this->OfSteps.emplace(this->Scratch);
      }
      options.scratch = this->OfSteps->path();
      options.timeStep = step;
      const std::filesystem::path mesh = *this->OfSteps / "mesh.vsm";
      smg::convert(this->Name, mesh, options);
      this->Mesh = smg::openMesh(mesh);
    }
    this->OpenedStep = step;
  }

  /** Throws Error unless the file, which has been written since it was opened, has the same mesh.
   */
  void requireSameMesh(vtkStreamingMeshReader& self) const
  {
    const std::filesystem::path name = self.GetContainerName();
    if (this->Opened.Container.isUnchanged())
    {
      return; // of a converter, whose result is still there
    }
    try
    {
      if (smg::kindOfInput(name) == smg::MeshFileKind::Vsm)
      {
        smg::VsmReader(name, nullptr, this->Mesh->fileFingerprint());
        return;
      }
    }
    catch (const std::exception&)
    {
      // What it is now does not matter.
    }
    throw smg::Error(name.string() +
                     ": was replaced or changed since it was opened: reload it (File > Reload "
                     "Files, or Modified() of the reader), and leave it as it is meanwhile.");
  }

  /** Chooses the time step of a request: the last one that has begun, or else the first. */
  void chooseStep(vtkInformation& request)
  {
    const double time = request.Get(vtkSDDP::UPDATE_TIME_STEP());
    const auto later = std::ranges::upper_bound(this->Times, time);
    this->Step = request.Has(vtkSDDP::UPDATE_TIME_STEP())
                   ? std::max<std::int64_t>(0, later - this->Times.begin() - 1)
                   : this->Step;
  }

  /** Shows why the mesh cannot be opened. */
  void fail(vtkStreamingMeshReader& self, const std::string& reason)
  {
    this->close();
    this->Failed = stampOf(self);
    this->Reason = reason;
    this->Failures.show(self, reason);
  }

  bool hasFailed(vtkStreamingMeshReader& self) const
  {
    return !this->Reason.empty() && this->Failed.Properties == self.GetMTime() &&
           this->Failed.areFilesUnchanged();
  }

  /** After a failure, looks whether files have changed since. */
  void lookAtFiles(vtkStreamingMeshReader& self)
  {
    if (!this->Reason.empty() && !this->hasFailed(self))
    {
      this->Reason.clear();
      this->Outdated.Modified();
    }
  }

  void close()
  {
    this->closeMesh();
    this->Times.clear();
    this->OfSteps.reset();
  }

  void closeMesh()
  {
    this->Mesh.reset();
    this->Columns.reset();
    this->Preview.clear();
    this->Shown.clear();
  }

  /** Sets the type of the output according to the cells. */
  static void setOutput(vtkInformation& info, bool isSurface)
  {
    const char* type = isSurface ? "vtkPolyData" : "vtkUnstructuredGrid";
    vtkDataObject* present = vtkDataObject::GetData(&info);
    if (!present || !present->IsA(type))
    {
      info.Set(vtkDataObject::DATA_OBJECT(),
        vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
    }
  }

  /** Says which time step the output shows. */
  void setTime(vtkPointSet& output, const smg::StreamInfo& info) const
  {
    if (this->Times.empty())
    {
      return;
    }
    if (output.IsA("vtkPolyData") != (info.cellType == smg::CellType::Triangle))
    {
      throw smg::Error(this->Name + ": time step " + std::to_string(this->Step) + " is a " +
                       (output.IsA("vtkPolyData") ? "solid" : "surface") +
                       ", unlike others: convert the time steps one by one (smg convert "
                       "--time-step).");
    }
    output.GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), this->Times[static_cast<std::size_t>(this->Step)]);
  }

  /** Reads the real piece with the selected arrays. */
  void readPiece(vtkPointSet& output, int part, int parts, int ghostLevels)
  {
    smg::VsmReader& reader = this->Mesh->reader();
    const smg::StreamInfo& info = reader.info();
    const auto firstCell = [&info, parts](int p)
    {
      return static_cast<std::int64_t>(
        static_cast<__int128>(info.cells) * std::min(p, parts) / parts);
    };
    const std::vector<std::string> ofPoints =
      smg::chosenColumns(*this->PointArrays, info.vertexColumns);
    const std::vector<std::string> ofCells =
      smg::chosenColumns(*this->CellArrays, info.cellColumns);
    // Selecting columns makes the file reader discard the active vertices.
    if (this->Columns != std::pair(ofPoints, ofCells))
    {
      reader.selectColumns(ofPoints, ofCells);
      this->Columns = { ofPoints, ofCells };
    }
    smg::MeshPiece piece;
    reader.readPiece(
      firstCell(part), firstCell(part + 1), piece, parts > 1 ? std::max(0, ghostLevels) : 0);
    smg::setPiece(output, piece, info);
  }

  /** Reads the preview, all of it in the first piece. */
  void readPreview(vtkPointSet& output, int part, const vtkStreamingMeshReader& self,
    const smg::ProgressFunction& progress)
  {
    const auto cells = self.PreviewCells == TETRAHEDRA ? smg::SolidPreviewCells::Tetrahedra
                                                       : smg::SolidPreviewCells::Triangles;
    const smg::StreamInfo& full = this->Mesh->reader().info();
    smg::MeshPiece piece;
    if (part == 0)
    {
      piece = this->Preview.of(this->Mesh->reader(), self.PreviewPoints, cells, progress);
    }
    else
    {
      for (const smg::ColumnSpec& spec : full.vertexColumns)
      {
        piece.vertexColumns.push_back({ spec, {} });
      }
    }
    const std::vector<std::string> names =
      smg::chosenColumns(*this->PointArrays, full.vertexColumns);
    std::erase_if(piece.vertexColumns, [&names](const smg::Column& column)
      { return std::find(names.begin(), names.end(), column.spec.name) == names.end(); });
    smg::StreamInfo info = full;
    if (cells == smg::SolidPreviewCells::Triangles)
    {
      info.cellType = smg::CellType::Triangle;
    }
    smg::setPiece(output, piece, info);
    smg::markAsPreview(output, full);
    smg::markAsReaders(output);
  }
};

vtkStreamingMeshReader::vtkStreamingMeshReader()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkStreamingMeshReader::~vtkStreamingMeshReader()
{
  this->SetFileName(nullptr);
  this->SetScratchDirectory(nullptr);
}

std::string vtkStreamingMeshReader::GetContainerName()
{
  return this->FileName ? this->FileName : "";
}

void vtkStreamingMeshReader::UpdateContainer()
{
  if (this->GetContainerName().empty())
  {
    throw smg::Error("No file is named: set FileName.");
  }
}

void vtkStreamingMeshReader::SetPreviewPoints(int points)
{
  const int possible = static_cast<int>(
    std::clamp<std::int64_t>(points, smg::MinPreviewPoints, smg::MaxPreviewPoints));
  if (possible != this->PreviewPoints)
  {
    this->PreviewPoints = possible;
    this->Modified();
  }
}

vtkDataArraySelection* vtkStreamingMeshReader::GetPointDataArraySelection()
{
  return this->Internal->PointArrays;
}

vtkDataArraySelection* vtkStreamingMeshReader::GetCellDataArraySelection()
{
  return this->Internal->CellArrays;
}

const char* vtkStreamingMeshReader::GetError()
{
  return this->Internal->Failures.error().c_str();
}

const char* vtkStreamingMeshReader::GetOutcome()
{
  const std::string& error = this->Internal->Failures.error();
  return error.empty() ? this->Internal->Shown.c_str()
                       : (this->Internal->Outcome = "Failed: " + error).c_str();
}

vtkIdType vtkStreamingMeshReader::GetFullNumberOfPoints()
{
  return this->Internal->Mesh ? this->Internal->Mesh->reader().info().vertices : -1;
}

vtkIdType vtkStreamingMeshReader::GetFullNumberOfCells()
{
  return this->Internal->Mesh ? this->Internal->Mesh->reader().info().cells : -1;
}

vtkIdType vtkStreamingMeshReader::GetWidth()
{
  return this->Internal->Mesh ? this->Internal->Mesh->reader().info().width : -1;
}

vtkMTimeType vtkStreamingMeshReader::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->Internal->PointArrays->GetMTime(),
    this->Internal->CellArrays->GetMTime(), this->Internal->Outdated.GetMTime() });
}

int vtkStreamingMeshReader::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int port,
  vtkMTimeType* time)
{
  this->Internal->lookAtFiles(*this);
  return this->Superclass::ComputePipelineMTime(request, inputVector, outputVector, port, time);
}

bool vtkStreamingMeshReader::IsFileUnchanged()
{
  return this->Internal->Mesh && this->Internal->Opened.Container.isUnchanged();
}

int vtkStreamingMeshReader::CanReadFile(const char* name)
{
  try
  {
    if (!name || !std::filesystem::is_regular_file(name))
    {
      return 0;
    }
    switch (smg::kindOfInput(name))
    {
      case smg::MeshFileKind::Vsm:
        return smg::isBlockFile(name) ? 1 : 0;
      case smg::MeshFileKind::Stream:
        smg::detectStreamFormat(name);
        return 1;
      case smg::MeshFileKind::Indexed:
        return smg::formatOfFile(name) ? 1 : 0;
      default:
        return 0;
    }
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

int vtkStreamingMeshReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkStreamingMeshReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation& info = *outputVector->GetInformationObject(0);
  // The type of an output that will be empty: no file is named yet, or it cannot be opened.
  vtkDataObject* present = vtkDataObject::GetData(&info);
  bool isSurface = !present || present->IsA("vtkPolyData");
  if (this->GetContainerName().empty())
  {
    this->Internal->close();
  }
  else if (!this->Internal->hasFailed(*this))
  {
    this->Internal->Failures.begin();
    try
    {
      isSurface = this->Internal->open(*this).info().cellType == smg::CellType::Triangle;
    }
    catch (const smg::Cancelled&)
    {
      return this->Internal->Failures.refuse(*this);
    }
    catch (const std::exception& error)
    {
      this->Internal->fail(*this, error.what());
    }
  }
  Internals::setOutput(info, isSurface);
  return 1;
}

namespace
{

void offerTimes(const std::vector<double>& times, vtkInformation& output)
{
  if (times.empty())
  {
    output.Remove(vtkSDDP::TIME_STEPS());
    output.Remove(vtkSDDP::TIME_RANGE());
    return;
  }
  const double range[] = { times.front(), times.back() };
  output.Set(vtkSDDP::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output.Set(vtkSDDP::TIME_RANGE(), range, 2);
}

} // namespace

int vtkStreamingMeshReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* output = outputVector->GetInformationObject(0);
  if (!this->Internal->Mesh)
  {
    output->Remove(vtkStreamingMeshKeys::STREAM_FILE());
    output->Remove(vtkStreamingMeshKeys::STREAM_FINGERPRINT());
    output->Remove(vtkStreamingMeshKeys::PREVIEWED());
    offerTimes({}, *output);
    return smg::offerPieces(*outputVector);
  }
  const smg::VsmReader& reader = this->Internal->Mesh->reader();
  const smg::StreamInfo& info = reader.info();
  output->Set(vtkStreamingMeshKeys::STREAM_FILE(), reader.path().c_str());
  // The same file has another content at each time step.
  this->Internal->OfSteps
    ? output->Remove(vtkStreamingMeshKeys::STREAM_FINGERPRINT())
    : output->Set(vtkStreamingMeshKeys::STREAM_FINGERPRINT(), reader.fingerprint().c_str());
  offerTimes(this->Internal->Times, *output);
  output->Set(
    vtkStreamingMeshKeys::PREVIEWED(), info.vertices > this->MaximumPointsInMemory ? 1 : 0);
  smg::offerColumns(*this->Internal->PointArrays, info.vertexColumns);
  smg::offerColumns(*this->Internal->CellArrays, info.cellColumns);
  return smg::offerPieces(*outputVector);
}

int vtkStreamingMeshReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return smg::answer(*this, this->Internal->Failures, nullptr, *outputVector,
    [&]
    {
      if (this->Internal->hasFailed(*this))
      {
        throw smg::InputFailed(this->Internal->Reason); // which was shown
      }
      vtkInformation* request = outputVector->GetInformationObject(0);
      const int parts = std::max(1, request->Get(vtkSDDP::UPDATE_NUMBER_OF_PIECES()));
      // A piece beyond the last one is empty.
      const int piece = request->Get(vtkSDDP::UPDATE_PIECE_NUMBER());
      const int part = piece < 0 ? parts : std::min(piece, parts);
      vtkPointSet* output = vtkPointSet::GetData(request);
      this->Internal->open(*this); // so that the time steps are known
      this->Internal->chooseStep(*request);
      const smg::StreamInfo& info = this->Internal->open(*this).info();
      this->Internal->setTime(*output, info);
      if (!vtkStreamingMeshKeys::IsStreamed(request) &&
          info.vertices / parts > this->MaximumPointsInMemory)
      {
        this->Internal->readPreview(*output, part, *this, smg::progressOf(*this));
        this->Internal->Shown = "A preview: " + smg::groupedDigits(output->GetNumberOfPoints()) +
                                " of " + smg::groupedDigits(info.vertices) + " points.";
      }
      else
      {
        this->Internal->readPiece(
          *output, part, parts, request->Get(vtkSDDP::UPDATE_NUMBER_OF_GHOST_LEVELS()));
        if (!vtkStreamingMeshKeys::IsStreamed(request))
        {
          this->Internal->Shown = "All " + smg::groupedDigits(info.vertices) + " points.";
        }
      }
    });
}

void vtkStreamingMeshReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent
     << "ScratchDirectory: " << (this->ScratchDirectory ? this->ScratchDirectory : "(none)")
     << "\n";
  os << indent << "MaximumPointsInMemory: " << this->MaximumPointsInMemory << "\n";
  os << indent << "PreviewPoints: " << this->PreviewPoints << "\n";
  os << indent << "PreviewCells: " << (this->PreviewCells == SURFACE ? "surface" : "tetrahedra")
     << "\n";
  os << indent << "FullNumberOfPoints: " << this->GetFullNumberOfPoints() << "\n";
  os << indent << "FullNumberOfCells: " << this->GetFullNumberOfCells() << "\n";
  os << indent << "Width: " << this->GetWidth() << "\n";
  os << indent << "PointDataArraySelection:\n";
  this->Internal->PointArrays->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellDataArraySelection:\n";
  this->Internal->CellArrays->PrintSelf(os, indent.GetNextIndent());
}
