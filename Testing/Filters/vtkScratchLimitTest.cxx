// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Filters/PoissonFixture.h"
#include "Testing/Support/ScratchLimits.h"

#include "vtkCallbackCommand.h"

#include <algorithm>

namespace smg::testing
{
namespace
{

/** Solves on a mesh whose finest level is on scratch files, and observes their bytes. */
class VtkScratchLimit : public VtkStreamingPoisson
{
protected:
  VtkScratchLimit()
  {
    this->open(torus(400, 150, 0.2));
    this->Poisson->SetScratchDirectory(this->Scratch.path().c_str());
    this->Poisson->SetTolerance(1e-3);
    vtkNew<vtkCallbackCommand> observe;
    observe->SetClientData(this);
    observe->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* progress)
      {
        // At the beginning there is the solution before.
        if (*static_cast<double*>(progress) > 0.0)
        {
          auto* test = static_cast<VtkScratchLimit*>(self);
          test->Observed = std::max(test->Observed, bytesBelow(test->Scratch.path()));
        }
      });
    this->Poisson->AddObserver(vtkCommand::ProgressEvent, observe);
  }

  TemporaryFolder Scratch;
  std::int64_t Observed = 0;
};

constexpr std::int64_t Mebibyte = 1 << 20;

TEST_F(VtkScratchLimit, HoldsForPiecesAndSolveTogether)
{
  const PieceUnion whole = this->collectPieces(2);
  const auto need = static_cast<int>(this->Observed / Mebibyte + 1);
  ASSERT_GT(need, 6);

  this->Poisson->SetScratchLimit(2 * need);
  EXPECT_EQ(this->collectPieces(2).values, whole.values);

  // The pieces, and both.
  for (const int limit : { 1, need - 2 })
  {
    this->Observed = 0;
    this->Poisson->SetScratchLimit(limit);
    Errors errors(this->Poisson);
    EXPECT_FALSE(updatePiece(this->Poisson, 0, 2));
    EXPECT_TRUE(errors.contain("the scratch files would take at least ")) << errors.text();
    EXPECT_TRUE(errors.contain("their limit is " + std::to_string(limit) + " MiB"))
      << errors.text();
    EXPECT_TRUE(errors.contain("ScratchLimit")) << errors.text();
    EXPECT_LE(this->Observed, limit * Mebibyte);
    EXPECT_EQ(this->Scratch.entries(), 0);
  }
}

} // namespace
} // namespace smg::testing
