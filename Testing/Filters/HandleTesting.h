// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Solver/Jobs/Projection/PointProjection.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/MemorySource.h"

#include "vtkInformationIntegerRequestKey.h"

#include <array>
#include <map>
#include <vector>

namespace smg::testing
{

/** The values of the handle arrays at a point. */
struct HandleValue
{
  int mask = 0;
  std::array<double, 3> target{}, rotation{};
  double logScale = 0.0;
  bool operator==(const HandleValue&) const = default;
};

/** The handle arrays of the points that are not ghosts, by GlobalId. */
struct HandleUnion
{
  std::map<std::int64_t, HandleValue> values;
  bool operator==(const HandleUnion&) const = default;

  void add(vtkPointSet* mesh)
  {
    vtkPointData* points = mesh->GetPointData();
    vtkDataArray* ids = points->GetGlobalIds();
    auto* mask = vtkUnsignedCharArray::SafeDownCast(points->GetArray("HandleMask"));
    vtkDataArray* target = points->GetArray("HandleTarget");
    vtkDataArray* rotation = points->GetArray("HandleRotation");
    vtkDataArray* logScale = points->GetArray("HandleLogScale");
    ASSERT_TRUE(ids && mask && target && rotation && logScale);
    vtkUnsignedCharArray* ghosts = mesh->GetPointGhostArray();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      if (ghosts && ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT)
      {
        continue;
      }
      HandleValue value;
      value.mask = mask->GetValue(i);
      target->GetTuple(i, value.target.data());
      rotation->GetTuple(i, value.rotation.data());
      value.logScale = logScale->GetTuple1(i);
      const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
      EXPECT_TRUE(this->values.emplace(id, value).second) << "owned twice: " << id;
    }
  }

  std::vector<std::int64_t> heldIds() const
  {
    std::vector<std::int64_t> ids;
    for (const auto& [id, value] : this->values)
    {
      if (value.mask)
      {
        ids.push_back(id);
      }
    }
    return ids;
  }

  std::int64_t held() const { return static_cast<std::int64_t>(this->heldIds().size()); }
};

/** Requests a piece like a streaming filter; returns 0 if the pipeline failed. */
inline int streamPiece(vtkAlgorithm* algorithm, int piece, int pieces)
{
  using vtkSDDP = vtkStreamingDemandDrivenPipeline;
  auto* executive = vtkSDDP::SafeDownCast(algorithm->GetExecutive());
  vtkNew<vtkInformation> request;
  request->Set(vtkSDDP::UPDATE_PIECE_NUMBER(), piece);
  request->Set(vtkSDDP::UPDATE_NUMBER_OF_PIECES(), pieces);
  request->Set(vtkSDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  request->Set(vtkStreamingMeshKeys::STREAMED(), pieces);
  vtkNew<vtkInformationVector> requests;
  requests->Append(request);
  const int result = executive->Update(0, requests);
  executive->GetOutputInformation(0)->Set(vtkStreamingMeshKeys::STREAMED(), 0);
  return result;
}

inline HandleUnion collectHandles(
  vtkAlgorithm* algorithm, int pieces, int (*update)(vtkAlgorithm*, int, int))
{
  HandleUnion all;
  for (int piece = 0; piece < pieces; ++piece)
  {
    EXPECT_EQ(update(algorithm, piece, pieces), 1);
    all.add(vtkPointSet::SafeDownCast(algorithm->GetOutputDataObject(0)));
  }
  return all;
}

/** Of all pieces, requested in order like a view. */
inline HandleUnion collectPieces(vtkAlgorithm* algorithm, int pieces)
{
  return collectHandles(algorithm, pieces, updatePiece);
}

/** Of the data that a view shows. */
inline HandleUnion collectWhole(vtkAlgorithm* algorithm)
{
  return collectPieces(algorithm, 1);
}

/** Of all pieces, requested in order like a streaming filter. */
inline HandleUnion collectStreamed(vtkAlgorithm* algorithm, int pieces)
{
  return collectHandles(algorithm, pieces, streamPiece);
}

/** The vertices around those with the given indices. */
inline std::vector<std::int64_t> influenced(const StreamMesh& mesh,
  const std::vector<std::int64_t>& vertices, const PointProjection::Influence& influence)
{
  std::vector<double> points;
  for (const std::int64_t v : vertices)
  {
    points.insert(points.end(), mesh.positions.begin() + 3 * v, mesh.positions.begin() + 3 * v + 3);
  }
  PointProjection projection(points, influence, mesh.cellType);
  MemorySource source(mesh);
  MeshBlock block;
  while (source.next(block))
  {
    projection.add(block);
  }
  projection.finish();
  std::vector<std::int64_t> held;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    if (projection.influencing(v, std::span(mesh.positions).subspan(3 * v).first<3>()) >= 0)
    {
      held.push_back(v);
    }
  }
  return held;
}

} // namespace smg::testing
