// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkDataArraySelection.h"
#include "vtkFieldData.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <sstream>
#include <string>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshConverter : public ::testing::Test
{
protected:
  void SetUp() override
  {
    writeBytes(this->In, meshText(torus(60, 30, 0.2)));
    this->Converter->SetFileName(this->In.c_str());
    this->Converter->SetOutputFileName(this->Out.c_str());
  }

  vtkPointSet* output()
  {
    return vtkPointSet::SafeDownCast(this->Converter->GetOutputDataObject(0));
  }

  TemporaryFolder Folder;
  std::filesystem::path In = this->Folder / "mesh.off";
  std::filesystem::path Out = this->Folder / "mesh.vsm";
  vtkNew<vtkStreamingMeshConverter> Converter;
};

TEST_F(VtkStreamingMeshConverter, PiecesAreThoseOfTheReader)
{
  for (const char* kind : { "mesh.off", "mesh.mesh" })
  {
    this->In = this->Folder / kind;
    this->Out.replace_filename(std::string(kind) + ".vsm");
    writeBytes(this->In,
      meshText(this->In.extension() == ".off" ? torus(60, 30, 0.2) : tetBox(9, 8, 7, 0.1)));
    this->Converter->SetFileName(this->In.c_str());
    this->Converter->SetOutputFileName(this->Out.c_str());
    vtkNew<vtkStreamingMeshReader> reader;
    for (const int piece : { 0, 1, 2, 4, 3 })
    {
      ASSERT_TRUE(updatePiece(this->Converter, piece, 5));
      reader->SetFileName(this->Out.c_str());
      ASSERT_TRUE(updatePiece(reader, piece, 5));
      vtkPointSet* expected = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
      ASSERT_STREQ(this->output()->GetClassName(), expected->GetClassName());
      ASSERT_EQ(this->output()->GetNumberOfPoints(), expected->GetNumberOfPoints());
      ASSERT_EQ(this->output()->GetNumberOfCells(), expected->GetNumberOfCells());
      for (const char* name : { "OriginalId", "GlobalIds", "StreamFinalized", "vtkGhostType" })
      {
        vtkDataArray* own = this->output()->GetPointData()->GetArray(name);
        vtkDataArray* other = expected->GetPointData()->GetArray(name);
        ASSERT_TRUE(own && other) << name;
        for (vtkIdType i = 0; i < expected->GetNumberOfPoints(); ++i)
        {
          ASSERT_EQ(own->GetTuple1(i), other->GetTuple1(i)) << name;
        }
      }
    }
    EXPECT_EQ(this->Converter->GetFullNumberOfPoints(), reader->GetFullNumberOfPoints());
    EXPECT_EQ(this->Converter->GetFullNumberOfCells(), reader->GetFullNumberOfCells());
    EXPECT_EQ(this->Converter->GetWidth(), reader->GetWidth());
  }
}

TEST_F(VtkStreamingMeshConverter, ShowsAPreviewUnlessItIsStreamed)
{
  this->Converter->SetMaximumPointsInMemory(1000);
  this->Converter->SetPreviewPoints(300);
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(this->output()->GetFieldData()->GetArray("Preview"));
  EXPECT_LE(this->output()->GetNumberOfPoints(), 300);
  this->Converter->GetOutputInformation(0)->Set(vtkStreamingMeshKeys::STREAMED(), 1);
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_FALSE(this->output()->GetFieldData()->GetArray("Preview"));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 1800);
  this->Converter->GetOutputInformation(0)->Set(vtkStreamingMeshKeys::STREAMED(), 0);
  this->Converter->SetMaximumPointsInMemory(1800);
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 1800);
}

TEST_F(VtkStreamingMeshConverter, ConvertsOnlyWhenItMust)
{
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_NE(
    std::string(this->Converter->GetReport()).find("\"order\": \"bfs\""), std::string::npos);
  const auto written = std::filesystem::last_write_time(this->Out);
  // Modified, or another converter of the same file: nothing to do.
  const std::string report = this->Converter->GetReport();
  this->Converter->Modified();
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(this->Converter->GetReport(), report);
  vtkNew<vtkStreamingMeshConverter> other;
  other->SetFileName(this->In.c_str());
  other->SetOutputFileName(this->Out.c_str());
  ASSERT_TRUE(updatePiece(other, 0, 1));
  EXPECT_STREQ(other->GetReport(), "");
  EXPECT_EQ(std::filesystem::last_write_time(this->Out), written);

  this->Converter->SetOrder(vtkStreamingMeshConverter::AXIS);
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_NE(
    std::string(this->Converter->GetReport()).find("\"order\": \"axis\""), std::string::npos);
  writeBytes(this->In, meshText(torus(31, 20)));
  this->Converter->Modified();
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 620);
  EXPECT_EQ(this->Folder.entries(), 2);
}

TEST_F(VtkStreamingMeshConverter, DoesNotExecuteAgainByItself)
{
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  const vtkMTimeType executed = this->output()->GetMTime();
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(this->output()->GetMTime(), executed);
  this->Converter->GetPointDataArraySelection()->DisableArray("OriginalId");
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_FALSE(this->output()->GetPointData()->HasArray("OriginalId"));
}

TEST_F(VtkStreamingMeshConverter, NothingIsWrongBeforeDataAreAskedFor)
{
  this->Converter->SetOutputFileName(nullptr);
  Errors errors(this->Converter);
  this->Converter->UpdateInformation();
  EXPECT_EQ(errors.text(), "");
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("OutputFileName")) << errors.text();
}

TEST_F(VtkStreamingMeshConverter, ErrorsAreSaidOnce)
{
  Errors errors(this->Converter);
  writeBytes(this->In, "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("mesh.off")) << errors.text();
  errors.clear();
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_FALSE(errors.contain("mesh.off")) << errors.text();
  EXPECT_FALSE(std::filesystem::exists(this->Out));

  // A repaired file is read; a foreign output is not overwritten unless this is allowed.
  writeBytes(this->In, meshText(torus(31, 20)));
  writeBytes(this->Out, "a letter");
  this->Converter->Modified();
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("mesh.vsm is there already")) << errors.text();
  this->Converter->OverwriteOn();
  errors.clear();
  EXPECT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 620);

  for (const bool time : { true, false })
  {
    this->Converter->SetTimeStep(time ? 1 : 0);
    this->Converter->SetPartition(0);
    errors.clear();
    EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
    EXPECT_TRUE(errors.contain(time ? "no time steps" : "no partitions")) << errors.text();
  }
  this->Converter->SetPartition(-1);

  this->Converter->SetMemoryLimit(1);
  this->Converter->SetOrder(vtkStreamingMeshConverter::AXIS);
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("MemoryLimit")) << errors.text();
}

TEST_F(VtkStreamingMeshConverter, TriesAgainWhenTheOutputHasChanged)
{
  writeBytes(this->Out, "a letter");
  Errors errors(this->Converter);
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("is there already")) << errors.text();
  // Nothing is modified, but the letter is missing.
  std::filesystem::remove(this->Out);
  errors.clear();
  EXPECT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 1800);
}

TEST_F(VtkStreamingMeshConverter, MakesAContainerAnewThatIsGone)
{
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  std::filesystem::remove(this->Out);
  this->Converter->Modified();
  EXPECT_TRUE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(std::filesystem::exists(this->Out));
}

TEST_F(VtkStreamingMeshConverter, DamageOfTheContainerIsAnError)
{
  ASSERT_TRUE(updatePiece(this->Converter, 0, 1));
  // The middle of the file, so that the header still names its origin.
  std::fstream file(this->Out, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(this->Out) / 4));
  file.write("nonsense", 8);
  file.close();
  Errors errors(this->Converter);
  this->Converter->Modified();
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_TRUE(errors.contain("mesh.vsm")) << errors.text();
}

TEST_F(VtkStreamingMeshConverter, CanBeAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* converter, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(converter)->SetAbortExecute(1); });
  const Errors expected(this->Converter);
  const unsigned long tag = this->Converter->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_FALSE(updatePiece(this->Converter, 0, 1));
  EXPECT_FALSE(std::filesystem::exists(this->Out));
  this->Converter->RemoveObserver(tag);
  this->Converter->Modified();
  EXPECT_TRUE(updatePiece(this->Converter, 0, 1));
}

TEST_F(VtkStreamingMeshConverter, PrintsItsProperties)
{
  this->Converter->Update();
  std::ostringstream text;
  this->Converter->Print(text);
  for (const char* name : { "OutputFileName: ", "Order: 0", "FullNumberOfPoints: 1800" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

} // namespace
} // namespace smg::testing
