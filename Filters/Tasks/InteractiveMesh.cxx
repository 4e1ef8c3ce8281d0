// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/InteractiveMesh.h"

#include "Filters/Regions/HandleArrays.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/MovedPiece.h"
#include "Filters/Tasks/SolveSummary.h"
#include "IO/Results/MovedPoints.h"
#include "IO/Vtk/PieceColumns.h"
#include "smg/DescribedHandles.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <tuple>

namespace smg
{
namespace
{

/** Handles of all vertices of a mesh in memory. */
class HandlesInMemory : public Handles
{
public:
  explicit HandlesInMemory(const VertexHandles& handles)
    : All(handles)
  {
  }

  void at(const MeshBlock& block, VertexHandles& handles) override
  {
    const std::int64_t first = block.firstVertex, count = block.vertices();
    std::copy_n(this->All.mask.begin() + first, count, handles.mask.begin());
    std::copy_n(this->All.target.begin() + 3 * first, 3 * count, handles.target.begin());
    std::copy_n(this->All.rotation.begin() + 3 * first, 3 * count, handles.rotation.begin());
    std::copy_n(this->All.logScale.begin() + first, count, handles.logScale.begin());
  }

private:
  const VertexHandles& All;
};

/** The handles that the arrays of the mesh define at the points, in their order. */
VertexHandles handlesAt(vtkPointSet& mesh, const std::vector<std::int64_t>& points)
{
  HandleArrays::require(mesh);
  StreamInfo info;
  info.vertexColumns = columnSpecs(*mesh.GetPointData());
  DescribedHandles described(DeformationDescription::byColumns(), info, "The input");
  MeshBlock block;
  block.positions.resize(3 * points.size()); // the arrays define everything
  for (const std::string& name : described.vertexColumns())
  {
    const auto spec = std::ranges::find(info.vertexColumns, name, &ColumnSpec::name);
    block.vertexColumns.push_back({ *spec, {} });
    copyColumn(*mesh.GetPointData(), points, "The input", block.vertexColumns.back());
  }
  VertexHandles handles;
  handles.clear(points.size());
  described.at(block, handles);
  return handles;
}

/** The options that a hierarchy and its solutions depend on. */
auto keyOf(const DeformOptions& options)
{
  return std::tie(options.operators, options.sweeps, options.tolerance, options.maxCycles,
    options.threads, options.memoryLimit, options.weights, options.cycles);
}

} // namespace

std::vector<double> InteractiveMesh::deform(
  vtkPointSet& mesh, const DeformOptions& options, bool needsNormals)
{
  MeshInMemory present(mesh);
  const VertexHandles handles = handlesAt(mesh, present.points());
  try
  {
    this->update(std::move(present), options, handles);
  }
  catch (...)
  {
    // A failed update leaves an unusable state.
    this->Deformation.reset();
    throw;
  }
  const bool hasNormals = needsNormals && this->Mesh->cellType() == CellType::Triangle;
  this->Columns = hasNormals ? DeformedVertices::WithNormals : 3;
  std::vector<double> values = this->values(mesh, options);
  this->moveLoose(mesh, values);
  return values;
}

void InteractiveMesh::moveLoose(vtkPointSet& mesh, std::vector<double>& values)
{
  std::vector<char> isUsed(static_cast<std::size_t>(mesh.GetNumberOfPoints()), 0);
  for (const std::int64_t point : this->Mesh->points())
  {
    isUsed[point] = 1;
  }
  std::vector<std::int64_t> loose;
  for (std::size_t point = 0; point < isUsed.size(); ++point)
  {
    if (!isUsed[point])
    {
      loose.push_back(static_cast<std::int64_t>(point));
    }
  }
  this->Loose = static_cast<std::int64_t>(loose.size());
  if (loose.empty())
  {
    return;
  }
  const VertexHandles handles = handlesAt(mesh, loose);
  for (std::size_t i = 0; i < loose.size(); ++i)
  {
    if (handles.mask[i])
    {
      std::copy_n(handles.target.begin() + 3 * i, 3, values.begin() + loose[i] * this->Columns);
    }
  }
}

void InteractiveMesh::judge(Report& report) const
{
  NormalsOptions reading;
  reading.scratch = this->Options.scratch;
  MovedPoints moved(this->Mesh->source(), *this->Deformation, &report, reading);
  for (MeshBlock block; moved.next(block);)
  {
  }
  if (this->Loose > 0)
  {
    report.notes.push_back(noteOnLoose(this->Loose, this->Mesh->cellType() == CellType::Triangle) +
                           ": those that a handle holds move with it, others stay");
  }
}

void InteractiveMesh::forget()
{
  this->Deformation.reset();
  this->Mesh.reset();
}

void InteractiveMesh::update(
  MeshInMemory mesh, const DeformOptions& options, const VertexHandles& handles)
{
  if (this->Deformation && this->Mesh == mesh && keyOf(this->Options) == keyOf(options) &&
      this->Deformation->update(handles))
  {
    return;
  }
  this->Deformation.reset();
  this->Mesh = std::move(mesh);
  this->Options = options;
  HandlesInMemory all(handles);
  this->Deformation = std::make_unique<InteractiveDeformation>(*this->Mesh->source(), all, options);
  ++this->Builds;
}

std::vector<double> valuesAtRest(vtkPointSet& mesh, int columns)
{
  std::vector<double> values(mesh.GetNumberOfPoints() * columns, 0.0);
  const bool hasNormals = columns == DeformedVertices::WithNormals;
  vtkDataArray* former = hasNormals ? findNormals(*mesh.GetPointData()) : nullptr;
  for (vtkIdType point = 0; point < mesh.GetNumberOfPoints(); ++point)
  {
    mesh.GetPoint(point, values.data() + point * columns);
    if (former)
    {
      former->GetTuple(point, values.data() + point * columns + 3);
    }
  }
  return values;
}

std::vector<double> InteractiveMesh::values(vtkPointSet& mesh, const DeformOptions& options)
{
  std::vector<double> values = valuesAtRest(mesh, this->Columns);
  const bool hasNormals = this->Columns == DeformedVertices::WithNormals;
  const std::vector<std::int64_t>& points = this->Mesh->points();
  const auto scatter = [&](const auto& numbers, int place)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      std::copy_n(numbers.begin() + 3 * i, 3, values.begin() + points[i] * this->Columns + place);
    }
  };
  std::vector<double> positions(3 * points.size());
  this->Deformation->read(0, this->Mesh->vertices(), positions);
  scatter(positions, 0);
  if (hasNormals)
  {
    MovedPoints moved(this->Mesh->source(), *this->Deformation);
    NormalsOptions normalsOptions;
    normalsOptions.scratch = options.scratch;
    std::vector<float> normals(positions.size());
    VertexNormals(moved, normalsOptions).read(0, this->Mesh->vertices(), normals);
    scatter(normals, 3);
  }
  return values;
}

} // namespace smg
