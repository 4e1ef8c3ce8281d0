// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include "vtkInformationStringKey.h"

#include <algorithm>

namespace smg::testing
{
namespace
{

/** A filter that notes the largest piece and may hide the file of the pieces. */
class vtkMeasuringFilter : public vtkFaultyFilter
{
public:
  static vtkMeasuringFilter* New() { VTK_STANDARD_NEW_BODY(vtkMeasuringFilter); }
  vtkTypeMacro(vtkMeasuringFilter, vtkFaultyFilter);

  bool IsAnonymous = false;
  std::int64_t MaxBytes = 0; ///< of the pieces of the last number of pieces
  int Pieces = 0;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    if (this->IsAnonymous)
    {
      outputVector->GetInformationObject(0)->Remove(vtkStreamingMeshKeys::STREAM_FILE());
    }
    return 1;
  }

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const int pieces = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    const int done = this->vtkFaultyFilter::RequestData(request, inputVector, outputVector);
    const std::int64_t bytes = 1024 * vtkDataObject::GetData(info)->GetActualMemorySize();
    this->MaxBytes = std::max(pieces == this->Pieces ? this->MaxBytes : 0, bytes);
    this->Pieces = pieces;
    return done;
  }
};

class VtkPieceCount : public ::testing::Test
{
protected:
  VtkPieceCount()
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", torus(400, 100, 0.2));
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->SetMaximumPointsInMemory(10);
    this->Filter->SetInputConnection(this->Reader->GetOutputPort());
    this->Sink->SetInputConnection(this->Filter->GetOutputPort());
  }

  void pull(const PieceCount& pieces)
  {
    this->Filter->Requests.clear();
    PieceInput input(*this->Sink, 0);
    PieceStream stream(input, pieces, { .all = true, .required = {}, .optional = {} });
    Progress progress;
    writeContainer(stream, this->Folder / "out.vsm", true, progress);
    this->expectSameMesh();
  }

  void expectSameMesh()
  {
    VsmReader reader(this->Folder / "out.vsm");
    const StreamMesh copy = collect(*reader.source());
    EXPECT_EQ(copy.positions, this->Mesh.positions);
    EXPECT_EQ(copy.corners, this->Mesh.corners);
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkMeasuringFilter> Filter;
  vtkNew<vtkFaultyFilter> Sink;
};

constexpr std::int64_t SmallBytes = 30000;
/** VTK counts each array in whole kibibytes. */
constexpr std::int64_t RoundingBytes = 10 * 1024;

TEST_F(VtkPieceCount, SmallMeshesAreRequestedInTheUsualPieces)
{
  this->pull(PieceCount::within(0, std::int64_t(1) << 30));
  EXPECT_EQ(this->Filter->Requests.size(), 64U);
  EXPECT_EQ(this->Filter->Requests.front(), "0/64");
}

TEST_F(VtkPieceCount, AGivenNumberStays)
{
  this->pull(PieceCount::within(5, 1));
  EXPECT_EQ(
    this->Filter->Requests, (std::vector<std::string>{ "0/5", "1/5", "2/5", "3/5", "4/5" }));
}

TEST_F(VtkPieceCount, NoPieceOfAKnownMeshIsLarge)
{
  this->pull({ .pieceBytes = SmallBytes });
  EXPECT_GT(this->Filter->Pieces, 64);
  EXPECT_LE(this->Filter->MaxBytes, SmallBytes + RoundingBytes);
  for (const std::string& request : this->Filter->Requests)
  {
    EXPECT_FALSE(request.ends_with("/64")) << request;
  }
}

TEST_F(VtkPieceCount, ALargeFirstPieceOfAnotherSourceBeginsAgain)
{
  this->Filter->IsAnonymous = true;
  this->pull({ .pieceBytes = SmallBytes });
  EXPECT_EQ(this->Filter->Requests.front(), "0/64");
  EXPECT_GT(this->Filter->Pieces, 64);
  EXPECT_EQ(this->Filter->Requests.at(1), "0/" + std::to_string(this->Filter->Pieces));
  EXPECT_EQ(this->Filter->Requests.size(), std::size_t(this->Filter->Pieces) + 1);
  // Later pieces also have points of earlier ones, which the first one does not show.
  constexpr std::int64_t PointBytes = 64;
  const std::int64_t shared = PointBytes * VsmReader(this->Folder / "mesh.vsm").info().width;
  EXPECT_LE(this->Filter->MaxBytes, SmallBytes + RoundingBytes + shared);
}

TEST_F(VtkPieceCount, TheWriterRequestsNoLargePiece)
{
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Filter->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  ASSERT_TRUE(writer->Write());
  this->expectSameMesh();
  constexpr std::int64_t PieceBytes = std::int64_t(4) << 20;
  EXPECT_GT(this->Filter->Pieces, 1);
  EXPECT_LE(this->Filter->MaxBytes, PieceBytes);
  EXPECT_EQ(this->Filter->Requests.front(), "0/" + std::to_string(this->Filter->Pieces));

  this->Filter->IsAnonymous = true;
  this->Filter->Requests.clear();
  this->Filter->Modified();
  ASSERT_TRUE(writer->Write());
  EXPECT_EQ(this->Filter->Requests.front(), "0/64");
  EXPECT_LE(this->Filter->MaxBytes, PieceBytes);
}

} // namespace
} // namespace smg::testing
