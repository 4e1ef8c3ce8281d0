// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolveSummary.h"
#include "Testing/Filters/PoissonFixture.h"

#include "smg/Error.h"

#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkStringArray.h"

#include <limits>
#include <string>
#include <utility>

// Each process of the test has a piece, as in ParaView, and the engines agree on it.

namespace smg::testing
{
namespace
{

/** Fails in the last process after the last message of the solve, and after that no more. */
class vtkLateFailure : public vtkStreamingPoisson
{
public:
  static vtkLateFailure* New() { VTK_STANDARD_NEW_BODY(vtkLateFailure); }
  vtkTypeMacro(vtkLateFailure, vtkStreamingPoisson);
  bool Fails = true;

protected:
  smg::SolveSummary SolveInProcesses(vtkPointSet& piece,
    const std::function<bool(double)>& progress, std::vector<double>& values) override
  {
    smg::SolveSummary summary = this->Superclass::SolveInProcesses(piece, progress, values);
    vtkMultiProcessController& all = *this->GetController();
    if (std::exchange(this->Fails, false) &&
        all.GetLocalProcessId() == all.GetNumberOfProcesses() - 1)
    {
      throw smg::Error("the last process is out of memory");
    }
    return summary;
  }
};

class VtkDistributedPoisson : public VtkStreamingPoisson
{
protected:
  /** The solution at the points of the piece of this process. */
  std::vector<double> solve(int engine)
  {
    this->Poisson->SetEngine(engine);
    this->Poisson->SetTolerance(1e-10);
    EXPECT_TRUE(updatePiece(this->Poisson, this->rank(), this->processes()));
    EXPECT_EQ(this->Poisson->GetConverged(), 1) << this->Poisson->GetOutcome();
    vtkDataArray* values = this->output()->GetPointData()->GetArray("Solution");
    std::vector<double> solution;
    for (vtkIdType k = 0; values && k < values->GetNumberOfValues(); ++k)
    {
      solution.push_back(values->GetVariantValue(k).ToDouble());
    }
    return solution;
  }

  std::string report()
  {
    return vtkStringArray::SafeDownCast(this->output()->GetFieldData()->GetAbstractArray("Report"))
      ->GetValue(0);
  }

  void expectSame()
  {
    const std::vector<double> parts = this->solve(vtkStreamingPoisson::DISTRIBUTED);
    EXPECT_NE(this->report().find("\"distributed\""), std::string::npos);
    const std::vector<double> streamed = this->solve(vtkStreamingPoisson::STREAMING);
    EXPECT_EQ(this->report().find("\"distributed\""), std::string::npos);
    ASSERT_EQ(parts.size(), streamed.size());
    EXPECT_GT(parts.size(), 0u);
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      EXPECT_NEAR(parts[k], streamed[k], 1e-6);
    }
  }

  static int rank()
  {
    return vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
  }
  static int processes()
  {
    return vtkMultiProcessController::GetGlobalController()->GetNumberOfProcesses();
  }
};

TEST_F(VtkDistributedPoisson, AgreesWithTheStreamingEngineOnASurface)
{
  this->expectSame();
}

TEST_F(VtkDistributedPoisson, AgreesWithTheStreamingEngineOnASolid)
{
  this->Ends->Left = 0.5;
  this->Ends->Right = 5.5;
  this->open(tetBox(7, 5, 4, 0.1));
  this->Poisson->SetProblem("{ \"columns\": 3, \"source\": [2, 0, 1],"
                            "  \"flux\": [{ \"boundary\": true, \"value\": [1, 2, 3] }] }");
  this->expectSame();
}

TEST_F(VtkDistributedPoisson, FailsOnAllProcessesIfOneFails)
{
  const Errors errors(this->Poisson);
  this->Poisson->SetEngine(vtkStreamingPoisson::DISTRIBUTED);
  if (this->rank() == this->processes() - 1)
  {
    this->Ends->Bad = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(updatePiece(this->Poisson, this->rank(), this->processes()));
  EXPECT_TRUE(errors.contain("must be finite")) << errors.text();
}

TEST_F(VtkDistributedPoisson, FailsOnAllProcessesIfOneFailsAfterTheLastMessage)
{
  vtkNew<vtkLateFailure> late;
  this->prepare(late);
  late->SetEngine(vtkStreamingPoisson::DISTRIBUTED);
  {
    const Errors errors(late);
    EXPECT_FALSE(updatePiece(late, this->rank(), this->processes()));
    EXPECT_TRUE(errors.contain("the last process is out of memory")) << errors.text();
    EXPECT_EQ(late->GetConverged(), 0);
    EXPECT_EQ(vtkPointSet::SafeDownCast(late->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
  }
  // No process keeps a solution that the others do not have.
  late->Modified();
  EXPECT_TRUE(updatePiece(late, this->rank(), this->processes()));
  EXPECT_EQ(late->GetConverged(), 1) << late->GetOutcome();
}

TEST_F(VtkDistributedPoisson, AutomaticStreamsWhatOnlyStreamingDoes)
{
  this->Poisson->SetEngine(vtkStreamingPoisson::AUTOMATIC_ENGINE);
  const auto expectStreamed = [this](const std::string& why)
  {
    EXPECT_TRUE(updatePiece(this->Poisson, this->rank(), this->processes()));
    EXPECT_EQ(this->Poisson->GetConverged(), 1) << this->Poisson->GetOutcome();
    EXPECT_EQ(this->report().find("\"distributed\""), std::string::npos);
    const std::string notes = this->Poisson->GetNotes();
    EXPECT_NE(notes.find(why), std::string::npos) << notes;
  };
  this->Poisson->SetCheckpointDirectory((this->Folder / "checkpoint").c_str());
  expectStreamed("since it has checkpoints");
  this->Poisson->SetCheckpointDirectory(nullptr);
  this->Poisson->InCoreOn();
  expectStreamed("since it keeps everything in the memory of process 0");
}

} // namespace
} // namespace smg::testing
