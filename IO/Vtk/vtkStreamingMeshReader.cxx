// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshReader.h"

#include "IO/External/BlockFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/ReaderInternals.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include "vtkDataArraySelection.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

using vtkSDDP = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkStreamingMeshReader);

vtkStreamingMeshReader::vtkStreamingMeshReader()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkStreamingMeshReader::~vtkStreamingMeshReader() = default;

std::string vtkStreamingMeshReader::GetContainerName()
{
  return this->FileName;
}

bool vtkStreamingMeshReader::IsContainerMade()
{
  return true;
}

void vtkStreamingMeshReader::ChooseConversion(smg::ConversionOptions&) {}

void vtkStreamingMeshReader::UpdateContainer()
{
  if (this->GetContainerName().empty())
  {
    throw smg::Error("No file is named: set FileName.");
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
      isSurface = this->Internal->look(*this).cellType == smg::CellType::Triangle;
    }
    catch (const smg::Cancelled&)
    {
      return smg::cancel(*this, this->Internal->Failures);
    }
    catch (const std::exception& error)
    {
      this->Internal->fail(*this, error.what());
    }
  }
  Internals::setOutput(info, isSurface);
  return 1;
}

int vtkStreamingMeshReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation& output = *outputVector->GetInformationObject(0);
  try
  {
    this->Internal->tell(*this, output);
  }
  catch (const std::exception& error)
  {
    this->Internal->fail(*this, error.what());
    this->Internal->tell(*this, output);
  }
  return smg::offerPieces(*outputVector);
}

int vtkStreamingMeshReader::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  try
  {
    if (this->Internal->Stated)
    {
      this->Internal->openStated(*this, *outputVector->GetInformationObject(0));
    }
    return 1;
  }
  catch (const smg::Cancelled&)
  {
    return smg::cancel(*this, this->Internal->Failures);
  }
}

int vtkStreamingMeshReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return smg::runRequestData(*this, this->Internal->Failures, nullptr, *outputVector,
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
      const smg::StreamInfo& info = this->Internal->open(*this, request).info();
      this->Internal->requireType(*output, info);
      this->Internal->setTime(*output);
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
  os << indent << "FileName: " << smg::textOrNone(this->FileName) << "\n";
  os << indent << "ScratchDirectory: " << smg::textOrNone(this->ScratchDirectory) << "\n";
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
