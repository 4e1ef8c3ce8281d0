// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshWriter.h"

#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/UsedFiles.h"
#include "IO/Formats/WriteFiles.h"
#include "IO/Mesh/Format.h"
#include "IO/Vtk/Abort.h"
#include "IO/Vtk/ChosenArrays.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/LineFile.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceFiles.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/PropertyNames.h"
#include "IO/Vtk/PropertyRange.h"
#include "IO/Vtk/SavedInput.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/DiskFull.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingMeshWriter);

namespace
{

/** The properties of an input according to a first piece. */
struct InputProbe
{
  bool isOrdinary = false; ///< see smg::lacksStreamNumbering()
  int pieces = 1;          ///< in which the input is to be requested
};

InputProbe probeInput(smg::PieceInput& input, int given)
{
  constexpr std::int64_t PieceBytes = std::int64_t(4) << 20;
  const smg::PieceCount count{ .given = given, .pieceBytes = PieceBytes, .least = 1 };
  const auto cellsOf = [](vtkDataObject* data)
  {
    auto* mesh = vtkDataSet::SafeDownCast(data);
    return mesh ? mesh->GetNumberOfCells() : 0;
  };
  InputProbe probe;
  probe.pieces = input.isData() ? std::max(1, given) : count.first(input);
  if (!input.isData())
  {
    vtkDataObject* piece =
      input.update(0, probe.pieces, true, smg::PieceCount().ghostLevels(input, probe.pieces));
    if (cellsOf(piece) > 0)
    {
      const bool isWhole = given == 0 && input.isInMemory() && !smg::hasSeveralProcesses();
      probe.pieces = isWhole ? 1 : count.enough(probe.pieces, *piece);
      probe.isOrdinary = smg::lacksStreamNumbering(isWhole ? *input.update(0, 1, false) : *piece);
      return probe;
    }
  }
  probe.isOrdinary = smg::lacksStreamNumbering(*input.update(0, 1, false));
  return probe;
}

/** Notes for the user on the written file. */
using Notes = std::vector<std::string>;

/** The mesh to write and its destination. */
struct Job
{
  smg::PieceInput& input;
  int pieces;
  std::filesystem::path path;
  /** The .vsm file with the points of no cell; empty: that of the input. */
  std::filesystem::path streamFile;
  bool text; ///< see vtkStreamingMeshWriter::SetWriteText()
  smg::Progress& progress;

  smg::PieceStream stream() const
  {
    return { this->input, { .given = this->pieces },
      { .all = true, .required = {}, .optional = {} } };
  }

  /** Valid after a piece was requested. */
  std::filesystem::path isolatedFrom() const
  {
    return this->streamFile.empty() ? this->input.streamFile() : this->streamFile;
  }

  /** What that file must have; empty: any, as it was named by the user. */
  std::string isolatedFingerprint() const
  {
    return this->streamFile.empty() ? this->input.streamFingerprint() : std::string();
  }

  /** The progress function of a part of the work. */
  smg::ProgressFunction part(double from, double to) const
  {
    return smg::partOf(
      [this](double done)
      {
        this->progress.update(done);
        return true;
      },
      from, to);
  }
};

/** For formats that cannot hold isolated points. */
void noteIsolated(const Job& job, Notes& notes)
{
  const std::filesystem::path from = job.isolatedFrom();
  const std::int64_t count =
    from.empty() ? 0 : smg::VsmReader(from, nullptr, job.isolatedFingerprint()).isolatedVertices();
  if (count > 0)
  {
    notes.push_back(
      "The " +
      smg::counted(count, "point of no cell is left out: a .vsm file keeps it, and so does ",
        "points of no cell are left out: a .vsm file keeps them, and so does ") +
      "RestoreOrder.");
  }
}

Notes writeContainerFile(const Job& job)
{
  smg::PieceStream stream = job.stream();
  smg::writeContainer(
    stream, job.path, false, job.progress, job.isolatedFrom(), job.isolatedFingerprint());
  return {};
}

/** For formats that need counts or last uses in advance: writes the pieces to a container first. */
Notes writeThroughContainer(const Job& job)
{
  const smg::ScratchFolder scratch(std::filesystem::absolute(job.path).parent_path());
  const std::filesystem::path container = scratch.path() / "mesh.vsm";
  smg::PieceStream stream = job.stream();
  smg::checkOutput(job.path, stream.info().cellType);
  smg::Progress half(job.part(0.0, 0.5));
  smg::writeContainer(stream, container, true, half);
  Notes notes =
    smg::writeFromVsm(container, job.path, job.part(0.5, 1.0), scratch.path(), job.text);
  noteIsolated(job, notes);
  return notes;
}

/** Writes in the original order of the container that `makeContainer` writes, in the first half of
 * the work. */
template <class MakeContainer>
Notes restoreOrderOf(const Job& job, smg::CellType cells, MakeContainer&& makeContainer)
{
  smg::checkRestoredPath(job.path, cells);
  smg::Workspace workspace(std::filesystem::absolute(job.path).parent_path(),
    smg::ConversionOptions::DefaultMemory, job.part(0.5, 1.0));
  const std::filesystem::path container = workspace.folder() / "mesh.vsm";
  Notes notes = makeContainer(container);
  workspace.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
  const Notes more = smg::writeRestored(container, job.path, workspace, job.text);
  notes.insert(notes.end(), more.begin(), more.end());
  return notes;
}

/** Writes in the order of the original file. */
Notes writeInOriginalOrder(const Job& job)
{
  smg::PieceStream stream = job.stream();
  return restoreOrderOf(job, stream.info().cellType,
    [&](const std::filesystem::path& container)
    {
      smg::Progress half(job.part(0.0, 0.5));
      smg::writeContainer(
        stream, container, true, half, job.isolatedFrom(), job.isolatedFingerprint());
      return Notes();
    });
}

Notes writeIndexedPieces(const Job& job)
{
  smg::writePieceFiles(job.input, job.pieces, job.path, job.progress);
  Notes notes;
  noteIsolated(job, notes);
  return notes;
}

/** Writes a mesh of any other source that fits into memory: sorts it like `smg convert`, or in its
 * own order, if that is asked for, or the format could have it but has no place for OriginalId. */
Notes writeOrdinary(const Job& job, bool restoreOrder)
{
  auto* mesh = vtkPointSet::SafeDownCast(job.input.update(0, 1, false));
  if (job.input.isPreviewed() || smg::isPreview(*mesh))
  {
    throw smg::Error(
      "The input has lost the point GlobalIds of the Streaming Mesh Reader, and is too large to be "
      "read as a whole: what it gives is its preview. Keep GlobalIds in the filters between, raise "
      "MaximumPointsInMemory, or, to save what is shown, put a Streaming Mesh Preview before "
      "them.");
  }
  const auto sortTo = [&job](vtkPointSet& ordinary, const std::filesystem::path& path, double share)
  {
    smg::ConversionOptions options;
    options.scratch = std::filesystem::absolute(job.path).parent_path();
    options.text = job.text && path == job.path;
    options.progress = job.part(0.0, share);
    return smg::writeOrdinaryMesh(ordinary, path, options).notes;
  };
  const bool forgetsOrder = smg::suffixFor(smg::FormatUse::Restore, job.path) &&
                            !smg::suffixFor(smg::FormatUse::RestoreColumns, job.path);
  if (!restoreOrder && !forgetsOrder)
  {
    return sortTo(*mesh, job.path, 1.0);
  }
  const smg::CellType cells = smg::ordinaryMeshInfo(*mesh).cellType;
  if (!restoreOrder)
  {
    smg::checkOutput(job.path, cells); // whose error names the formats of all orders
  }
  return restoreOrderOf(job, cells,
    [&](const std::filesystem::path& container)
    { return sortTo(*smg::withoutOriginalNumbers(*mesh), container, 0.5); });
}

/** Adds the files of all readers of this library before a filter. */
void addInputs(vtkAlgorithm& filter, smg::UsedFiles& files)
{
  if (auto* reader = vtkStreamingMeshReader::SafeDownCast(&filter))
  {
    const char* stream = reader->GetOutputInformation(0)->Get(vtkStreamingMeshKeys::STREAM_FILE());
    for (const char* name : { static_cast<const char*>(reader->GetFileName()), stream })
    {
      files.readMesh(name ? name : "", "what the " + smg::nameInPipeline(filter) + " reads");
    }
  }
  for (int port = 0; port < filter.GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < filter.GetNumberOfInputConnections(port); ++k)
    {
      addInputs(*filter.GetInputAlgorithm(port, k), files);
    }
  }
}

using WriteFunction = Notes (*)(const Job& job);

/** The function that writes a file of that name. Throws Error if there is none. */
WriteFunction writerOf(const std::filesystem::path& path)
{
  const smg::Format& inPieces = smg::ParallelVtkXmlFormat;
  if (smg::formatOfSuffix(smg::lowerSuffix(path)) == &inPieces)
  {
    return writeIndexedPieces;
  }
  switch (smg::kindOfOutput(path))
  {
    case smg::MeshFileKind::Vsm:
      return writeContainerFile;
    case smg::MeshFileKind::Unknown:
      throw smg::Error(
        path.string() + " has a suffix that cannot be written: use " +
        smg::suffixList(smg::FormatUse::Write, "or") + ", or in pieces " +
        smg::suffixList(inPieces, "or") +
        ". (Of a gigantic mesh, ParaView's own writers have the preview only: to save that, take a "
        "Streaming Mesh Preview.)");
    default:
      return writeThroughContainer;
  }
}

} // namespace

struct vtkStreamingMeshWriter::Internals
{
  explicit Internals(vtkStreamingMeshWriter& self)
    : Self(self)
  {
  }

  /** The arrays to write, with those that tell the original order if that is to be restored. */
  smg::ArrayChoice choice() const
  {
    smg::ArrayChoice choice = this->Choice;
    if (this->Self.RestoreOrder)
    {
      choice.points.insert(smg::OriginalIdName);
      choice.cells.insert(smg::OriginalCellIdName);
    }
    return choice;
  }

  /** Writes the file. Throws Error; `code` is then what an error means that has no code of its own.
   */
  void write(int& code)
  {
    code = vtkErrorCode::NoFileNameError;
    if (this->Self.FileName.empty())
    {
      throw smg::Error("No file is named: set FileName.");
    }
    const std::filesystem::path path = this->Self.FileName;
    code = vtkErrorCode::CannotOpenFileError;
    smg::checkOutputPlace(path);
    smg::UsedFiles files;
    addInputs(this->Self, files);
    files.readMesh(this->Self.StreamFileName, "that of Stream File Name");
    files.writeMesh(path);
    files.check();
    code = vtkErrorCode::UnknownError;
    smg::requireInRange(
      { { "NumberOfPieces", this->Self.NumberOfStreamedPieces, 0, smg::PieceCount::Most } });
    if (smg::isFailed(this->Self.GetInputDataObject(0, 0)))
    {
      // Perhaps no longer, if a filter has been modified since.
      smg::PieceInput(this->Self, 0).update(0, 1, false);
    }
    smg::checkSavedInput(this->Self);
    code = vtkErrorCode::UnrecognizedFileTypeError;
    if (smg::PieceInput(this->Self, 0).isBesideMesh())
    {
      this->writeBesideMesh(path, code);
      return;
    }
    const WriteFunction write = this->Self.RestoreOrder ? writeInOriginalOrder : writerOf(path);
    smg::checkForm(path, this->Self.WriteText);
    code = vtkErrorCode::UnknownError;
    smg::Progress progress(smg::progressOf(this->Self));
    smg::PieceInput all(this->Self, 0);
    if (!this->Self.ChooseArraysToWrite)
    {
      this->write(all, write, path, progress);
      return;
    }
    const auto chosen = smg::passChosenArrays(this->Self.GetInputConnection(0, 0), this->choice());
    smg::PieceInput input(*chosen->GetOutputPort());
    this->write(input, write, path, progress);
  }

  /** Writes what a solver computes besides the mesh, of the whole mesh, whatever is shown. */
  void writeBesideMesh(const std::filesystem::path& path, int& code)
  {
    smg::checkLineFile(path);
    code = vtkErrorCode::UnknownError;
    smg::PieceInput input(this->Self, 0);
    const int pieces = smg::PieceCount{ .given = this->Self.NumberOfStreamedPieces }.first(input);
    auto* lines = vtkPolyData::SafeDownCast(input.update(0, pieces, true));
    if (!lines || lines->GetNumberOfLines() == 0)
    {
      throw smg::Error("There are no lines to save: look at what the filter before delivers.");
    }
    smg::writeLines(*lines, path, this->Self.WriteText);
  }

  void write(smg::PieceInput& input, WriteFunction write, const std::filesystem::path& path,
    smg::Progress& progress)
  {
    if (this->Self.NumberOfStreamedPieces == 0)
    {
      input.hidePieces();
    }
    const InputProbe probe = probeInput(input, this->Self.NumberOfStreamedPieces);
    const Job job{ input, probe.pieces, path, this->Self.StreamFileName, this->Self.WriteText,
      progress };
    Notes notes = probe.isOrdinary && write != writeIndexedPieces
                    ? writeOrdinary(job, this->Self.RestoreOrder)
                    : write(job);
    if (const std::string note = input.noteOnBorders(); !note.empty())
    {
      notes.push_back(note);
    }
    for (const std::string& note : notes)
    {
      const std::string said = smg::withProperties(note, this->Self);
      vtkWarningWithObjectMacro(&this->Self, << smg::oneLine(path.string() + ": " + said));
    }
  }

  vtkStreamingMeshWriter& Self;
  smg::ArrayChoice Choice;
};

vtkStreamingMeshWriter::vtkStreamingMeshWriter()
  : Internal(new Internals(*this))
{
}

vtkStreamingMeshWriter::~vtkStreamingMeshWriter() = default;

void vtkStreamingMeshWriter::AddPointArray(const char* name)
{
  this->Internal->Choice.points.insert(name ? name : "");
  this->Modified();
}

void vtkStreamingMeshWriter::AddCellArray(const char* name)
{
  this->Internal->Choice.cells.insert(name ? name : "");
  this->Modified();
}

void vtkStreamingMeshWriter::RemoveAllPointArrays()
{
  this->Internal->Choice.points.clear();
  this->Modified();
}

void vtkStreamingMeshWriter::RemoveAllCellArrays()
{
  this->Internal->Choice.cells.clear();
  this->Modified();
}

int vtkStreamingMeshWriter::FillInputPortInformation(int, vtkInformation* info)
{
  // Others are refused in a sentence.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

void vtkStreamingMeshWriter::WriteFile()
{
  int code = vtkErrorCode::UnknownError;
  try
  {
    this->Internal->write(code);
    return;
  }
  catch (const smg::Cancelled&)
  {
    code = vtkErrorCode::UserError;
  }
  catch (const smg::InputCancelled&)
  {
    code = vtkErrorCode::UserError;
  }
  catch (const smg::DiskFull& error)
  {
    code = vtkErrorCode::OutOfDiskSpaceError;
    vtkErrorMacro(<< smg::withProperties(smg::oneLine(error.what()), *this));
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< smg::withProperties(smg::oneLine(error.what()), *this));
  }
  this->SetErrorCode(code);
}

int vtkStreamingMeshWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  smg::endAbort(*this);
  this->InvokeEvent(vtkCommand::StartEvent);
  this->WriteData();
  this->InvokeEvent(vtkCommand::EndEvent);
  return this->GetErrorCode() == vtkErrorCode::NoError;
}

void vtkStreamingMeshWriter::WriteData()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isParallel = controller && controller->GetNumberOfProcesses() > 1;
  if (!isParallel || controller->GetLocalProcessId() == 0)
  {
    this->WriteFile();
  }
  if (isParallel)
  {
    auto code = static_cast<int>(this->GetErrorCode());
    controller->Broadcast(&code, 1, 0);
    this->SetErrorCode(code);
  }
  this->WriteTime.Modified();
}

void vtkStreamingMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << smg::textOrNone(this->FileName) << "\n";
  os << indent << "RestoreOrder: " << this->RestoreOrder << "\n";
  os << indent << "WriteText: " << this->WriteText << "\n";
  os << indent << "StreamFileName: " << smg::textOrNone(this->StreamFileName) << "\n";
  os << indent << "NumberOfStreamedPieces: " << this->NumberOfStreamedPieces << "\n";
  os << indent << "ChooseArraysToWrite: " << this->ChooseArraysToWrite << "\n";
}
