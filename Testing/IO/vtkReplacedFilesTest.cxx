// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace smg::testing
{
namespace
{

std::string bytesOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

class VtkReplacedFiles : public ::testing::Test
{
protected:
  VtkReplacedFiles()
  {
    writeVsm(this->Path, torus(40, 24, 0.2));
    this->Reader->SetFileName(this->Path.c_str());
  }

  /** Gives another mesh the name of the file, as a program does that installs a result. */
  void replace(const IndexedTestMesh& mesh)
  {
    writeVsm(this->Folder / "other.vsm", mesh);
    std::filesystem::rename(this->Folder / "other.vsm", this->Path);
  }

  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0)); }

  TemporaryFolder Folder;
  std::filesystem::path Path = this->Folder / "mesh.vsm";
  vtkNew<vtkStreamingMeshReader> Reader;
};

/** Pieces of two meshes would not go together. */
TEST_F(VtkReplacedFiles, AreErrorsOfTheNextPiece)
{
  ASSERT_TRUE(updatePiece(this->Reader, 0, 3));
  this->replace(torus(40, 24, 0.1));
  Errors errors(this->Reader);
  EXPECT_FALSE(updatePiece(this->Reader, 1, 3));
  EXPECT_TRUE(errors.contain("mesh.vsm: was replaced or changed since it was opened"))
    << errors.text();
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 0);
  // Another piece neither.
  EXPECT_FALSE(updatePiece(this->Reader, 2, 3));
  // As File > Reload Files does.
  errors.clear();
  this->Reader->Modified();
  ASSERT_TRUE(updatePiece(this->Reader, 1, 3));
  EXPECT_EQ(errors.text(), "");
  double point[3], other[3];
  this->output()->GetPoint(5, point);
  vtkNew<vtkStreamingMeshReader> fresh;
  fresh->SetFileName(this->Path.c_str());
  ASSERT_TRUE(updatePiece(fresh, 1, 3));
  vtkPointSet::SafeDownCast(fresh->GetOutputDataObject(0))->GetPoint(5, other);
  EXPECT_TRUE(std::equal(point, point + 3, other));
}

TEST_F(VtkReplacedFiles, AreTheSameIfTheMeshIs)
{
  ASSERT_TRUE(updatePiece(this->Reader, 0, 3));
  this->replace(torus(40, 24, 0.2));
  EXPECT_TRUE(this->Reader->IsFileUnchanged() == false);
  EXPECT_TRUE(updatePiece(this->Reader, 1, 3));
  EXPECT_TRUE(this->Reader->IsFileUnchanged());
}

TEST_F(VtkReplacedFiles, OfOtherFormatsAreErrors)
{
  const std::filesystem::path path = this->Folder / "mesh.off";
  writeBytes(path, meshText(torus(20, 12)));
  this->Reader->SetFileName(path.c_str());
  ASSERT_TRUE(updatePiece(this->Reader, 0, 2));
  writeBytes(path, meshText(torus(12, 20)));
  Errors errors(this->Reader);
  EXPECT_FALSE(updatePiece(this->Reader, 1, 2));
  EXPECT_TRUE(errors.contain("mesh.off: was replaced or changed")) << errors.text();
}

/** A file that is replaced before its isolated points are copied. */
TEST_F(VtkReplacedFiles, AreNotMixedByTheWriter)
{
  vtkNew<vtkFaultyFilter> filter;
  filter->SetInputConnection(this->Reader->GetOutputPort());
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(filter->GetOutputPort());
  writer->SetNumberOfStreamedPieces(3);
  const std::filesystem::path out = this->Folder / "out.vsm";
  writer->SetFileName(out.c_str());
  static std::function<void()> atPiece;
  for (const int last : { 0, 1, 2 })
  {
    this->replace(torus(40, 24, 0.2));
    this->Reader->Modified();
    atPiece = [this] { this->replace(torus(40, 24, 0.1)); };
    static int chosen;
    chosen = last;
    filter->Spoil = [](vtkPointSet*, int piece)
    {
      if (piece == chosen && atPiece)
      {
        std::exchange(atPiece, nullptr)();
      }
    };
    Errors errors(writer);
    EXPECT_FALSE(writer->Write()) << last;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

TEST_F(VtkReplacedFiles, TheWriterDoesNotOverwriteItsInput)
{
  const std::filesystem::path text = this->Folder / "mesh.off";
  writeBytes(text, meshText(torus(20, 12)));
  const std::filesystem::path link = this->Folder / "link.vsm";
  std::filesystem::create_symlink(this->Path, link);
  vtkNew<vtkFaultyFilter> filter;
  filter->SetInputConnection(this->Reader->GetOutputPort());
  for (const auto& [in, out] : { std::pair{ this->Path, this->Path }, { this->Path, link },
         { link, this->Path }, { text, text } })
  {
    for (const bool restores : { false, true })
    {
      this->Reader->SetFileName(in.c_str());
      const std::string before = bytesOf(out);
      vtkNew<vtkStreamingMeshWriter> writer;
      writer->SetInputConnection(filter->GetOutputPort());
      writer->SetFileName(out.c_str());
      writer->SetRestoreOrder(restores);
      Errors errors(writer);
      EXPECT_FALSE(writer->Write()) << in << ' ' << out;
      EXPECT_TRUE(
        errors.contain("would overwrite it, which is what the Streaming Mesh Reader reads"))
        << errors.text();
      EXPECT_EQ(bytesOf(out), before);
    }
  }
  // Nor the file that has the points of no cell.
  this->Reader->SetFileName(text.c_str());
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Reader->GetOutputPort());
  writer->SetStreamFileName(this->Path.c_str());
  writer->SetFileName(this->Path.c_str());
  Errors errors(writer);
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.contain("Stream File Name")) << errors.text();
}

} // namespace
} // namespace smg::testing
