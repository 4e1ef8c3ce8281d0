// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSimplification.h"

#include "Filters/Pieces/ActiveAttributes.h"
#include "Filters/Pieces/PieceRequest.h"
#include "Filters/RegionChain.h"
#include "Filters/Regions/RegionArrays.h"
#include "Filters/Regions/RegionPoints.h"
#include "Filters/Tasks/SolveEstimate.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/PropertyNames.h"
#include "IO/Vtk/PropertyRange.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Simplify.h"
#include "smg/VsmReader.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingMeshSimplification);

namespace
{

/** The share of reading the input in the progress. */
constexpr double ReadShare = 0.5;
/** The scratch file with a copy of the mesh. */
constexpr const char* Copy = "mesh.vsm";
/** Of the input: all that it has. */
const smg::PieceColumns AllColumns{ .all = true, .required = {}, .optional = {} };

std::string sentence(
  const smg::SimplifyReport& report, const smg::SimplifyTarget& target, bool isSurface)
{
  std::ostringstream text;
  // A number alone is reached from above.
  if (target.error == 0.0 && report.error == 0.0 && report.dropped_bodies == 0 &&
      report.vertices < target.vertices)
  {
    text << "Nothing to simplify: Number Of Vertices is " << smg::groupedDigits(target.vertices)
         << ", which is more than there are. ";
  }
  text << smg::groupedDigits(report.vertices) << " points and " << smg::groupedDigits(report.cells)
       << " triangles of " << (isSurface ? "" : "the surface of a solid of ")
       << smg::groupedDigits(report.vertices_before) << (isSurface ? " and " : " points and ")
       << smg::groupedDigits(report.cells_before) << (isSurface ? "" : " tetrahedra");
  if (!std::isnan(report.error))
  {
    text << ", error " << report.error << (report.dropped_bodies > 0 ? " of what is left" : "");
  }
  for (const std::string& note : report.notes)
  {
    text << "; " << (note.ends_with('.') ? note.substr(0, note.size() - 1) : note);
  }
  return text.str();
}

} // namespace

struct vtkStreamingMeshSimplification::Internals
{
  explicit Internals(vtkStreamingMeshSimplification& self)
    : Self(self)
  {
  }

  /** Makes the result unless it exists for this input, whose state is restored. */
  void make(smg::PieceInput& input, const smg::PieceRequest& request, vtkInformation* inputInfo)
  {
    if (this->Result && this->MadeFor == smg::stampOf(this->Self, input, inputInfo))
    {
      return;
    }
    this->release();
    try
    {
      this->checkRanges();
      this->Scratch.emplace(this->Self.ScratchDirectory);
      const std::filesystem::path result = *this->Scratch / "simplified.vsm";
      vtkPointSet& present =
        *vtkPointSet::SafeDownCast(input.update(request.Piece, request.Pieces, false));
      // Before other pieces are requested, which take its place.
      this->Attributes.take(*present.GetPointData());
      const std::vector<smg::Where> hold = this->held(present);
      const smg::StreamFile file = this->fileOf(input, request, present);
      const smg::VsmReader mesh(file.path, nullptr, file.fingerprint);
      mesh.requireBlocksWithin(this->memory());
      const bool isSurface = mesh.info().cellType == smg::CellType::Triangle;
      this->Report = smg::simplify(mesh, this->target(), result,
        { .hold = hold,
          .memoryLimit = this->memory(),
          .threads = this->Self.GetNumberOfThreads(),
          .codec = smg::Codec::Lz4,
          .scratch = this->Scratch->path(),
          .progress = smg::partOf(smg::progressOf(this->Self), ReadShare, 1.0) });
      this->Report.notes.insert(this->Report.notes.end(), this->Lost.begin(), this->Lost.end());
      smg::FileDescriptor::removeClosed(*this->Scratch / Copy);
      this->Result.emplace(result);
      this->Outcome =
        smg::withProperties(sentence(this->Report, this->target(), isSurface), this->Self);
    }
    catch (const std::exception& error)
    {
      this->release();
      throw;
    }
    input.update(request.Piece, request.Pieces, request.IsStreamed);
    // Requesting pieces may itself have updated modification times of the pipeline.
    this->MadeFor = smg::stampOf(this->Self, input, inputInfo);
  }

  void checkRanges() const
  {
    constexpr int LeastMemory = 16;
    smg::requireInRange({ { "MemoryLimit", this->Self.MemoryLimit, LeastMemory },
      { "NumberOfPieces", this->Self.NumberOfPieces, 0, smg::PieceCount::Most } });
    this->Self.Options->check();
    if (this->Self.GetNumberOfVertices() == 0 && this->Self.GetMaximumError() == 0.0)
    {
      throw smg::Error(
        "Nothing says how far to simplify: set NumberOfVertices, MaximumError or both "
        "above 0.");
    }
  }

  std::string estimate() const
  {
    smg::ConversionOptions places;
    places.scratch = this->Self.ScratchDirectory;
    places.memoryLimit = this->memory();
    return smg::estimateText(this->Self, places,
      [&](const smg::EstimatedInput& mesh, vtkPointSet& present)
      {
        this->checkRanges();
        smg::JobEstimate estimate = smg::simplifyEstimate(mesh, this->target(), "simplified.vsm",
          { .hold = this->held(present), .memoryLimit = this->memory() }, places);
        const bool isCopied = smg::unchangedFile(this->Self, AllColumns).path.empty();
        estimate.cpu_seconds += isCopied ? smg::readingSeconds(mesh.info) : 0.0;
        // The copy and the result are compressed less than a file that is saved, see
        // solveEstimate().
        estimate.scratch_bytes = std::max(
          mesh.conversionScratch, (isCopied ? mesh.streamBytes : 0) + estimate.output_bytes);
        return estimate;
      });
  }

  /** Whether the result is that of the present input. */
  bool isCurrent() const { return this->Result && this->Failures.isCurrent(this->Self); }

  smg::SimplifyTarget target() const
  {
    return { this->Self.GetNumberOfVertices(), this->Self.GetMaximumError() };
  }
  /** What Mesh Regions of the input and Hold name. */
  std::vector<smg::Where> held(vtkPointSet& input) const
  {
    return smg::placesOn(input, this->Self.GetHold(), "Hold");
  }
  std::int64_t memory() const { return std::int64_t(this->Self.MemoryLimit) << 20; }

  void release()
  {
    this->Result.reset();
    this->Scratch.reset();
    this->Report = {};
    this->Outcome.clear();
  }

  /** The mesh as a .vsm file: that of the reader, or a copy in the scratch folder. `present` is
   * what was requested of the input last. */
  smg::StreamFile fileOf(
    smg::PieceInput& input, const smg::PieceRequest& request, vtkPointSet& present)
  {
    this->Lost.clear();
    smg::StreamFile whole = smg::unchangedFile(this->Self, AllColumns);
    if (!whole.path.empty())
    {
      return whole;
    }
    const std::filesystem::path copy = *this->Scratch / Copy;
    const auto progress = smg::partOf(smg::progressOf(this->Self), 0.0, ReadShare);
    if (!smg::hasSeveralProcesses() && smg::lacksStreamNumbering(present) &&
        !smg::isPreview(present))
    {
      input.requireWhole();
      vtkDataObject* mesh = request.Pieces > 1 ? input.update(0, 1, false) : &present;
      smg::ConversionOptions options;
      options.memoryLimit = this->memory();
      options.scratch = this->Scratch->path();
      options.threads = this->Self.GetNumberOfThreads();
      options.progress = progress;
      this->Lost = smg::writeOrdinaryMesh(*vtkPointSet::SafeDownCast(mesh), copy, options).notes;
      return { copy, {} };
    }
    const int given = this->Self.NumberOfPieces;
    const bool isWhole = given == 0 && input.isInMemory() && !smg::hasSeveralProcesses();
    smg::PieceStream stream(input, { .given = isWhole ? 1 : given }, AllColumns);
    smg::Progress done(progress);
    smg::writeContainer(stream, copy, true, done);
    if (const std::string note = input.noteOnBorders(); !note.empty())
    {
      vtkWarningWithObjectMacro(&this->Self, << note << '.');
    }
    return { copy, {} };
  }

  /** Piece `piece` of so many; one that does not exist is empty. */
  void deliver(const smg::PieceRequest& request, vtkPointSet& output)
  {
    const int piece = request.Piece, pieces = request.Pieces;
    const std::int64_t cells = this->Result->info().cells;
    const int part = piece < 0 ? pieces : std::min(piece, pieces);
    const auto firstOf = [&](int p) {
      return static_cast<std::int64_t>(static_cast<__int128>(cells) * std::min(p, pieces) / pieces);
    };
    smg::MeshPiece found;
    this->Result->readPiece(firstOf(part), firstOf(part + 1), found, request.GhostLevels);
    smg::setPiece(output, found, this->Result->info());
    if (pieces == 1)
    {
      smg::removeFinalized(output);
    }
    smg::removePreviewMarks(output);
    this->Attributes.giveTo(*output.GetPointData());
  }

  vtkStreamingMeshSimplification& Self;
  smg::Failures Failures;
  std::optional<smg::ScratchFolder> Scratch;
  std::optional<smg::VsmReader> Result; ///< in the scratch folder
  smg::SimplifyReport Report;
  std::vector<std::string> Lost; ///< notes on what the copy of the input lacks
  std::string Outcome;
  std::string Shown, Json, Estimate; ///< storage of the strings that are returned
  smg::InputStamp MadeFor;
  smg::ActiveAttributes Attributes;
};

vtkStreamingMeshSimplification::vtkStreamingMeshSimplification()
  : Options(new smg::JobProperties("simplify"))
  , Internal(new Internals(*this))
{
  this->SetNumberOfVertices(100000);
}

vtkStreamingMeshSimplification::~vtkStreamingMeshSimplification() = default;

double vtkStreamingMeshSimplification::GetReachedError()
{
  return this->Internal->isCurrent() ? this->Internal->Report.error : smg::SimplifyReport().error;
}

const char* vtkStreamingMeshSimplification::GetEstimate()
{
  this->Internal->Estimate = this->Internal->estimate();
  return this->Internal->Estimate.c_str();
}

const char* vtkStreamingMeshSimplification::GetOutcome()
{
  const std::string& error = this->Internal->Failures.error();
  const bool isLast = this->Internal->Failures.isLast(*this);
  this->Internal->Shown = !isLast          ? "Not applied yet, or a filter before this one failed."
                          : !error.empty() ? "Failed: " + error
                          : this->Internal->isCurrent() ? this->Internal->Outcome
                                                        : "";
  return this->Internal->Shown.c_str();
}

const char* vtkStreamingMeshSimplification::GetError()
{
  return this->Internal->Failures.error().c_str();
}

const char* vtkStreamingMeshSimplification::GetReport()
{
  this->Internal->Json = this->Internal->isCurrent() ? this->Internal->Report.json() : "";
  return this->Internal->Json.c_str();
}

int vtkStreamingMeshSimplification::FillInputPortInformation(int, vtkInformation* info)
{
  smg::acceptMeshes(*info);
  return 1;
}

int vtkStreamingMeshSimplification::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* output = outputVector->GetInformationObject(0);
  output->Set(vtkStreamingMeshKeys::PREVIEWED(), 0);
  output->Remove(vtkStreamingMeshKeys::STREAM_FILE()); // of which no piece follows
  return smg::offerPieces(*outputVector);
}

int vtkStreamingMeshSimplification::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Pieces are requested with the key later; this request only repeats what the input displays.
  smg::PieceRequest request(outputVector->GetInformationObject(0));
  request.IsStreamed = false;
  request.GhostLevels = 0;
  request.forwardTo(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkStreamingMeshSimplification::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return smg::runRequestData(*this, this->Internal->Failures, inputVector, *outputVector,
    [&]
    {
      smg::PieceRequest request(outputVector->GetInformationObject(0));
      request.IsStreamed = false;
      vtkPolyData& output = *vtkPolyData::GetData(outputVector);
      const bool isParallel = smg::hasSeveralProcesses();
      if (isParallel && request.Piece > 0)
      {
        return; // process 0 has all of it
      }
      smg::PieceInput input(*this, 0);
      this->Internal->make(input, request, inputVector[0]->GetInformationObject(0));
      if (isParallel)
      {
        request.Pieces = 1;
      }
      this->Internal->deliver(request, output);
    });
}

void vtkStreamingMeshSimplification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Options->print(os, indent);
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "ScratchDirectory: " << smg::textOrNone(this->ScratchDirectory) << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "ReachedError: " << this->GetReachedError() << "\n";
  os << indent << "Outcome: " << this->GetOutcome() << "\n";
}
