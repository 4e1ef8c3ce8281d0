// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingDistance.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceColumns.h"
#include "Solver/Core/Text.h"
#include "smg/Deform.h"
#include "smg/Error.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkStreamingDistance);

namespace
{

/** What to do about sources that a preview does not have. */
constexpr const char* HintOnPreview =
  " This is about the preview, which has few vertices of the mesh: Save Data measures on the mesh "
  "itself; {\"nearest\": [[x, y, z]]} and Mesh Regions select sources on both.";

class DistanceTask : public smg::JobTask
{
public:
  smg::DistanceJob& asked; ///< the job
  std::size_t regions = 0; ///< to measure from, on the mesh

  DistanceTask()
    : JobTask("distance")
    , asked(static_cast<smg::DistanceJob&>(this->job()))
  {
  }

  void check() const override
  {
    if (this->asked.description.from.empty() && !this->asked.description.wall)
    {
      throw smg::Error(
        "Nothing says where the distance is 0: put a Mesh Region before this filter, or set From "
        "(advanced), for example {\"vertices\": [5]}.");
    }
  }

protected:
  std::string resultOnPreview() const override { return "these are distances on the preview"; }

  std::unique_ptr<smg::Solution> run(
    const smg::StoredMesh& mesh, const smg::ProgressFunction& progress) override
  {
    try
    {
      return this->JobTask::run(mesh, progress);
    }
    catch (const smg::Cancelled&)
    {
      throw;
    }
    catch (const smg::Error& error)
    {
      throw smg::Error(error.what() + std::string(this->IsOnPreview ? HintOnPreview : ""));
    }
  }

  void adaptTo(vtkPointSet& /*preview*/, const smg::StreamInfo& /*info*/) override
  {
    this->IsOnPreview = true;
    // A region less would change the indices of those after it.
    const smg::DistanceDescription& description = this->asked.description;
    const bool misses = description.group && description.from.size() < this->regions;
    if (misses || (description.from.empty() && !description.wall))
    {
      throw smg::Error(
        std::string("No point of the preview lies in the region from which to measure.") +
        HintOnPreview);
    }
  }

  void complete(
    Result& result, const smg::StoredMesh& /*mesh*/, const smg::ProgressFunction&) override
  {
    smg::Report& report = result.report;
    if (report.distance && report.distance->unreached > 0)
    {
      report.notes.push_back(
        smg::counted(report.distance->unreached,
          "vertex is not reached from any source: its distance is infinite",
          "vertices are not reached from any source: their distance is infinite") +
        ", of which Clip and Contour make points without a place: put a Threshold before them");
    }
  }

private:
  bool IsOnPreview = false;
};

} // namespace

vtkStreamingDistance::vtkStreamingDistance()
  : vtkStreamingSolver("distance")
{
  this->SetNumberOfOutputPorts(PATHS + 1);
}

vtkStreamingDistance::~vtkStreamingDistance() = default;

int vtkStreamingDistance::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port != PATHS)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

void vtkStreamingDistance::FillFurtherOutputs(
  const smg::SolveSummary& summary, vtkInformationVector& outputVector)
{
  this->Superclass::FillFurtherOutputs(summary, outputVector);
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> lines;
  const vtkNew<vtkTypeInt64Array> to, from;
  const vtkNew<vtkDoubleArray> length;
  const auto found = summary.facts.distance.value_or(smg::Report::Distance());
  for (const smg::Report::Path& path : found.paths)
  {
    if (path.points.empty())
    {
      continue;
    }
    lines->InsertNextCell(static_cast<int>(path.points.size()));
    for (const auto& point : path.points)
    {
      lines->InsertCellPoint(points->InsertNextPoint(point.data()));
    }
    to->InsertNextValue(path.to);
    from->InsertNextValue(path.from);
    length->InsertNextValue(path.length);
  }
  vtkPolyData& paths = *vtkPolyData::GetData(&outputVector, PATHS);
  paths.Initialize();
  paths.SetPoints(points);
  paths.SetLines(lines);
  if (summary.previewPoints > 0)
  {
    // Save Data then asks for those of the mesh.
    smg::copyPreviewMarks(*vtkDataObject::GetData(&outputVector, MESH), paths);
  }
  const std::pair<const char*, vtkDataArray*> arrays[] = { { "To", to }, { "From", from },
    { "Length", length } };
  for (const auto& [name, array] : arrays)
  {
    array->SetName(name);
    paths.GetCellData()->AddArray(array);
  }
}

void vtkStreamingDistance::CheckRanges() const
{
  this->Superclass::CheckRanges();
  if (!this->Options->text("To").empty() && this->Options->number("Wall") != 0.0)
  {
    throw smg::Error(
      "To are the ends of paths along a surface, which distances to a wall do not have: "
      "leave To empty, or turn Wall off.");
  }
}

std::unique_ptr<smg::JobTask> vtkStreamingDistance::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<DistanceTask>();
  this->FillTask(*task, input);
  if (this->GetWall() && this->GetWithin() > 0.0)
  {
    throw smg::Error(
      "Within is the largest length of paths, which distances to a wall are not: set "
      "Within to 0, or turn Wall off.");
  }
  smg::DistanceDescription& description = task->asked.description;
  if (description.from.empty() && !description.wall &&
      input.GetPointData()->HasArray(smg::HandleMaskName))
  {
    description.from.emplace_back(smg::ColumnMask{ smg::HandleMaskName });
  }
  task->regions = description.from.size();
  return task;
}

void vtkStreamingDistance::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  // Sources and directions of other distances would be taken for those of these.
  output.GetPointData()->RemoveArray(smg::DistanceSourceName);
  output.GetPointData()->RemoveArray(smg::DistanceGroupName);
  output.GetPointData()->RemoveArray(smg::DistanceDirectionName);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  std::size_t first = 0;
  const auto points = stride == 0 ? 0 : static_cast<std::size_t>(piece.GetNumberOfPoints());
  smg::DistanceJob asked;
  this->Options->applyTo(asked);
  for (const smg::ColumnSpec& spec : smg::distanceColumns(asked.description))
  {
    smg::Column column{ spec, {} };
    column.resize(points);
    const auto components = static_cast<std::size_t>(spec.components);
    const double ofNoCell = spec.isolated.value_or(0.0);
    smg::dispatch(spec.type,
      [&]<class T>(T)
      {
        const std::span<T> to = column.as<T>();
        for (std::size_t i = 0; i < to.size(); ++i)
        {
          const double value = values[i / components * stride + first + i % components];
          to[i] = static_cast<T>(std::isnan(value) ? ofNoCell : value);
        }
      });
    smg::addResult(*output.GetPointData(), *smg::makeArray(column));
    first += components;
  }
  output.GetPointData()->SetActiveScalars(smg::DistanceName);
}
