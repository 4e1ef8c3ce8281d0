// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/DeformationSteps.h"
#include "Solver/Jobs/Deformation/DeformedPositions.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveRun.h"
#include "smg/Deform.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace smg
{

/** Deforms a mesh: the first pass builds the hierarchy and begins the first V-cycle of the
 * rotations; DeformationSteps does the rest. */
template <OperatorSet Operators>
class DeformationEngine
{
public:
  using Relaxation = typename Operators::Relaxation;

  DeformationEngine(Operators operators, const DeformOptions& options, CellType cells)
    : Set(std::move(operators))
    , EdgeWeights(options.weights)
    , Run(std::make_unique<SolveRun>(RotationProblem::Columns, options))
    , Levels(*this->Run, RotationProblem::Columns)
    , Rest(this->Run->pool)
    , Steps(*this->Run, this->Levels, this->Rest, options, cells)
  {
    if (this->Run->scratch)
    {
      this->Rest.useScratch(*this->Run->scratch, this->Run->traffic.add("rest"));
    }
  }

  DeformationEngine(const DeformationEngine&) = delete;
  DeformationEngine& operator=(const DeformationEngine&) = delete;

  /** To be called once. */
  void deform(MeshSource& mesh, Handles& handles);
  /** Returns the positions after deform() and releases everything else. */
  std::unique_ptr<Solution> takeSolution();

  // The parts, for further deformations.

  SolveRun& run() { return *this->Run; }
  Hierarchy<Relaxation>& levels() { return this->Levels; }
  RestShape& rest() { return this->Rest; }
  DeformationSteps<Relaxation>& steps() { return this->Steps; }

private:
  static void ask(MeshSource& mesh, Handles& handles);

  Operators Set;
  Weights EdgeWeights;
  std::unique_ptr<SolveRun> Run;
  Hierarchy<Relaxation> Levels;
  RestShape Rest;
  DeformationSteps<Relaxation> Steps;
};

template <OperatorSet Operators>
void DeformationEngine<Operators>::deform(MeshSource& mesh, Handles& handles)
{
  SolveRun& run = *this->Run;
  run.beginReport();
  this->Steps.begin(true);
  this->Steps.solve(
    [&]
    {
      RotationProblem problem(handles, this->EdgeWeights,
        [this](std::int64_t vertex, const double* target) { this->Rest.hold(vertex, target); });
      FirstPass build(run, this->Levels, this->Set);
      const FirstResidual first = build(mesh, problem, &this->Rest, PositionStep::CoreBytes);
      this->Rest.finish();
      checkAnyHeld(run.report);
      run.report.shared = problem.shared();
      return first;
    });
  if (run.report.resumed_passes > 0)
  {
    ask(mesh, handles);
  }
}

/** Asks the handles for each block, as the first pass does. */
template <OperatorSet Operators>
void DeformationEngine<Operators>::ask(MeshSource& mesh, Handles& handles)
{
  MeshBlock block;
  VertexHandles given;
  while (mesh.next(block))
  {
    given.clear(static_cast<std::size_t>(block.vertices()));
    handles.at(block, given);
  }
}

template <OperatorSet Operators>
std::unique_ptr<Solution> DeformationEngine<Operators>::takeSolution()
{
  SolveRun& run = *this->Run;
  auto displacements =
    std::make_unique<StreamedSolution>(std::move(this->Run), this->Levels.takeWindow());
  auto solution =
    std::make_unique<DeformedPositions>(std::move(displacements), std::move(this->Rest));
  run.progress.finish();
  return solution;
}

} // namespace smg
