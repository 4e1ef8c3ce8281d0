// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "Testing/Filters/PoissonFixture.h"

#include "vtkCallbackCommand.h"

#include <filesystem>
#include <string>

namespace smg::testing
{
namespace
{

class VtkCheckpoint : public VtkStreamingPoisson
{
protected:
  /** Aborts a solve with a checkpoint after some of its V-cycles. */
  void abort()
  {
    vtkNew<vtkCallbackCommand> abort;
    abort->SetCallback(
      [](vtkObject* filter, unsigned long, void*, void* progress)
      {
        if (*static_cast<double*>(progress) > 0.6)
        {
          static_cast<vtkAlgorithm*>(filter)->SetAbortExecute(1);
        }
      });
    vtkNew<vtkStreamingPoisson> aborted;
    this->prepare(aborted);
    aborted->SetCheckpointDirectory(this->Checkpoint.c_str());
    aborted->AddObserver(vtkCommand::ProgressEvent, abort);
    Errors errors(aborted);
    EXPECT_FALSE(updatePiece(aborted, 0, 1));
    EXPECT_TRUE(std::filesystem::exists(this->Checkpoint));
  }

  bool says(const char* words) const
  {
    return std::string(this->Poisson->GetReport()).find(words) != std::string::npos;
  }

  std::filesystem::path Checkpoint = this->Folder / "checkpoint";
};

TEST_F(VtkCheckpoint, AnAbortedSolveContinuesWithTheSameBits)
{
  const PieceUnion whole = this->collectPieces(3);
  this->abort();
  this->Poisson->SetCheckpointDirectory(this->Checkpoint.c_str());
  EXPECT_EQ(this->collectPieces(3).values, whole.values);
  EXPECT_TRUE(this->says("continued after pass"));
  EXPECT_TRUE(std::filesystem::exists(this->Checkpoint));
  // Another solve begins anew: it removes the checkpoint of the solution that it replaces.
  this->Poisson->SetTolerance(1e-5);
  this->collectPieces(3);
  EXPECT_FALSE(this->says("continued after pass"));
  this->Poisson->SetCheckpointDirectory(nullptr);
  this->collectPieces(3);
  EXPECT_FALSE(std::filesystem::exists(this->Checkpoint));
}

TEST_F(VtkCheckpoint, OfAnotherProblemOrInputIsRefused)
{
  this->abort();
  this->Poisson->SetCheckpointDirectory(this->Checkpoint.c_str());
  Errors errors(this->Poisson);
  this->Poisson->SetProblem(R"({"screening": 1})");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("another problem")) << errors.text();
  errors.clear();
  this->Poisson->SetProblem(nullptr);
  this->Ends->Bad = 0.5;
  this->Ends->Modified();
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("another mesh")) << errors.text();
}

TEST_F(VtkCheckpoint, RemainsWithoutTheFilterUntilTheResultIsSafe)
{
  for (int run = 0; run < 2; ++run)
  {
    vtkNew<vtkStreamingPoisson> poisson;
    this->prepare(poisson);
    poisson->SetCheckpointDirectory(this->Checkpoint.c_str());
    ASSERT_TRUE(updatePiece(poisson, 0, 1));
    EXPECT_EQ(std::string(poisson->GetReport()).find("continued after pass") != std::string::npos,
      run == 1);
    EXPECT_EQ(poisson->GetConverged(), 1);
  }
  EXPECT_TRUE(std::filesystem::exists(this->Checkpoint));
}

TEST_F(VtkCheckpoint, OfFiltersWithoutOneIsAnError)
{
  vtkNew<vtkStreamingMeshSmoothing> smoothing;
  vtkNew<vtkStreamingDistance> distance;
  distance->SetFrom(R"([{"sphere": [3, 0, 0, 1]}])");
  for (vtkStreamingSolver* filter : { static_cast<vtkStreamingSolver*>(smoothing.Get()),
         static_cast<vtkStreamingSolver*>(distance.Get()) })
  {
    filter->SetInputConnection(this->Reader->GetOutputPort());
    filter->SetCheckpointDirectory(this->Checkpoint.c_str());
    Errors errors(filter);
    EXPECT_FALSE(updatePiece(filter, 0, 2));
    EXPECT_TRUE(errors.contain("no checkpoints")) << errors.text();
  }
  EXPECT_FALSE(std::filesystem::exists(this->Checkpoint));
}

} // namespace
} // namespace smg::testing
