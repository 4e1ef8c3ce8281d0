// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSmoothing.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/MovedPiece.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Jobs/MovedResult.h"
#include "IO/Jobs/SmoothJob.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/ModeProperty.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PropertyRange.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <cmath>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkStreamingMeshSmoothing);

namespace
{

/** Of the positions, with normals as DeformedVertices if they are needed, or of a point array. */
class SmoothingTask : public smg::JobTask
{
public:
  smg::SmoothJob& asked;     ///< the job
  bool needsNormals = false; ///< of the vertices; tetrahedra have none

  SmoothingTask()
    : JobTask("smooth")
    , asked(static_cast<smg::SmoothJob&>(this->job()))
  {
  }

protected:
  void complete(
    Result& result, const smg::StoredMesh& mesh, const smg::ProgressFunction& progress) override
  {
    if (this->needsNormals)
    {
      result.solution = std::make_unique<smg::DeformedVertices>(std::move(result.solution),
        mesh.source({}, {}), smg::normalsOptions(this->asked, progress));
    }
  }

  void adaptTo(vtkPointSet& preview, const smg::StreamInfo& info) override
  {
    smg::SmoothingSize& size = this->asked.smoothing.size;
    if (size.unit == smg::SmoothingSize::MeanEdges && smg::cellsBehind(preview) > 0)
    {
      // Those of the mesh: an area, or a volume, of so many more cells has shorter edges.
      const double share = static_cast<double>(preview.GetNumberOfCells()) /
                           static_cast<double>(smg::cellsBehind(preview));
      size.value *= info.cellType == smg::CellType::Triangle ? std::sqrt(share) : std::cbrt(share);
    }
  }
};

} // namespace

vtkStreamingMeshSmoothing::vtkStreamingMeshSmoothing()
  : vtkStreamingSolver("smooth")
{
}

vtkStreamingMeshSmoothing::~vtkStreamingMeshSmoothing() = default;

std::string vtkStreamingMeshSmoothing::SmoothedArray() const
{
  const std::string& array = this->Options->text("Array");
  return smg::namesArray(array) ? array : smg::namesArray(this->Column) ? this->Column : "";
}

void vtkStreamingMeshSmoothing::CheckRanges() const
{
  this->Superclass::CheckRanges();
  smg::requireInRange({ { "SizeUnit", this->SizeUnit, MEAN_EDGES, DIAGONAL } });
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

std::unique_ptr<smg::JobTask> vtkStreamingMeshSmoothing::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<SmoothingTask>();
  smg::Smoothing& description = task->asked.smoothing;
  this->FillTask(*task, input);
  // Both enumerations have the same order.
  description.size = { this->Size, static_cast<smg::SmoothingSize::Unit>(this->SizeUnit) };
  description.column = this->SmoothedArray();
  if (this->KeepEdges)
  {
    description.keepEdges = this->EdgeAngle;
  }
  const bool isSurface =
    vtkPolyData::SafeDownCast(&input) ||
    (smg::lacksStreamNumbering(input) && smg::countingCells(input) == smg::CellChoice::Triangles);
  task->needsNormals = description.column.empty() && this->GetNormals() == RECOMPUTE && isSurface &&
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
      .needsCellNormals = this->GetNormals() == RECOMPUTE },
    output);
}

void vtkStreamingMeshSmoothing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  constexpr const char* units[] = { "mean edges", "mesh unit", "diagonal" };
  os << indent << "Size: " << this->Size << "\n";
  os << indent << "SizeUnit: " << smg::printedChoice(units, this->SizeUnit) << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "EdgeAngle: " << this->EdgeAngle << "\n";
  os << indent << "Column: " << smg::textOrNone(this->Column) << "\n";
}
