// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSmoothing.h"

#include "Filters/Pieces/vtkReplacedArray.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/vtkJobTask.h"
#include "Filters/Tasks/vtkMovedPiece.h"
#include "IO/Files/PartialProgress.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkModeProperty.h"
#include "IO/vtkOrdinaryMesh.h"
#include "IO/vtkPropertyRange.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Smooth.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkStreamingMeshSmoothing);

namespace
{

/** The share of the smoothing in the progress; normals take the rest. */
constexpr double SmoothShare = 0.9;

/** Of the positions, with normals as DeformedVertices if they are needed, or of a point array. */
class SmoothingTask : public smg::JobTask
{
public:
  smg::SmoothingDescription description; ///< without the parts to hold
  bool needsNormals = false;             ///< of the vertices; tetrahedra have none

  SmoothingTask()
    : JobTask("this is the smoothed preview", "smoothed")
  {
  }

  void check() const override { checkOptions(this->given()); }

  smg::Costs costs(const smg::StreamInfo& info) const override
  {
    constexpr int OfPoints = 3;
    return smg::smoothCosts(
      info, smg::expectedComponents(info, this->description.column, OfPoints), this->given());
  }

protected:
  std::unique_ptr<smg::Solution> run(
    const smg::StoredMesh& mesh, const smg::SolveOptions& given) const override
  {
    smg::SolveOptions smoothing = given;
    smoothing.progress = smg::partOf(given.progress, 0.0, this->needsNormals ? SmoothShare : 1.0);
    std::unique_ptr<smg::Solution> solution = smg::smooth(mesh, this->given(), smoothing);
    if (!this->needsNormals)
    {
      return solution;
    }
    smg::NormalsOptions normals;
    normals.scratch = given.scratch;
    normals.memory = std::min(normals.memory, given.memoryLimit / 4);
    normals.progress = smg::partOf(given.progress, SmoothShare, 1.0);
    auto moved = std::make_unique<smg::DeformedVertices>(std::move(solution));
    moved->addNormals(mesh.source({}, {}), normals);
    return moved;
  }

  void adaptTo(vtkPointSet& preview, const smg::StreamInfo& info) override
  {
    smg::SmoothingSize& size = this->description.size;
    if (size.unit == smg::SmoothingSize::MeanEdges && smg::cellsBehind(preview) > 0)
    {
      // Those of the mesh: an area, or a volume, of so many more cells has shorter edges.
      const double share = static_cast<double>(preview.GetNumberOfCells()) /
                           static_cast<double>(smg::cellsBehind(preview));
      size.value *= info.cellType == smg::CellType::Triangle ? std::sqrt(share) : std::cbrt(share);
    }
  }

private:
  smg::Smoothing given() const
  {
    smg::Smoothing given{ this->options, this->description };
    given.hold = this->places;
    return given;
  }
};

} // namespace

vtkStreamingMeshSmoothing::vtkStreamingMeshSmoothing() = default;

vtkStreamingMeshSmoothing::~vtkStreamingMeshSmoothing()
{
  this->SetHold(nullptr);
  this->SetArray(nullptr);
  this->SetColumn(nullptr);
}

std::string vtkStreamingMeshSmoothing::SmoothedArray() const
{
  // "None" is what ParaView offers for no array.
  const auto named = [](const char* name)
  { return name && std::string(name) != "None" ? std::string(name) : std::string(); };
  const std::string array = named(this->Array);
  return array.empty() ? named(this->Column) : array;
}

void vtkStreamingMeshSmoothing::CheckRanges() const
{
  constexpr int MaxSteps = 1000;
  this->Superclass::CheckRanges();
  smg::requireInRange({ { "SizeUnit", this->SizeUnit, MEAN_EDGES, DIAGONAL },
    { "Boundary", this->Boundary, AUTOMATIC, FREE }, { "Normals", this->Normals, RECOMPUTE, DROP },
    { "Steps", this->Steps, 1, MaxSteps } });
  constexpr double NoLimit = smg::RealPropertyRange::NoLimit, StraightAngle = 180.0;
  smg::requireInRealRange({ { "Size", this->Size, 0.0, NoLimit, true } });
  if (this->KeepEdges)
  {
    smg::requireInRealRange({ { "EdgeAngle", this->EdgeAngle, 0.0, StraightAngle, true } });
  }
}

std::string vtkStreamingMeshSmoothing::UnusedProperty()
{
  constexpr double UsualAngle = 30.0;
  return smg::unusedProperty({
    { "EdgeAngle", this->EdgeAngle != UsualAngle, this->KeepEdges, "turn KeepEdges on" },
  });
}

std::unique_ptr<smg::StreamedTask> vtkStreamingMeshSmoothing::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<SmoothingTask>();
  this->FillOptions(task->options);
  smg::SmoothingDescription& description = task->description;
  // Both enumerations have the same order.
  description.size = { this->Size, static_cast<smg::SmoothingSize::Unit>(this->SizeUnit) };
  description.steps = this->Steps;
  description.keepVolume = this->KeepVolume;
  description.column = this->SmoothedArray();
  if (this->KeepEdges)
  {
    description.keepEdges = this->EdgeAngle;
  }
  if (this->Boundary != AUTOMATIC)
  {
    description.boundary = static_cast<smg::SmoothedBoundary>(this->Boundary - SMOOTH);
  }
  task->places = smg::placesOn(input, this->Hold, "Hold");
  if (!description.column.empty())
  {
    task->arrays = { description.column };
  }
  const bool isSurface =
    vtkPolyData::SafeDownCast(&input) ||
    (smg::isOrdinaryMesh(input) && smg::countingCells(input) == smg::CellChoice::Triangles);
  task->needsNormals = description.column.empty() && this->Normals == RECOMPUTE && isSurface &&
                       smg::findNormals(*input.GetPointData());
  return task;
}

int vtkStreamingMeshSmoothing::ComparedColumns(int columns)
{
  return this->SmoothedArray().empty() ? 3 : columns;
}

void vtkStreamingMeshSmoothing::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  if (!this->SmoothedArray().empty())
  {
    output.ShallowCopy(&piece);
    const auto components = static_cast<std::size_t>(this->GetSummary().columns);
    smg::replaceArray(output, this->SmoothedArray(), values, 0, components);
    return;
  }
  smg::movePiece(piece,
    { .values = values,
      .columns = this->GetSummary().columns,
      .needsCellNormals = this->Normals == RECOMPUTE },
    output);
}

void vtkStreamingMeshSmoothing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  constexpr const char* units[] = { "mean edges", "mesh unit", "diagonal" };
  constexpr const char* boundaries[] = { "automatic", "smooth", "fixed", "free" };
  os << indent << "Size: " << this->Size << "\n";
  os << indent << "SizeUnit: " << smg::printedChoice(units, this->SizeUnit) << "\n";
  os << indent << "Steps: " << this->Steps << "\n";
  os << indent << "KeepVolume: " << this->KeepVolume << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "EdgeAngle: " << this->EdgeAngle << "\n";
  os << indent << "Boundary: " << smg::printedChoice(boundaries, this->Boundary) << "\n";
  os << indent << "Hold: " << (this->Hold ? this->Hold : "(none)") << "\n";
  os << indent << "Array: " << (this->Array ? this->Array : "(none)") << "\n";
  os << indent << "Column: " << (this->Column ? this->Column : "(none)") << "\n";
  os << indent << "Normals: " << (this->Normals == RECOMPUTE ? "recompute" : "drop") << "\n";
}
