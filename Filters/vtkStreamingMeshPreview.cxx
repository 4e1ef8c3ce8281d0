// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshPreview.h"

#include "Filters/Pieces/ActiveAttributes.h"
#include "Filters/Pieces/PieceRequest.h"
#include "IO/Preview/StreamPreview.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/PropertyNames.h"
#include "IO/Vtk/PropertyRange.h"
#include "IO/Vtk/SingleBlock.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingMeshPreview);

namespace
{

/** The pieces of an input as a mesh stream that counts its vertices and cells. */
class PulledMesh : public smg::MeshSource
{
public:
  PulledMesh(smg::PieceInput& input, int pieces, const smg::ProgressFunction& progress)
    : Stream(input, { .given = pieces }, { .all = true, .required = {}, .optional = {} })
    , Done(progress)
  {
  }

  const smg::StreamInfo& info() const override { return this->Stream.info(); }

  bool next(smg::MeshBlock& block) override
  {
    this->Done.update(this->Stream.fraction());
    if (!this->Stream.next(block))
    {
      return false;
    }
    this->Vertices += block.vertices();
    this->Cells +=
      static_cast<std::int64_t>(block.corners.size()) / cornersOf(this->info().cellType);
    return true;
  }

  /** The information on the stream, complete after the last block. */
  smg::StreamInfo counted() const
  {
    smg::StreamInfo info = this->info();
    info.vertices = this->Vertices;
    info.cells = this->Cells;
    return info;
  }

private:
  smg::PieceStream Stream;
  smg::Progress Done;
  std::int64_t Vertices = 0, Cells = 0;
};

} // namespace

struct vtkStreamingMeshPreview::Internals
{
  explicit Internals(vtkStreamingMeshPreview& self)
    : Self(self)
  {
  }

  /** Creates the preview unless it exists for this input, whose state is restored. */
  void make(smg::PieceInput& input, const smg::PieceRequest& request, vtkInformation* inputInfo)
  {
    if (this->Preview && this->MadeFor == smg::stampOf(this->Self, input, inputInfo))
    {
      return;
    }
    this->Preview.reset();
    this->Notes.clear();
    PulledMesh mesh(input, this->Self.NumberOfPieces, smg::progressOf(this->Self));
    smg::MeshPiece preview = smg::makePreview(
      mesh, this->Self.PreviewPoints, {}, std::numeric_limits<std::int64_t>::max(), &this->Notes);
    this->Full = mesh.counted();
    if (preview.corners.empty() && this->Full.cells > 0)
    {
      vtkWarningWithObjectMacro(&this->Self, << smg::emptyPreview(this->Self.PreviewPoints));
    }
    this->Preview = std::move(preview);
    vtkDataObject* present = input.update(request.Piece, request.Pieces, false);
    this->Attributes.take(*vtkPointSet::SafeDownCast(present)->GetPointData());
    // Requesting pieces may itself have updated modification times of the pipeline.
    this->MadeFor = smg::stampOf(this->Self, input, inputInfo);
  }

  std::string outcome() const
  {
    if (!this->Failures.isLast(this->Self))
    {
      return "Not applied yet, or a filter before this one failed.";
    }
    if (!this->Failures.error().empty())
    {
      return "Failed: " + this->Failures.error();
    }
    if (!this->Preview)
    {
      return "";
    }
    std::ostringstream text;
    text << smg::groupedDigits(this->Preview->vertices()) << " points and "
         << smg::groupedDigits(static_cast<std::int64_t>(this->Preview->corners.size() / 3))
         << " triangles of " << smg::groupedDigits(this->Full.vertices) << " points and "
         << smg::groupedDigits(this->Full.cells) << " cells";
    for (const std::string& note : this->Notes)
    {
      text << "; " << (note.ends_with('.') ? note.substr(0, note.size() - 1) : note);
    }
    return smg::withProperties(text.str(), this->Self);
  }

  void deliver(vtkPointSet& output) const
  {
    this->deliver(*this->Preview, output);
    this->Attributes.giveTo(*output.GetPointData());
  }

  /** A piece without points, but with all arrays. */
  void deliverNothing(vtkPointSet& input, vtkPointSet& output) const
  {
    smg::MeshPiece empty;
    for (const smg::ColumnSpec& spec : smg::columnSpecs(*input.GetPointData()))
    {
      empty.vertexColumns.push_back({ spec, {} });
    }
    this->deliver(empty, output);
  }

  void deliver(const smg::MeshPiece& piece, vtkPointSet& output) const
  {
    smg::StreamInfo info = this->Full;
    info.cellType = smg::CellType::Triangle;
    smg::setPiece(output, piece, info);
    smg::removeFinalized(output);
    smg::markAsPreview(output, this->Full);
    // The pipeline passes field data; this preview has no larger mesh upstream.
    output.GetFieldData()->RemoveArray(smg::PreviewOfReaderName);
  }

  vtkStreamingMeshPreview& Self;
  smg::Failures Failures;
  std::optional<smg::MeshPiece> Preview;
  std::vector<std::string> Notes; ///< on what the preview does not show
  std::string Outcome;            ///< storage of the text that is returned
  smg::StreamInfo Full;           ///< of the mesh that the preview shows
  smg::ActiveAttributes Attributes;
  smg::InputStamp MadeFor;
};

vtkStreamingMeshPreview::vtkStreamingMeshPreview()
  : Internal(new Internals(*this))
{
}

vtkStreamingMeshPreview::~vtkStreamingMeshPreview() = default;

const char* vtkStreamingMeshPreview::GetOutcome()
{
  this->Internal->Outcome = this->Internal->outcome();
  return this->Internal->Outcome.c_str();
}

const char* vtkStreamingMeshPreview::GetError()
{
  return this->Internal->Failures.error().c_str();
}

vtkIdType vtkStreamingMeshPreview::GetFullNumberOfPoints()
{
  return this->Internal->Failures.isCurrent(*this) ? this->Internal->Full.vertices : 0;
}

vtkIdType vtkStreamingMeshPreview::GetFullNumberOfCells()
{
  return this->Internal->Failures.isCurrent(*this) ? this->Internal->Full.cells : 0;
}

int vtkStreamingMeshPreview::FillInputPortInformation(int, vtkInformation* info)
{
  smg::acceptMeshes(*info);
  return 1;
}

int vtkStreamingMeshPreview::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* output = outputVector->GetInformationObject(0);
  output->Set(vtkStreamingMeshKeys::PREVIEWED(), 1);
  output->Remove(vtkStreamingMeshKeys::STREAM_FILE()); // of which no piece follows
  return smg::offerPieces(*outputVector);
}

int vtkStreamingMeshPreview::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Pieces are requested with the key later; this request only repeats what the input displays.
  smg::PieceRequest request(outputVector->GetInformationObject(0));
  request.IsStreamed = false;
  request.GhostLevels = 0;
  request.forwardTo(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkStreamingMeshPreview::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return smg::runRequestData(*this, this->Internal->Failures, inputVector, *outputVector,
    [&]
    {
      vtkInformation* inputInfo = inputVector[0]->GetInformationObject(0);
      const smg::PieceRequest request(outputVector->GetInformationObject(0));
      smg::requireInRange(
        { { "PreviewPoints", this->PreviewPoints, smg::MinPreviewPoints, smg::MaxPreviewPoints },
          { "NumberOfPieces", this->NumberOfPieces, 0, smg::PieceCount::Most } });
      smg::PieceInput input(*this, 0);
      const vtkSmartPointer<vtkPointSet> shown = smg::meshOf(vtkDataObject::GetData(inputInfo));
      if (shown && smg::lacksStreamNumbering(*shown) && !smg::isPreview(*shown))
      {
        throw smg::Error("Streaming Mesh Preview shows a mesh of the Streaming Mesh Reader: use "
                         "Streaming Mesh Simplification for one that ParaView has in memory.");
      }
      if (request.Piece == 0)
      {
        this->Internal->make(input, request, inputInfo);
        this->Internal->deliver(*vtkPolyData::GetData(outputVector));
      }
      else
      {
        vtkDataObject* present = input.update(request.Piece, request.Pieces, false);
        this->Internal->deliverNothing(
          *vtkPointSet::SafeDownCast(present), *vtkPolyData::GetData(outputVector));
      }
    });
}

void vtkStreamingMeshPreview::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PreviewPoints: " << this->PreviewPoints << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "FullNumberOfPoints: " << this->GetFullNumberOfPoints() << "\n";
  os << indent << "FullNumberOfCells: " << this->GetFullNumberOfCells() << "\n";
  os << indent << "Outcome: " << this->GetOutcome() << "\n";
}
