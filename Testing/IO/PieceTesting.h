// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/IO/PieceRequest.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include "vtkAlgorithm.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace smg::testing
{

/** Adds the columns of points and cells that the tests expect. */
inline void addColumns(StreamMesh& mesh)
{
  std::vector<float> colours;
  for (std::int64_t i = 0; i < mesh.vertices(); ++i)
  {
    colours.insert(colours.end(), { float(i) / 3.0F, float(i), -1.0F });
  }
  std::vector<std::int64_t> cells(mesh.cells());
  for (std::int64_t i = 0; i < mesh.cells(); ++i)
  {
    cells[i] = 1000000 + i;
  }
  mesh.vertexColumns = { makeColumn<std::int64_t>("OriginalId", mesh.originalIds),
    makeColumn<float>("Colours", colours, 3) };
  mesh.cellColumns = { makeColumn<std::int64_t>("OriginalCellId", cells) };
}

/** Writes the mesh unchanged as a .vsm file. */
inline void writeMesh(const std::filesystem::path& path, const StreamMesh& mesh)
{
  MemorySource source(mesh, 500);
  VsmWriter writer(path, source.info());
  MeshBlock block;
  while (source.next(block))
  {
    writer.append(block);
  }
  writer.finish();
}

/** Writes the mesh, in breadth-first order with columns, as a .vsm file. */
inline StreamMesh writeVsm(const std::filesystem::path& path, const IndexedTestMesh& mesh)
{
  StreamMesh stream = toStream(mesh);
  addColumns(stream);
  writeMesh(path, stream);
  return stream;
}

/** The union of pieces: points that are not ghosts by GlobalId, and cells by their ids. */
struct PieceUnion
{
  std::map<std::int64_t, std::array<double, 3>> points;
  std::map<std::int64_t, std::vector<double>> values; ///< of the array `Watched`
  std::map<std::int64_t, std::vector<std::int64_t>> cells;
  std::map<std::int64_t, int> lastPiece;  ///< the last piece that uses the point
  std::map<std::int64_t, int> finalPiece; ///< the piece that calls it final
  std::int64_t ghosts = 0;
  std::string watched;

  void add(vtkPointSet* mesh, int piece)
  {
    if (mesh->GetNumberOfPoints() == 0)
    {
      return;
    }
    auto* ids = vtkIdTypeArray::SafeDownCast(mesh->GetPointData()->GetGlobalIds());
    auto* ghosts =
      vtkUnsignedCharArray::SafeDownCast(mesh->GetPointData()->GetArray("vtkGhostType"));
    auto* finalized = mesh->GetPointData()->GetArray("StreamFinalized");
    ASSERT_TRUE(ids && ghosts);
    vtkDataArray* array =
      this->watched.empty() ? nullptr : mesh->GetPointData()->GetArray(this->watched.c_str());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const std::int64_t id = ids->GetValue(i);
      std::array<double, 3> point;
      mesh->GetPoint(i, point.data());
      this->lastPiece[id] = std::max(this->lastPiece[id], piece);
      if (!finalized || finalized->GetTuple1(i) != 0.0) // else a mesh in one piece
      {
        EXPECT_TRUE(this->finalPiece.emplace(id, piece).second) << "twice final: " << id;
      }
      if (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT)
      {
        ++this->ghosts;
        continue;
      }
      EXPECT_TRUE(this->points.emplace(id, point).second) << "owned twice: " << id;
      if (array)
      {
        const double* tuple = array->GetTuple(i);
        this->values[id].assign(tuple, tuple + array->GetNumberOfComponents());
      }
    }
    vtkDataArray* cellIds = mesh->GetCellData()->GetArray("OriginalCellId");
    ASSERT_TRUE(cellIds);
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
    {
      std::vector<std::int64_t> corners;
      vtkIdList* cell = mesh->GetCell(c)->GetPointIds();
      for (vtkIdType k = 0; k < cell->GetNumberOfIds(); ++k)
      {
        corners.push_back(ids->GetValue(cell->GetId(k)));
      }
      const auto id = static_cast<std::int64_t>(cellIds->GetTuple1(c)) - 1000000;
      EXPECT_TRUE(this->cells.emplace(id, corners).second) << "cell twice: " << id;
    }
  }

  void expectEqual(const StreamMesh& mesh) const
  {
    ASSERT_EQ(std::int64_t(this->points.size()), mesh.vertices());
    ASSERT_EQ(std::int64_t(this->cells.size()), mesh.cells());
    std::int64_t expected = 0;
    for (const auto& [id, point] : this->points)
    {
      ASSERT_EQ(id, expected++);
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_EQ(point[k], mesh.positions[3 * id + k]) << "vertex " << id;
      }
    }
    const int corners = cornersOf(mesh.cellType);
    for (const auto& [id, cell] : this->cells)
    {
      ASSERT_EQ(int(cell.size()), corners);
      for (int k = 0; k < corners; ++k)
      {
        ASSERT_EQ(cell[k], mesh.corners[id * corners + k]) << "cell " << id;
      }
    }
    EXPECT_EQ(this->lastPiece, this->finalPiece);
  }
};

/** A filter that passes its input on, and on request fails or corrupts a piece. */
class vtkFaultyFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkFaultyFilter* New() { VTK_STANDARD_NEW_BODY(vtkFaultyFilter); }
  vtkTypeMacro(vtkFaultyFilter, vtkPassInputTypeAlgorithm);

  int FailAtPiece = -1;
  std::string RemoveArray;
  void (*Spoil)(vtkPointSet* mesh, int piece) = nullptr;
  std::vector<std::string> Requests;

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
    const int pieces = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    this->Requests.push_back(std::to_string(piece) + "/" + std::to_string(pieces));
    if (piece == this->FailAtPiece)
    {
      return 0;
    }
    vtkPointSet* output = vtkPointSet::GetData(info);
    output->ShallowCopy(vtkPointSet::GetData(inputVector[0]));
    if (!this->RemoveArray.empty())
    {
      output->GetPointData()->RemoveArray(this->RemoveArray.c_str());
    }
    if (this->Spoil)
    {
      this->Spoil(output, piece);
    }
    return 1;
  }
};

} // namespace smg::testing
