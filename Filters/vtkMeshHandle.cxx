// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshHandle.h"

#include "Filters/Handles/vtkFunctionRegion.h"
#include "Filters/Handles/vtkHandleChain.h"
#include "Filters/Handles/vtkHandleDelivery.h"
#include "Filters/Handles/vtkHeldCount.h"
#include "Filters/Handles/vtkPointRegion.h"
#include "Filters/Handles/vtkRegionPoints.h"
#include "Filters/Handles/vtkSelectedPoints.h"
#include "Filters/Handles/vtkWarnOnce.h"
#include "Filters/Streaming/vtkPieceRequest.h"
#include "IO/vtkAlgorithmGlue.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkPieceInput.h"
#include "Solver/Core/Error.h"
#include "Solver/Deformation/HandleMotion.h"

#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLinearTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkSelection.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkMeshHandle);
vtkCxxSetObjectMacro(vtkMeshHandle, RegionFunction, vtkImplicitFunction);
vtkCxxSetObjectMacro(vtkMeshHandle, Transform, vtkLinearTransform);

struct vtkMeshHandle::Internals
{
  explicit Internals(vtkMeshHandle& self)
    : Self(self)
    , FarPoints(self)
    , NoPoint(self)
  {
  }

  smg::HandleMotion motion() const
  {
    switch (this->Self.Motion)
    {
      case SIMILARITY:
      {
        smg::HandleMotion::Parameters parameters;
        std::copy_n(this->Self.Translation, 3, parameters.translation.begin());
        std::copy_n(this->Self.RotationAxis, 3, parameters.axis.begin());
        parameters.degrees = this->Self.RotationAngle;
        std::copy_n(this->Self.Center, 3, parameters.center.begin());
        parameters.scale = this->Self.Scale;
        return smg::HandleMotion(parameters);
      }
      case TRANSFORM:
        if (!this->Self.Transform)
        {
          throw smg::Error("The handle has no transform: set Transform, or choose another Motion.");
        }
        this->Self.Transform->Update();
        return smg::HandleMotion::fromMatrix(
          std::span<const double, 16>(this->Self.Transform->GetMatrix()->GetData(), 16));
      default:
        return {};
    }
  }

  smg::HandleTargets targets() const
  {
    smg::HandleTargets targets{ this->motion(), {} };
    if (this->Self.Region != FUNCTION)
    {
      targets.ofHolders = this->Targets;
    }
    targets.check();
    return targets;
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
      // These are points of the mesh, whatever is displayed of it.
      if (std::optional<std::vector<std::int64_t>> ids = smg::selectedGlobalIds(*selection))
      {
        settings.kind = Kind::Ids;
        settings.ids = std::move(*ids);
        settings.areOriginalIds = false;
      }
    }
    return settings;
  }

  /** Brings the input to the piece asked for and says which of its points are held. */
  vtkPointSet& bring(smg::PieceInput& input, const smg::PieceRequest& request,
    vtkInformationVector** inputVector, smg::HeldPoints& held)
  {
    if (this->Self.Region == FUNCTION)
    {
      auto* piece =
        vtkPointSet::SafeDownCast(input.update(request.Piece, request.Pieces, request.IsStreamed));
      held = smg::heldByFunction(this->Self.RegionFunction, this->Self.InsideOut, *piece);
      return *piece;
    }
    vtkSelection* selection = vtkSelection::GetData(inputVector[1]);
    if (this->Region.set(this->regionSettings(selection)))
    {
      this->FarPoints.forget();
    }
    // Points are sought before the other handles, so that it does not matter that they are moved.
    const bool needsArrays = selection && smg::isByValue(*selection);
    smg::PieceInput mesh(needsArrays ? this->Self : smg::firstOfChain(this->Self), 0);
    const auto stamp = [&mesh, selection, info = inputVector[0]->GetInformationObject(0)]
    {
      return smg::InputStamp{ selection ? selection->GetMTime() : 0, mesh.modifiedTime(),
        smg::timeOf(info) };
    };
    smg::Progress progress(smg::progressOf(this->Self));
    const auto warn = [this](const std::string& sentence) { this->FarPoints.warn(sentence); };
    return this->Region.bring(request, { input, mesh, selection, stamp, progress, warn }, held);
  }

  /** Counts the points that are held; at the end of the mesh, what is sought must be found. */
  void count(vtkPointSet& piece, const smg::HeldPoints& held, const smg::PieceRequest& request)
  {
    const bool isWhole = this->Count.add(piece, held, request);
    if (!isWhole)
    {
      return;
    }
    if (this->Count.allPoints() == 0)
    {
      throw smg::Error("The input has no points, so that the handle has nothing to hold: look at "
                       "what the filter before it delivers.");
    }
    if (smg::isPreview(piece))
    {
      if (this->Count.points() == 0)
      {
        this->NoPoint.warn(
          "No point of the preview lies in the region of the handle, though points of the mesh "
          "may: the preview does not show what the handle does.");
      }
      else
      {
        this->NoPoint.forget();
      }
      return;
    }
    if (this->Self.Region != FUNCTION)
    {
      this->Region.checkHolders(this->Count.isHolding());
    }
    if (this->Count.points() == 0)
    {
      throw smg::Error("The handle holds nothing: no point of the mesh lies in its region.");
    }
  }

  vtkMeshHandle& Self;
  std::vector<std::int64_t> Ids;
  std::vector<double> Points, Targets;
  smg::PointRegion Region;

  smg::HeldCount Count;
  smg::WarnOnce FarPoints, NoPoint;
};

vtkMeshHandle::vtkMeshHandle()
  : Internal(new Internals(*this))
{
  this->SetNumberOfInputPorts(2);
}

vtkMeshHandle::~vtkMeshHandle()
{
  this->SetRegionFunction(nullptr);
  this->SetTransform(nullptr);
}

void vtkMeshHandle::SetSelectionConnection(vtkAlgorithmOutput* selection)
{
  this->SetInputConnection(1, selection);
}

void vtkMeshHandle::AddId(vtkIdType id)
{
  this->Internal->Ids.push_back(id);
  this->Modified();
}

void vtkMeshHandle::RemoveAllIds()
{
  this->Internal->Ids.clear();
  this->Modified();
}

vtkIdType vtkMeshHandle::GetNumberOfIds()
{
  return static_cast<vtkIdType>(this->Internal->Ids.size());
}

vtkIdType vtkMeshHandle::GetId(vtkIdType i)
{
  return i >= 0 && i < this->GetNumberOfIds() ? this->Internal->Ids[i] : -1;
}

void vtkMeshHandle::AddPoint(double x, double y, double z)
{
  this->Internal->Points.insert(this->Internal->Points.end(), { x, y, z });
  this->Modified();
}

void vtkMeshHandle::RemoveAllPoints()
{
  this->Internal->Points.clear();
  this->Modified();
}

vtkIdType vtkMeshHandle::GetNumberOfPoints()
{
  return static_cast<vtkIdType>(this->Internal->Points.size() / 3);
}

void vtkMeshHandle::AddPointTarget(double x, double y, double z)
{
  this->Internal->Targets.insert(this->Internal->Targets.end(), { x, y, z });
  this->Modified();
}

void vtkMeshHandle::RemoveAllPointTargets()
{
  this->Internal->Targets.clear();
  this->Modified();
}

vtkIdType vtkMeshHandle::GetNumberOfPointTargets()
{
  return static_cast<vtkIdType>(this->Internal->Targets.size() / 3);
}

vtkMTimeType vtkMeshHandle::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->RegionFunction)
  {
    time = std::max(time, this->RegionFunction->GetMTime());
  }
  if (this->Transform)
  {
    time = std::max(time, this->Transform->GetMTime());
  }
  return time;
}

int vtkMeshHandle::FillInputPortInformation(int port, vtkInformation* info)
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

int vtkMeshHandle::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return smg::offerPieces(*outputVector);
}

int vtkMeshHandle::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  smg::PieceRequest request(outputVector->GetInformationObject(0));
  request.forwardTo(inputVector[0]->GetInformationObject(0));
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    // Each process selects in what it displays; otherwise the selection is that of the whole.
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

int vtkMeshHandle::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfHeldPoints = 0;
  return smg::answer(*this, *outputVector,
    [&]
    {
      const smg::PieceRequest request(outputVector->GetInformationObject(0));
      const smg::HandleTargets targets = this->Internal->targets();
      smg::PieceInput input(*this, 0);
      smg::HeldPoints held;
      vtkPointSet& piece = this->Internal->bring(input, request, inputVector, held);
      this->Internal->count(piece, held, request);
      smg::deliverHandle(piece, held, targets, *vtkPointSet::GetData(outputVector));
      this->NumberOfHeldPoints = static_cast<vtkIdType>(this->Internal->Count.points());
    });
}

void vtkMeshHandle::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto vector = [&os, indent](const char* name, const double* numbers)
  { os << indent << name << ": " << numbers[0] << " " << numbers[1] << " " << numbers[2] << "\n"; };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Region: " << this->Region << "\n";
  os << indent << "RegionFunction: " << this->RegionFunction << "\n";
  os << indent << "InsideOut: " << this->InsideOut << "\n";
  os << indent << "IdType: " << this->IdType << "\n";
  os << indent << "NumberOfIds: " << this->GetNumberOfIds() << "\n";
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "NumberOfPointTargets: " << this->GetNumberOfPointTargets() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Rings: " << this->Rings << "\n";
  os << indent << "Motion: " << this->Motion << "\n";
  vector("Translation", this->Translation);
  vector("RotationAxis", this->RotationAxis);
  os << indent << "RotationAngle: " << this->RotationAngle << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  vector("Center", this->Center);
  os << indent << "Transform: " << this->Transform << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "NumberOfHeldPoints: " << this->NumberOfHeldPoints << "\n";
}
