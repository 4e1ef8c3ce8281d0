// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkRegionFilter.h"

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/RegionChain.h"
#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/MarkedRegion.h"
#include "Filters/Regions/PointRegion.h"
#include "Filters/Regions/RegionPoints.h"
#include "Filters/Tasks/WarnOnce.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/ModeProperty.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/PropertyRange.h"
#include "IO/Vtk/SingleBlock.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Projection/PointProjection.h"
#include "smg/Error.h"

#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkSelection.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

vtkCxxSetObjectMacro(vtkRegionFilter, RegionFunction, vtkImplicitFunction);

struct vtkRegionFilter::Internals
{
  explicit Internals(vtkRegionFilter& self)
    : Self(self)
    , FarPoints(self)
    , NoPoint(self)
    , Unused(self)
    , Replaced(self)
  {
  }

  smg::PointRegionSettings regionSettings(vtkSelection* selection) const
  {
    using Kind = smg::PointRegionSettings::Kind;
    smg::PointRegionSettings settings;
    settings.kind = this->Self.Region == SELECTION ? Kind::Selection
                    : this->Self.Region == IDS     ? Kind::Ids
                                                   : Kind::Points;
    settings.ids = this->Ids;
    settings.areOriginalIds = this->Self.IdType == ORIGINAL_IDS;
    settings.points = this->Points;
    settings.radius = this->Self.Radius;
    settings.rings = this->Self.Rings;
    settings.pieces = this->Self.NumberOfPieces;
    if (settings.kind == Kind::Selection && selection)
    {
      // GlobalIds refer to points of the mesh, also if a preview is displayed.
      if (std::optional<std::vector<std::int64_t>> ids = smg::selectedGlobalIds(*selection))
      {
        settings.kind = Kind::Ids;
        settings.ids = std::move(*ids);
        settings.areOriginalIds = false;
      }
    }
    return settings;
  }

  smg::MarkedRegionSettings markedSettings() const
  {
    smg::MarkedRegionSettings settings;
    if (this->Self.Region == GROUP)
    {
      settings.group = this->Self.RegionGroup();
    }
    else if (this->Self.Region != BOUNDARY)
    {
      settings.array = this->Self.RegionArray();
    }
    if (this->Self.Region == TAG)
    {
      settings.tag = this->Self.Tag;
    }
    settings.pieces = this->Self.NumberOfPieces;
    return settings;
  }

  /** Throws Error, which names the property, if a number of the chosen
   * region is out of its range. */
  void checkNumbers() const
  {
    constexpr double Automatic = -1.0;
    const int region = this->Self.Region;
    if (this->isOfPoints() && this->Self.Radius != Automatic)
    {
      smg::requireInRealRange({ { "Radius", this->Self.Radius, 0.0, smg::RealPropertyRange::NoLimit,
        false, "-1 (automatic)" } });
    }
    if (region == TAG)
    {
      smg::requireInRealRange({ { "Tag", this->Self.Tag } });
    }
    for (std::size_t i = 0; region == IDS && i < this->Ids.size(); ++i)
    {
      smg::requireInRange({ { "Ids", this->Ids[i], 0 } });
    }
    for (std::size_t i = 0; region == POINTS && i < this->Points.size(); ++i)
    {
      smg::requireInRealRange({ { "Points", this->Points[i] } });
    }
  }

  /** Whether the region consists of single points. */
  bool isOfPoints() const
  {
    return this->Self.Region == SELECTION || this->Self.Region == IDS ||
           this->Self.Region == POINTS;
  }

  /** Whether the held points of the requested piece are sought: those of a group that the solver
   * evaluates are for views alone. */
  bool seeks(const smg::PieceRequest& request) const
  {
    return !this->Self.IsEvaluatedBySolver() || (this->Self.Region == GROUP && !request.IsStreamed);
  }

  /** Updates the input to the requested piece and determines its held points, if they are sought.
   */
  vtkPointSet& fetchPiece(smg::PieceInput& input, const smg::PieceRequest& request,
    vtkInformationVector** inputVector, smg::HeldPoints& held)
  {
    const bool seeks = this->seeks(request);
    if (seeks && this->Self.Region != FUNCTION && this->Self.Region != EVERYWHERE)
    {
      return this->search(input, request, inputVector, held);
    }
    auto* piece = vtkPointSet::SafeDownCast(request.update(input));
    if (seeks)
    {
      held = this->Self.Region == EVERYWHERE
               ? smg::heldEverywhere(*piece)
               : smg::heldByFunction(this->Self.RegionFunction, this->Self.InsideOut, *piece);
    }
    return *piece;
  }

  /** The same for a region that may have to be searched on the whole mesh. */
  vtkPointSet& search(smg::PieceInput& input, const smg::PieceRequest& request,
    vtkInformationVector** inputVector, smg::HeldPoints& held)
  {
    vtkSelection* selection = this->isOfPoints() ? vtkSelection::GetData(inputVector[1]) : nullptr;
    if (!this->isOfPoints())
    {
      this->Marked.set(this->markedSettings());
    }
    else if (this->Region.set(this->regionSettings(selection)))
    {
      this->FarPoints.forget();
    }
    // Upstream of the other region filters, so that changes of these, such as the motion of a
    // handle, have no effect.
    const bool needsArrays = selection && smg::isByValue(*selection);
    smg::PieceInput mesh(needsArrays ? this->Self : smg::firstOfChain(this->Self), 0);
    const auto stamp = [&mesh, selection, info = inputVector[0]->GetInformationObject(0)]
    {
      return smg::InputStamp{ selection ? selection->GetMTime() : 0, mesh.modifiedTime(),
        smg::timeOf(info) };
    };
    smg::Progress progress(smg::progressOf(this->Self));
    const auto warn = [this](const std::string& sentence) { this->FarPoints.warn(sentence); };
    const smg::RegionContext context{ input, mesh, selection, this->Selected, stamp, progress,
      warn };
    return this->isOfPoints() ? this->Region.fetchPiece(request, context, held)
                              : this->Marked.fetchPiece(request, context, held);
  }

  /** Counts the held points; at the end of the mesh, all requested points must have been found. */
  void count(vtkPointSet& piece, const smg::HeldPoints& held, const smg::PieceRequest& request)
  {
    const bool isWhole = this->Count.add(piece, held, request);
    this->PointsBehind = smg::pointsBehind(piece);
    if (!isWhole)
    {
      return;
    }
    if (this->Count.allPoints() == 0)
    {
      throw smg::Error("The input has no points, so that the region has nothing to hold: look at "
                       "what the filter before it delivers.");
    }
    if (smg::isPreview(piece))
    {
      if (this->Count.points() == 0)
      {
        this->NoPoint.warn(
          std::string("No point of the preview lies in the region, though points of the mesh may") +
          (smg::isSurfaceOfSolid(piece) ? std::string(": ") + smg::RemedyOfSurface + "." : "."));
      }
      else
      {
        this->NoPoint.forget();
      }
      return;
    }
    if (this->isOfPoints())
    {
      this->Region.checkHolders(this->Count.isHolding());
    }
    if (this->Count.points() == 0)
    {
      throw smg::Error(this->Self.Region == BOUNDARY
                         ? "The region holds nothing: the mesh is closed, without a boundary."
                         : "The region holds nothing: no point of the mesh lies in it.");
    }
  }

  /** As "223 points." or "2,434 points of the preview, which has 10,000 of 66,313 points." */
  std::string countText(std::int64_t heldPoints) const
  {
    const std::string held =
      smg::groupedDigits(heldPoints) + (heldPoints == 1 ? " point" : " points");
    return this->PointsBehind == 0
             ? held + "."
             : held + " of the preview, which has " + smg::groupedDigits(this->Count.allPoints()) +
                 " of " + smg::groupedDigits(this->PointsBehind) + " points.";
  }

  vtkRegionFilter& Self;
  smg::Failures Failures;
  std::vector<std::int64_t> Ids;
  std::vector<double> Points;
  smg::PointRegion Region;
  smg::KeptSelection Selected;
  smg::MarkedRegion Marked;
  vtkNew<vtkStringArray> GroupNames;

  smg::HeldCount Count;
  bool HasSought = false;        ///< in the last request
  std::int64_t PointsBehind = 0; ///< of a preview, whose points were counted
  std::string Outcome;
  smg::WarnOnce FarPoints, NoPoint, Unused, Replaced;
};

vtkRegionFilter::vtkRegionFilter()
  : Internal(new Internals(*this))
{
  this->SetNumberOfInputPorts(2);
}

vtkRegionFilter::~vtkRegionFilter()
{
  this->SetRegionFunction(nullptr);
}

std::string vtkRegionFilter::RegionArray() const
{
  const std::string& name = this->Region == TAG ? this->TagArray : this->MaskArray;
  if (!smg::namesArray(name))
  {
    throw smg::Error(std::string("The region has no ") + (this->Region == TAG ? "tag" : "mask") +
                     " array: choose " + (this->Region == TAG ? "TagArray" : "MaskArray") +
                     ", or another Region.");
  }
  return name;
}

std::string vtkRegionFilter::RegionGroup() const
{
  if (!smg::namesArray(this->GroupName))
  {
    throw smg::Error("The region has no group: choose GroupName, or another Region.");
  }
  return this->GroupName;
}

vtkStringArray* vtkRegionFilter::GetGroupNames()
{
  vtkStringArray& names = *this->Internal->GroupNames;
  names.Reset();
  const bool isConnected = this->GetNumberOfInputConnections(0) > 0;
  vtkDataObject* const input = isConnected ? this->GetInputDataObject(0, 0) : nullptr;
  try
  {
    const vtkSmartPointer<vtkPointSet> mesh = input ? smg::meshOf(input) : nullptr;
    const smg::MeshGroups groups = mesh ? smg::groupsIn(*mesh) : smg::MeshGroups();
    for (const smg::Group& group : groups.groups)
    {
      // Groups of faces and of cells may have the same name.
      if (names.LookupValue(group.label()) < 0)
      {
        names.InsertNextValue(group.label());
      }
    }
  }
  catch (const smg::Error&)
  {
    // What is no mesh has no groups; the request for it says so.
  }
  return &names;
}

void vtkRegionFilter::WarnOfReplaced(const std::string& sentence)
{
  this->Internal->Replaced.warn(sentence);
}

std::string vtkRegionFilter::UnusedProperty()
{
  // Panels hide what another chosen region does not use, and keep it.
  const bool isChosen = this->Region != FUNCTION;
  return smg::unusedProperty({
    { "InsideOut", this->InsideOut, !isChosen, "set Region to Function" },
    { "Selection", this->GetNumberOfInputConnections(1) > 0, isChosen, "set Region to Selection" },
    { "Ids", !this->Internal->Ids.empty(), isChosen, "set Region to Ids" },
    { "IdType", this->IdType != GLOBAL_IDS, isChosen, "set Region to Ids" },
    { "Points", !this->Internal->Points.empty(), isChosen, "set Region to Points" },
    { "Radius", this->Radius >= 0.0, isChosen, "set Region to Selection, Ids or Points" },
    { "Rings", this->Rings > 0, isChosen, "set Region to Selection, Ids or Points" },
    { "MaskArray", smg::namesArray(this->MaskArray), isChosen, "set Region to Mask" },
    { "TagArray", smg::namesArray(this->TagArray), isChosen, "set Region to Tag" },
    { "Tag", this->Tag != 0.0, isChosen, "set Region to Tag" },
    { "GroupName", smg::namesArray(this->GroupName), isChosen, "set Region to Group" },
  });
}

void vtkRegionFilter::SetSelectionConnection(vtkAlgorithmOutput* selection)
{
  this->SetInputConnection(1, selection);
}

void vtkRegionFilter::AddId(vtkIdType id)
{
  this->Internal->Ids.push_back(id);
  this->Modified();
}

void vtkRegionFilter::RemoveAllIds()
{
  this->Internal->Ids.clear();
  this->Modified();
}

vtkIdType vtkRegionFilter::GetNumberOfIds()
{
  return static_cast<vtkIdType>(this->Internal->Ids.size());
}

vtkIdType vtkRegionFilter::GetId(vtkIdType i)
{
  return i >= 0 && i < this->GetNumberOfIds() ? this->Internal->Ids[i] : -1;
}

void vtkRegionFilter::AddPoint(double x, double y, double z)
{
  this->Internal->Points.insert(this->Internal->Points.end(), { x, y, z });
  this->Modified();
}

void vtkRegionFilter::RemoveAllPoints()
{
  this->Internal->Points.clear();
  this->Modified();
}

vtkIdType vtkRegionFilter::GetNumberOfPoints()
{
  return static_cast<vtkIdType>(this->Internal->Points.size() / 3);
}

double* vtkRegionFilter::GetHeldBounds()
{
  std::fill_n(this->HeldBounds, 6, 0.0);
  const bool isConnected = this->GetNumberOfInputConnections(0) > 0;
  auto* input = isConnected ? vtkPointSet::SafeDownCast(this->GetInputDataObject(0, 0)) : nullptr;
  if (this->NumberOfHeldPoints > 0)
  {
    this->Internal->Count.bounds().GetBounds(this->HeldBounds);
  }
  else if (input && input->GetNumberOfPoints() > 0)
  {
    input->GetBounds(this->HeldBounds);
  }
  return this->HeldBounds;
}

const char* vtkRegionFilter::GetOutcome()
{
  const std::string& error = this->Internal->Failures.error();
  std::string& text = this->Internal->Outcome;
  const bool isLast = this->Internal->Failures.isLast(*this);
  text = !isLast                      ? "Not applied yet, or a filter before this one failed."
         : !error.empty()             ? "Failed: " + error
         : !this->Internal->HasSought ? "The region is sought when the mesh is solved on."
                                      : this->Internal->countText(this->NumberOfHeldPoints);
  return text.c_str();
}

const char* vtkRegionFilter::GetError()
{
  return this->Internal->Failures.error().c_str();
}

vtkMTimeType vtkRegionFilter::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->RegionFunction ? std::max(time, this->RegionFunction->GetMTime()) : time;
}

int vtkRegionFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  smg::acceptMeshes(*info);
  return 1;
}

int vtkRegionFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return smg::offerPieces(*outputVector);
}

int vtkRegionFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  smg::PieceRequest request(outputVector->GetInformationObject(0));
  request.forwardTo(inputVector[0]->GetInformationObject(0));
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    // A displayed selection refers to the data of each process, any other to the whole mesh.
    if (request.IsStreamed || !smg::hasSeveralProcesses())
    {
      request.Piece = 0;
      request.Pieces = 1;
    }
    request.IsStreamed = false;
    request.forwardTo(inputVector[1]->GetInformationObject(0));
  }
  return 1;
}

int vtkRegionFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfHeldPoints = 0;
  return smg::runRequestData(*this, this->Internal->Failures, inputVector, *outputVector,
    [&]
    {
      const smg::PieceRequest request(outputVector->GetInformationObject(0));
      smg::requireInRange({ { "Region", this->Region, FUNCTION, GROUP },
        { "IdType", this->IdType, GLOBAL_IDS, ORIGINAL_IDS },
        { "Rings", this->Rings, 0, smg::PointProjection::MaximumRings },
        { "NumberOfPieces", this->NumberOfPieces, 0, smg::PieceCount::Most } });
      this->Internal->checkNumbers();
      this->Check();
      this->Internal->Unused.warn(this->UnusedProperty());
      smg::PieceInput input(*this, 0);
      smg::HeldPoints held;
      vtkPointSet& piece = this->Internal->fetchPiece(input, request, inputVector, held);
      const bool holds = this->Internal->HasSought = this->Internal->seeks(request);
      if (holds)
      {
        this->Internal->count(piece, held, request);
      }
      this->Deliver(piece, held, *vtkPointSet::GetData(outputVector));
      this->NumberOfHeldPoints = holds ? static_cast<vtkIdType>(this->Internal->Count.points()) : 0;
    });
}

void vtkRegionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Region: " << this->Region << "\n";
  os << indent << "RegionFunction: " << this->RegionFunction << "\n";
  os << indent << "InsideOut: " << this->InsideOut << "\n";
  os << indent << "IdType: " << this->IdType << "\n";
  os << indent << "NumberOfIds: " << this->GetNumberOfIds() << "\n";
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Rings: " << this->Rings << "\n";
  os << indent << "MaskArray: " << smg::textOrNone(this->MaskArray) << "\n";
  os << indent << "TagArray: " << smg::textOrNone(this->TagArray) << "\n";
  os << indent << "Tag: " << this->Tag << "\n";
  os << indent << "GroupName: " << smg::textOrNone(this->GroupName) << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "NumberOfHeldPoints: " << this->NumberOfHeldPoints << "\n";
}
