// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/ReaderInternals.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PropertyRange.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "smg/Error.h"

#include "vtkDataObject.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>

vtkStreamingMeshReader::Internals::Stamp vtkStreamingMeshReader::Internals::stampOf(
  vtkStreamingMeshReader& self)
{
  return { self.GetMTime(), smg::InputState(self.FileName),
    smg::InputState(self.GetContainerName()) };
}

namespace
{

/** Whether a container is a file that takes a conversion itself. */
bool isForeign(const std::string& name)
{
  return smg::kindOfInput(name) != smg::MeshFileKind::Vsm;
}

/** The step that is shown where none is asked for: that of before, if there is one. */
std::int64_t presentStep(std::int64_t before, const std::vector<double>& times)
{
  return std::clamp<std::int64_t>(before, 0, std::max<std::int64_t>(0, std::ssize(times) - 1));
}

void offerTimes(const std::vector<double>& times, vtkInformation& output)
{
  if (times.empty())
  {
    output.Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    output.Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
    return;
  }
  const double range[] = { times.front(), times.back() };
  output.Set(
    vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output.Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
}

} // namespace

const smg::StreamInfo& vtkStreamingMeshReader::Internals::look(vtkStreamingMeshReader& self)
{
  const bool isAsked = this->Mesh && this->Opened.Properties == self.GetMTime();
  const bool isConverted =
    !isAsked &&
    (!self.IsContainerMade() || (isForeign(self.GetContainerName()) && !this->isOpen(self)));
  return isConverted && this->state(self) ? *this->Stated : this->open(self).info();
}

/** Takes what the file states; returns whether that is enough. Throws Cancelled. */
bool vtkStreamingMeshReader::Internals::state(vtkStreamingMeshReader& self)
{
  try
  {
    std::vector<double> times = smg::timesOf(self.GetContainerName());
    smg::ConversionOptions options;
    options.scratch = self.ScratchDirectory;
    options.progress = smg::progressOf(self);
    options.timeStep = presentStep(this->Step, times);
    self.ChooseConversion(options);
    std::optional<smg::StreamInfo> stated = smg::statedMesh(self.FileName, options);
    if (!stated)
    {
      return false;
    }
    this->close();
    this->takeName(self);
    this->Times = std::move(times);
    this->Stated = std::move(stated);
    this->Reason.clear();
    return true;
  }
  catch (const smg::Cancelled&)
  {
    throw;
  }
  catch (const smg::Error&)
  {
    return false;
  }
}

smg::VsmReader& vtkStreamingMeshReader::Internals::open(
  vtkStreamingMeshReader& self, vtkInformation* request)
{
  smg::requireInRange({ { "MaximumPointsInMemory", self.MaximumPointsInMemory, 0 },
    { "PreviewPoints", self.PreviewPoints, smg::MinPreviewPoints, smg::MaxPreviewPoints },
    { "PreviewCells", self.PreviewCells, SURFACE, TETRAHEDRA } });
  const bool isAsked = this->Mesh && this->Opened.Properties == self.GetMTime();
  if (isAsked && !this->Opened.areFilesUnchanged())
  {
    this->requireSameMesh(self);
    this->Opened = stampOf(self);
  }
  if (!isAsked)
  {
    self.UpdateContainer();
    if (!this->isOpen(self))
    {
      // Of a mesh that was stated, the pipeline knows the folder.
      this->Stated ? this->closeMesh() : this->close();
      this->takeName(self);
      this->Times = smg::timesOf(this->Name);
    }
  }
  const std::int64_t step = this->stepOf(request);
  if (!this->Mesh || this->Step != step)
  {
    this->openStep(step, smg::progressOf(self));
  }
  else if (isAsked)
  {
    return this->Mesh->reader();
  }
  this->Stated.reset();
  this->Opened = stampOf(self);
  this->Reason.clear();
  return this->Mesh->reader();
}

/** Whether the mesh is that of the container as it is now. */
bool vtkStreamingMeshReader::Internals::isOpen(vtkStreamingMeshReader& self) const
{
  return this->Mesh && this->Name == self.GetContainerName() &&
         this->Scratch == self.ScratchDirectory && this->Opened.Container.isUnchanged();
}

/** Takes the names of the container and of the scratch folder; another one has other arrays. */
void vtkStreamingMeshReader::Internals::takeName(vtkStreamingMeshReader& self)
{
  const std::string name = self.GetContainerName();
  if (this->Name != name && !this->Name.empty())
  {
    this->PointArrays->RemoveAllArrays();
    this->CellArrays->RemoveAllArrays();
  }
  this->Name = name;
  this->Scratch = self.ScratchDirectory;
}

/** The .vsm file of the mesh, now or when it is converted. */
std::filesystem::path vtkStreamingMeshReader::Internals::file()
{
  if (!isForeign(this->Name))
  {
    return this->Name;
  }
  if (!this->Folder)
  {
    this->Folder.emplace(this->Scratch);
  }
  return *this->Folder / "mesh.vsm";
}

void vtkStreamingMeshReader::Internals::openStated(
  vtkStreamingMeshReader& self, vtkInformation& output)
{
  this->Failures.begin();
  try
  {
    this->open(self, &output);
    this->Outdated.Modified(); // so that the filters behind are told as well
    this->tell(self, output);
    this->Opened = stampOf(self);
  }
  catch (const smg::Cancelled&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    this->Outdated.Modified();
    this->fail(self, error.what());
  }
}

void vtkStreamingMeshReader::Internals::tell(vtkStreamingMeshReader& self, vtkInformation& output)
{
  const bool isKnown = this->Mesh || this->Stated;
  offerTimes(isKnown ? this->Times : std::vector<double>{}, output);
  output.Remove(vtkStreamingMeshKeys::STREAM_FILE());
  output.Remove(vtkStreamingMeshKeys::STREAM_FINGERPRINT());
  output.Remove(vtkStreamingMeshKeys::PREVIEWED());
  if (!isKnown)
  {
    return;
  }
  output.Set(vtkStreamingMeshKeys::STREAM_FILE(), this->file().c_str());
  const smg::StreamInfo& info = this->Mesh ? this->Mesh->reader().info() : *this->Stated;
  if (this->Mesh)
  {
    output.Set(
      vtkStreamingMeshKeys::PREVIEWED(), info.vertices > self.MaximumPointsInMemory ? 1 : 0);
  }
  // The same file has another content at each time step.
  if (this->Mesh && this->Times.size() < 2)
  {
    output.Set(vtkStreamingMeshKeys::STREAM_FINGERPRINT(), this->Mesh->fingerprint().c_str());
  }
  // A replaced file may not have what was offered of the one before; another time step that has
  // not may be followed by one that has.
  const bool isSeries = this->Times.size() > 1;
  smg::offerColumns(*this->PointArrays, info.vertexColumns, isSeries ? nullptr : &this->OfPoints);
  smg::offerColumns(*this->CellArrays, info.cellColumns, isSeries ? nullptr : &this->OfCells);
}

/** The time step of a request: the last one that has begun, or else the first. */
std::int64_t vtkStreamingMeshReader::Internals::stepOf(vtkInformation* request) const
{
  if (!request || !request->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    return presentStep(this->Step, this->Times);
  }
  const double time = request->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
  const auto later = std::ranges::upper_bound(this->Times, time);
  return std::max<std::int64_t>(0, later - this->Times.begin() - 1);
}

/** Opens the file after its conversion, of one with time steps that of the wanted one. */
void vtkStreamingMeshReader::Internals::openStep(
  std::int64_t step, const smg::ProgressFunction& progress)
{
  this->closeMesh();
  const std::filesystem::path mesh = this->file();
  if (mesh != this->Name)
  {
    smg::ConversionOptions options;
    options.scratch = this->Folder->path();
    options.progress = progress;
    options.timeStep = step;
    if (smg::kindOfInput(this->Name) == smg::MeshFileKind::Stream)
    {
      options.order = smg::StreamOrder::Keep;
    }
    smg::convert(this->Name, mesh, options);
  }
  this->Mesh = smg::openMesh(mesh);
  this->Step = step;
}

/** Throws Error unless the file, which has been written since it was opened, has the same mesh. */
void vtkStreamingMeshReader::Internals::requireSameMesh(vtkStreamingMeshReader& self) const
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

void vtkStreamingMeshReader::Internals::fail(
  vtkStreamingMeshReader& self, const std::string& reason)
{
  this->close();
  this->Failed = stampOf(self);
  this->Reason = reason;
  this->Failures.show(self, reason);
}

bool vtkStreamingMeshReader::Internals::hasFailed(vtkStreamingMeshReader& self) const
{
  return !this->Reason.empty() && this->Failed.Properties == self.GetMTime() &&
         this->Failed.areFilesUnchanged();
}

void vtkStreamingMeshReader::Internals::lookAtFiles(vtkStreamingMeshReader& self)
{
  if (!this->Reason.empty() && !this->hasFailed(self))
  {
    this->Reason.clear();
    this->Outdated.Modified();
  }
}

void vtkStreamingMeshReader::Internals::close()
{
  this->closeMesh();
  this->Stated.reset();
  this->Times.clear();
  this->Folder.reset();
}

void vtkStreamingMeshReader::Internals::closeMesh()
{
  this->Mesh.reset();
  this->Columns.reset();
  this->Preview.clear();
  this->Shown.clear();
}

void vtkStreamingMeshReader::Internals::setOutput(vtkInformation& info, bool isSurface)
{
  const char* type = isSurface ? "vtkPolyData" : "vtkUnstructuredGrid";
  vtkDataObject* present = vtkDataObject::GetData(&info);
  if (!present || !present->IsA(type))
  {
    info.Set(vtkDataObject::DATA_OBJECT(),
      vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
  }
}

void vtkStreamingMeshReader::Internals::requireType(
  vtkPointSet& output, const smg::StreamInfo& info) const
{
  const bool isSurface = info.cellType == smg::CellType::Triangle;
  if ((output.IsA("vtkPolyData") != 0) == isSurface)
  {
    return;
  }
  const std::string kinds = isSurface ? " is a surface, unlike " : " is a solid, unlike ";
  throw smg::Error(
    this->Times.empty()
      ? this->Name + kinds +
          "what it was when the pipeline asked for its type: reload it (File > "
          "Reload Files, or Modified() of the reader)."
      : this->Name + ": time step " + std::to_string(this->Step) + kinds +
          "others: convert the time steps one by one (TimeStep of the Streaming Mesh Converter).");
}

void vtkStreamingMeshReader::Internals::setTime(vtkPointSet& output) const
{
  if (!this->Times.empty())
  {
    output.GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), this->Times[static_cast<std::size_t>(this->Step)]);
  }
}

void vtkStreamingMeshReader::Internals::readPiece(
  vtkPointSet& output, int part, int parts, int ghostLevels)
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
  const std::vector<std::string> ofCells = smg::chosenColumns(*this->CellArrays, info.cellColumns);
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
  if (parts == 1)
  {
    smg::removeFinalized(output);
  }
}

namespace
{

/** A preview of tetrahedra is a mesh to compute on while the whole one is not. */
std::int64_t pointsOfPreview(
  const smg::StreamInfo& mesh, std::int64_t maximum, smg::SolidPreviewCells cells)
{
  constexpr std::int64_t VerticesPerPoint = 20;
  const bool isCoarse =
    mesh.cellType == smg::CellType::Tetrahedron && cells == smg::SolidPreviewCells::Tetrahedra;
  return isCoarse ? std::clamp(mesh.vertices / VerticesPerPoint, smg::MinPreviewPoints, maximum)
                  : maximum;
}

} // namespace

void vtkStreamingMeshReader::Internals::readPreview(vtkPointSet& output, int part,
  const vtkStreamingMeshReader& self, const smg::ProgressFunction& progress)
{
  const auto cells = self.PreviewCells == TETRAHEDRA ? smg::SolidPreviewCells::Tetrahedra
                                                     : smg::SolidPreviewCells::Triangles;
  const smg::StreamInfo& full = this->Mesh->reader().info();
  smg::MeshPiece piece;
  if (part == 0)
  {
    piece = this->Preview.of(
      this->Mesh->reader(), pointsOfPreview(full, self.PreviewPoints, cells), cells, progress);
  }
  else
  {
    for (const smg::ColumnSpec& spec : full.vertexColumns)
    {
      piece.vertexColumns.push_back({ spec, {} });
    }
  }
  const std::vector<std::string> names = smg::chosenColumns(*this->PointArrays, full.vertexColumns);
  std::erase_if(piece.vertexColumns, [&names](const smg::Column& column)
    { return std::find(names.begin(), names.end(), column.spec.name) == names.end(); });
  smg::StreamInfo info = full;
  if (cells == smg::SolidPreviewCells::Triangles)
  {
    info.cellType = smg::CellType::Triangle;
  }
  smg::setPiece(output, piece, info);
  smg::removeFinalized(output);
  smg::markAsPreview(output, full);
  smg::markAsReaders(output);
}
