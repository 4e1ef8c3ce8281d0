// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkDataArraySelection.h"
#include "vtkFieldData.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <fstream>
#include <sstream>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshReader : public ::testing::Test
{
protected:
  StreamMesh open(const IndexedTestMesh& mesh)
  {
    const std::filesystem::path path = this->Folder / "mesh.vsm";
    StreamMesh stream = writeVsm(path, mesh);
    this->Reader->SetFileName(path.c_str());
    return stream;
  }

  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0)); }

  void expectUnion(const StreamMesh& mesh, int pieces)
  {
    PieceUnion all;
    for (int piece = 0; piece < pieces; ++piece)
    {
      ASSERT_TRUE(updatePiece(this->Reader, piece, pieces));
      all.add(this->output(), piece);
    }
    all.expectEqual(mesh);
    EXPECT_EQ(pieces == 1, all.ghosts == 0);
  }

  TemporaryFolder Folder;
  vtkNew<vtkStreamingMeshReader> Reader;
};

TEST_F(VtkStreamingMeshReader, UnionOfPiecesIsTheSurface)
{
  const StreamMesh mesh = this->open(torus(60, 30, 0.2));
  for (const int pieces : { 1, 2, 7, 64 })
  {
    this->expectUnion(mesh, pieces);
  }
  EXPECT_TRUE(vtkPolyData::SafeDownCast(this->output()));
}

TEST_F(VtkStreamingMeshReader, UnionOfPiecesIsTheVolume)
{
  const StreamMesh mesh = this->open(tetBox(9, 8, 7, 0.1));
  for (const int pieces : { 1, 2, 7, 64 })
  {
    this->expectUnion(mesh, pieces);
  }
  EXPECT_TRUE(vtkUnstructuredGrid::SafeDownCast(this->output()));
}

TEST_F(VtkStreamingMeshReader, MorePiecesThanCells)
{
  const StreamMesh mesh = this->open(grid(2, 3));
  this->expectUnion(mesh, 100);
}

TEST_F(VtkStreamingMeshReader, AnyOrderGivesTheSamePieces)
{
  const StreamMesh mesh = this->open(torus(40, 20));
  for (const int piece : { 6, 0, 3, 3, 1, 5, 2, 4 })
  {
    ASSERT_TRUE(updatePiece(this->Reader, piece, 7));
    PieceUnion once;
    once.add(this->output(), piece);
    const std::int64_t first = mesh.cells() * piece / 7;
    ASSERT_EQ(std::int64_t(once.cells.size()), mesh.cells() * (piece + 1) / 7 - first);
    for (const auto& [cell, corners] : once.cells)
    {
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_EQ(corners[k], mesh.corners[3 * cell + k]);
      }
    }
    EXPECT_EQ(once.cells.begin()->first, first);
  }
}

TEST_F(VtkStreamingMeshReader, ColumnsBecomeArraysAndCanBeLeftOut)
{
  const StreamMesh mesh = this->open(torus(12, 9));
  ASSERT_TRUE(updatePiece(this->Reader, 1, 3));
  vtkPointData* points = this->output()->GetPointData();
  auto* ids = points->GetGlobalIds();
  auto* originals = points->GetArray("OriginalId");
  auto* colours = points->GetArray("Colours");
  ASSERT_TRUE(ids && originals && colours);
  EXPECT_EQ(originals->GetDataType(), VTK_TYPE_INT64);
  EXPECT_EQ(colours->GetDataType(), VTK_FLOAT);
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
    EXPECT_EQ(originals->GetTuple1(i), double(mesh.originalIds[id]));
    EXPECT_EQ(colours->GetComponent(i, 1), double(id));
  }
  this->Reader->GetPointDataArraySelection()->DisableArray("Colours");
  this->Reader->GetCellDataArraySelection()->DisableAllArrays();
  ASSERT_TRUE(updatePiece(this->Reader, 1, 3));
  EXPECT_FALSE(this->output()->GetPointData()->HasArray("Colours"));
  EXPECT_TRUE(this->output()->GetPointData()->HasArray("OriginalId"));
  EXPECT_FALSE(this->output()->GetCellData()->HasArray("OriginalCellId"));
}

TEST_F(VtkStreamingMeshReader, WholeMeshRequestGetsThePreview)
{
  const StreamMesh mesh = this->open(torus(200, 100, 0.2));
  this->Reader->SetMaximumPointsInMemory(1000);
  this->Reader->SetPreviewPoints(500);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  vtkPointSet* preview = this->output();
  ASSERT_TRUE(preview->GetFieldData()->GetArray("Preview"));
  EXPECT_EQ(preview->GetFieldData()->GetArray("FullNumberOfPoints")->GetTuple1(0), 20000.0);
  EXPECT_EQ(preview->GetFieldData()->GetArray("FullNumberOfCells")->GetTuple1(0), 40000.0);
  EXPECT_LE(preview->GetNumberOfPoints(), 500);
  EXPECT_GE(preview->GetNumberOfPoints(), 100);
  EXPECT_GT(preview->GetNumberOfCells(), preview->GetNumberOfPoints());
  auto* ids = preview->GetPointData()->GetGlobalIds();
  auto* colours = preview->GetPointData()->GetArray("Colours");
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
    EXPECT_EQ(preview->GetPoint(i)[0], mesh.positions[3 * id]);
    EXPECT_EQ(colours->GetComponent(i, 1), double(id));
  }
  // Small pieces are real without any key.
  this->expectUnion(mesh, 64);
}

TEST_F(VtkStreamingMeshReader, PreviewOfAVolumeIsItsSurfaceInPieceZero)
{
  this->open(tetBox(20, 20, 20, 0.1));
  this->Reader->SetMaximumPointsInMemory(100);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 2));
  vtkPointSet* preview = this->output();
  ASSERT_GT(preview->GetNumberOfCells(), 0);
  EXPECT_EQ(preview->GetCellType(0), VTK_TRIANGLE);
  EXPECT_EQ(preview->GetNumberOfCells(), 6 * 19 * 19 * 2);
  EXPECT_EQ(preview->GetNumberOfPoints(), 20 * 20 * 20 - 18 * 18 * 18);
  ASSERT_TRUE(updatePiece(this->Reader, 1, 2));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(this->output()->GetPointData()->GetGlobalIds());
  EXPECT_TRUE(this->output()->GetFieldData()->GetArray("Preview"));
}

TEST_F(VtkStreamingMeshReader, StreamedRequestGetsTheRealMeshAndDoesNotStick)
{
  const StreamMesh mesh = this->open(torus(60, 30));
  this->Reader->SetMaximumPointsInMemory(10);
  const auto isPreview = [this]
  { return this->output()->GetFieldData()->GetArray("Preview") != nullptr; };
  vtkInformation* info = this->Reader->GetOutputInformation(0);
  info->Set(vtkStreamingMeshKeys::STREAMED(), 2);
  ASSERT_TRUE(updatePiece(this->Reader, 1, 2));
  EXPECT_FALSE(isPreview());
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(isPreview());
  info->Set(vtkStreamingMeshKeys::STREAMED(), 1);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  EXPECT_FALSE(isPreview());
  EXPECT_EQ(this->output()->GetNumberOfPoints(), mesh.vertices());
  info->Set(vtkStreamingMeshKeys::STREAMED(), 0);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(isPreview());
}

TEST_F(VtkStreamingMeshReader, ReadsStreamingFormats)
{
  const std::filesystem::path path = this->Folder / "tiny.sma";
  std::ofstream(path) << "# nverts 4\n# nfaces 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 2 3\n"
                         "v 1 1 0.5\nf -3 -1 -2\n";
  this->Reader->SetFileName(path.c_str());
  EXPECT_EQ(vtkStreamingMeshReader::CanReadFile(path.c_str()), 1);
  ASSERT_TRUE(updatePiece(this->Reader, 1, 2));
  ASSERT_EQ(this->output()->GetNumberOfPoints(), 3);
  EXPECT_EQ(this->output()->GetNumberOfCells(), 1);
  EXPECT_EQ(this->Reader->GetFullNumberOfPoints(), 4);
  EXPECT_EQ(this->Reader->GetFullNumberOfCells(), 2);
  EXPECT_EQ(this->output()->GetPoints()->GetDataType(), VTK_FLOAT);
}

TEST_F(VtkStreamingMeshReader, KnowsFilesByTheirContent)
{
  this->open(torus(12, 9));
  const auto canRead = [this](const std::string& name, const std::string& content)
  {
    const std::filesystem::path path = this->Folder / name;
    std::ofstream(path, std::ios::binary) << content;
    return vtkStreamingMeshReader::CanReadFile(path.c_str()) == 1;
  };
  std::filesystem::copy_file(this->Folder / "mesh.vsm", this->Folder / "other.name");
  EXPECT_EQ(vtkStreamingMeshReader::CanReadFile((this->Folder / "other.name").c_str()), 1);
  EXPECT_EQ(vtkStreamingMeshReader::CanReadFile((this->Folder / "absent.vsm").c_str()), 0);
  EXPECT_EQ(vtkStreamingMeshReader::CanReadFile(nullptr), 0);
  EXPECT_FALSE(canRead("noise.vsm", "This is no container."));
  EXPECT_FALSE(canRead("empty.smb", ""));
  EXPECT_FALSE(canRead("compressed.smb", "\x1f\x8b\x08 and so on"));
  EXPECT_FALSE(canRead("letter.txt", "Dear reader"));
  EXPECT_TRUE(canRead("mesh.obj", "v 0 0 0\n"));
  EXPECT_TRUE(canRead("mesh.sma", "v 0 0 0\n"));
}

/** Bytes that this process has read from the system so far. */
std::int64_t bytesRead()
{
  std::ifstream io("/proc/self/io");
  std::string name;
  std::int64_t bytes = -1;
  io >> name >> bytes;
  return bytes;
}

TEST_F(VtkStreamingMeshReader, PiecesInOrderReadTheFileOnce)
{
  this->open(torus(600, 400, 0.2));
  const auto size =
    static_cast<std::int64_t>(std::filesystem::file_size(this->Folder / "mesh.vsm"));
  this->Reader->Update();
  const std::int64_t before = bytesRead();
  if (before < 0)
  {
    GTEST_SKIP() << "the system does not count what is read";
  }
  for (int piece = 0; piece < 256; ++piece)
  {
    ASSERT_TRUE(updatePiece(this->Reader, piece, 256));
  }
  EXPECT_LT(bytesRead() - before, size + size / 4);
}

TEST_F(VtkStreamingMeshReader, CellFlagsCannotBeLeftOut)
{
  StreamMesh mesh = toStream(torus(12, 9));
  addColumns(mesh);
  mesh.cellColumns.push_back(
    makeColumn<std::uint8_t>(CellFlagsName, std::vector<std::uint8_t>(mesh.cells(), 0)));
  const std::filesystem::path path = this->Folder / "flags.vsm";
  writeMesh(path, mesh);
  this->Reader->SetFileName(path.c_str());
  this->Reader->UpdateInformation();
  EXPECT_FALSE(this->Reader->GetCellDataArraySelection()->ArrayExists(CellFlagsName));
  this->Reader->GetCellDataArraySelection()->DisableAllArrays();
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(this->output()->GetCellData()->HasArray(CellFlagsName));
  EXPECT_FALSE(this->output()->GetCellData()->HasArray("OriginalCellId"));
}

TEST_F(VtkStreamingMeshReader, PrintsItsProperties)
{
  this->open(torus(12, 9));
  this->Reader->Update();
  std::ostringstream text;
  this->Reader->Print(text);
  for (const char* name : { "FullNumberOfPoints: 108", "Width: ", "Colours", "OriginalCellId" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

TEST_F(VtkStreamingMeshReader, DamagedAndAbsentFilesAreErrors)
{
  Errors errors(this->Reader);
  EXPECT_FALSE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(errors.contain("FileName")) << errors.text();
  errors.clear();
  this->Reader->SetFileName((this->Folder / "absent.vsm").c_str());
  EXPECT_FALSE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(errors.contain("absent.vsm")) << errors.text();

  this->open(torus(60, 30));
  const std::filesystem::path path = this->Folder / "mesh.vsm";
  const auto size = std::filesystem::file_size(path);
  for (std::uintmax_t keep = 0; keep < size; keep += size / 13 + 1)
  {
    const std::filesystem::path damaged = this->Folder / ("cut" + std::to_string(keep) + ".vsm");
    std::filesystem::copy_file(path, damaged);
    std::filesystem::resize_file(damaged, keep);
    errors.clear();
    this->Reader->SetFileName(damaged.c_str());
    EXPECT_FALSE(updatePiece(this->Reader, 0, 1)) << keep;
    EXPECT_TRUE(errors.contain(damaged.filename().string())) << errors.text();
  }
  this->Reader->SetFileName(path.c_str());
  EXPECT_TRUE(updatePiece(this->Reader, 0, 1));
}

} // namespace
} // namespace smg::testing
