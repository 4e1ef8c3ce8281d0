// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshArea.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Area.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkTable.h"

namespace smg::testing
{
namespace
{

class VtkStreamingMeshArea : public ::testing::Test
{
protected:
  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = toStream(mesh);
    std::vector<std::int32_t> tags;
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      tags.push_back(static_cast<std::int32_t>(c % 3));
    }
    this->Mesh.cellColumns.push_back(makeColumn<std::int32_t>("tag", tags));
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    writeMesh(this->Folder / name, this->Mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
    this->Area->SetInputConnection(this->Reader->GetOutputPort());
    this->Area->SetNumberOfPieces(5);
    this->Area->SetScratchDirectory(this->Folder.path().c_str());
    this->Area->SetTag("tag");
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingMeshArea> Area;
};

TEST_F(VtkStreamingMeshArea, PiecesHaveTheValuesOfTheLibrary)
{
  for (const IndexedTestMesh& mesh : { torus(40, 20, 0.2), tetBox(6, 5, 4, 0.1) })
  {
    this->open(mesh);
    AreaDescription description;
    description.tag = "tag";
    const auto expected = area(MemoryMesh(this->Mesh), description);
    const Eigen::MatrixXd values = valuesOf(*expected);
    const bool isVolume = this->Mesh.cellType == CellType::Tetrahedron;
    for (int piece = 0; piece < 3; ++piece)
    {
      ASSERT_TRUE(updatePiece(this->Area, piece, 3));
      vtkPointData* points =
        vtkPointSet::SafeDownCast(this->Area->GetOutputDataObject(0))->GetPointData();
      vtkDataArray* shares = points->GetArray(isVolume ? VolumeName : AreaName);
      ASSERT_TRUE(shares);
      for (vtkIdType i = 0; i < shares->GetNumberOfTuples(); ++i)
      {
        const auto id = static_cast<Eigen::Index>(points->GetGlobalIds()->GetTuple1(i));
        ASSERT_EQ(shares->GetTuple1(i), values(id, 0));
      }
    }
    auto* table =
      vtkTable::SafeDownCast(this->Area->GetOutputDataObject(vtkStreamingMeshArea::AREAS));
    ASSERT_TRUE(table);
    ASSERT_EQ(table->GetNumberOfRows(), 3);
    for (vtkIdType k = 0; k < 3; ++k)
    {
      const Report::Area& part = expected->report().areas->by_tag[static_cast<std::size_t>(k)];
      EXPECT_EQ(table->GetValueByName(k, "Tag").ToDouble(), part.tag);
      EXPECT_EQ(table->GetValueByName(k, isVolume ? VolumeName : AreaName).ToDouble(), part.area);
    }
    EXPECT_NE(
      std::string(this->Area->GetNotes()).find(isVolume ? "volume " : "area "), std::string::npos);
  }
}

} // namespace
} // namespace smg::testing
