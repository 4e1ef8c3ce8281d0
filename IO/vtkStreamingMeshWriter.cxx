// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkStreamingMeshWriter.h"

#include "IO/Conversion/PartialProgress.h"
#include "IO/Formats/StreamConversion.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Formats/Suffix.h"
#include "IO/vtkPieceFiles.h"
#include "IO/vtkPieceStream.h"
#include "Solver/Core/Error.h"
#include "Solver/Storage/ScratchFolder.h"

#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkStreamingMeshWriter);

namespace
{

constexpr int CellsOfPiece = 65536;

/** A number of pieces that gives each about CellsOfPiece cells, from the size of a trial piece. */
int chooseNumberOfPieces(smg::PieceInput& input)
{
  if (input.isData())
  {
    return 1;
  }
  constexpr int trial = 64;
  const auto* piece = vtkDataSet::SafeDownCast(input.update(0, trial, true));
  const vtkIdType cells = piece ? const_cast<vtkDataSet*>(piece)->GetNumberOfCells() : 0;
  const vtkIdType pieces = (cells * trial + CellsOfPiece - 1) / CellsOfPiece;
  return static_cast<int>(std::clamp<vtkIdType>(pieces, 1, 1000000));
}

void writeContainerFile(
  smg::PieceInput& input, int pieces, const std::filesystem::path& path, smg::Progress& progress)
{
  smg::PieceStream stream(input, pieces, { .all = true, .points = {}, .cells = {} });
  smg::writeContainer(stream, path, false, progress);
}

/** The formats need counts and last uses first, so the pieces go through a container. */
void writeStreamFile(
  smg::PieceInput& input, int pieces, const std::filesystem::path& path, smg::Progress& progress)
{
  const smg::ScratchFolder scratch(std::filesystem::absolute(path).parent_path());
  const std::filesystem::path container = scratch.path() / "mesh.vsm";
  smg::PieceStream stream(input, pieces, { .all = true, .points = {}, .cells = {} });
  const smg::ProgressFunction whole = [&progress](double done)
  {
    progress.update(done);
    return true;
  };
  smg::Progress half(smg::partOf(whole, 0.0, 0.5));
  smg::writeContainer(stream, container, true, half);
  smg::vsmToStream(container, path, smg::partOf(whole, 0.5, 1.0));
}

} // namespace

vtkStreamingMeshWriter::~vtkStreamingMeshWriter()
{
  this->SetFileName(nullptr);
}

int vtkStreamingMeshWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

bool vtkStreamingMeshWriter::WriteFile()
{
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw smg::Error("No file is named: set FileName.");
    }
    const std::filesystem::path path = this->FileName;
    const std::string suffix = smg::lowerSuffix(path);
    const bool isIndex = suffix == ".pvtp" || suffix == ".pvtu";
    if (suffix != ".vsm" && !isIndex && !smg::streamFormatOfName(path))
    {
      throw smg::Error(
        path.string() +
        " has a suffix that cannot be written: use .vsm, .sma, .smb, .sva, .svb, .pvtp or .pvtu.");
    }
    smg::Progress progress(
      [this](double done)
      {
        this->UpdateProgress(done);
        return !this->GetAbortExecute();
      });
    smg::PieceInput input(*this, 0);
    const int pieces =
      this->NumberOfStreamedPieces ? this->NumberOfStreamedPieces : chooseNumberOfPieces(input);
    const auto write = suffix == ".vsm" ? writeContainerFile
                       : isIndex        ? smg::writePieceFiles
                                        : writeStreamFile;
    write(input, pieces, path, progress);
    return true;
  }
  catch (const smg::Cancelled&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
  return false;
}

int vtkStreamingMeshWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->SetAbortExecute(0);
  this->InvokeEvent(vtkCommand::StartEvent);
  this->WriteData();
  this->InvokeEvent(vtkCommand::EndEvent);
  return this->GetErrorCode() == vtkErrorCode::NoError;
}

void vtkStreamingMeshWriter::WriteData()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isParallel = controller && controller->GetNumberOfProcesses() > 1;
  int done = 1;
  if (!isParallel || controller->GetLocalProcessId() == 0)
  {
    done = this->WriteFile() ? 1 : 0;
  }
  if (isParallel)
  {
    controller->Broadcast(&done, 1, 0);
  }
  if (!done && this->GetErrorCode() == vtkErrorCode::NoError)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
  this->WriteTime.Modified();
}

void vtkStreamingMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "NumberOfStreamedPieces: " << this->NumberOfStreamedPieces << "\n";
}
