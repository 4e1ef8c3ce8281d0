// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/DeformationEngine.h"

#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "Solver/Multigrid/Engine/StreamedSolution.h"
#include "Solver/Multigrid/Extended.h"

#include <cmath>
#include <utility>

// The passes of a deformation. The rotations are solved for as any problem; their last prolongation
// and the first restriction of the positions share a pass, in which PositionStep makes the second
// right-hand side from the first result: k V-cycles for each problem take 2 k + 1 passes.

namespace smg
{

void DeformationSteps::solve(const std::function<FirstResidual()>& build)
{
  Step rotations(*this, "rotation step: "), positions(*this, "position step: ");
  bool rotated = false;
  if (!this->resume(rotations, positions, rotated))
  {
    rotations.convergence = Convergence(this->stopping(), build());
    rotations.convergence.begin(this->Levels.residualNorm());
    this->Context.endPass(1.0);
  }
  if (!rotated)
  {
    rotations.iteration.run(true);
    this->beginPositions(rotations, positions);
    rotated = true;
    this->Context.endPass(rotations.convergence.residuals().back());
  }
  positions.iteration.run(false);
  Report& r = this->Context.report;
  positions.convergence.addStep(r, "position", "position step: ");
  r.relative_to = MeshAtRest;
  r.converged = rotations.convergence.converged() && positions.convergence.converged();
  r.seconds.solve = this->Context.seconds() - r.seconds.build;
  addDeformationNotes(r);
  this->Context.finishReport();
}

/** Continues from a checkpoint, if there is one, and provides for further ones, between passes. A
 * checkpoint has the state of one of the steps: that of the positions if `rotated`, which is true
 * from the shared pass on. */
bool DeformationSteps::resume(Step& rotations, Step& positions, bool& rotated)
{
  const auto save = [&](StateWriter& state)
  {
    state(this->Levels, this->Rest, rotated, rotations.convergence);
    rotated ? state(positions) : state(rotations.iteration);
  };
  const auto load = [&](StateReader& state)
  {
    state(this->Levels, this->Rest, rotated, rotations.convergence);
    if (rotated)
    {
      this->Context.progress.begin(this->stopping(), Share, 1.0, false);
    }
    rotated ? state(positions) : state(rotations.iteration);
  };
  const auto weights = std::to_string(static_cast<int>(this->EdgeWeights));
  return this->Context.resume({ { "kind of task", "deformation" }, { "kind of weights", weights },
                                { "number of V-cycles", std::to_string(this->Cycles) } },
    { save, load });
}

/** The pass that finishes the last V-cycle of the rotations and begins the first one of the
 * positions. */
void DeformationSteps::beginPositions(Step& rotations, Step& positions)
{
  PositionStep step(this->Context.pool, this->Rest, this->Levels.window());
  const double norm = this->sharedPass(step);
  checkMotions(step.termSquares());
  rotations.convergence.add(std::sqrt(step.rotationSquares()));
  rotations.convergence.addStep(this->Context.report, "rotation", "rotation step: ");
  this->Context.progress.begin(this->stopping(), Share, 1.0, false);
  // The initial values are the mesh at rest.
  const double motion = std::sqrt(step.initialSquares());
  positions.convergence =
    Convergence(this->stopping(), { motion, roundingOf(step.termSquares()), motion });
  positions.convergence.begin(norm);
}

/** Returns the norm of the residual of the positions after their first sweeps. */
double DeformationSteps::sharedPass(PositionStep& step)
{
  auto& finest = this->Levels.finest();
  this->Levels.renew(PositionStep::Columns);
  step.startPass();
  Pass(this->Context, this->Levels)
    .run(this->positionScale(), { [&step] { step.load(); },
                                  [&step, &finest](bool follows)
                                  {
                                    step.advance(finest.finishedUp(step.turned(), follows));
                                    finest.setRenewed(step.done());
                                  } });
  step.endPass();
  return this->Levels.residualNorm();
}

/** An estimate of the largest residual of the positions: weights of triangles are of order 1, those
 * of tetrahedra of the order of lengths. */
double DeformationSteps::positionScale() const
{
  const double extent = this->Rest.extent();
  const bool lengths =
    this->Cells == CellType::Tetrahedron && this->EdgeWeights == Weights::Clamped;
  return lengths ? extent * extent : extent;
}

namespace
{

/** The result of a deformation: the solution, which consists of displacements, plus the positions
 * that these start from. */
class DeformedPositions final : public Solution
{
public:
  /** `rest` and the displacements use the same pool of memory. */
  DeformedPositions(std::unique_ptr<StreamedSolution> displacements, RestShape rest)
    : Displacements(std::move(displacements))
    , Rest(std::move(rest))
  {
  }

  std::int64_t vertices() const override { return this->Displacements->vertices(); }
  int columns() const override { return this->Displacements->columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->Displacements->read(first, count, values);
    this->Rest.addStart(first, count, values.data());
  }
  void removeCheckpoint() override { this->Displacements->removeCheckpoint(); }
  const Report& report() const override { return this->Displacements->report(); }

private:
  std::unique_ptr<StreamedSolution> Displacements;
  RestShape Rest;
};

} // namespace

/** The operators are those with the fastest V-cycles: a deformation makes few of them, often a
 * given number. */
DeformationEngine::DeformationEngine(const DeformOptions& options, CellType cells)
  : Operators(compiled(Extended::forFewCycles(cells)))
  , EdgeWeights(options.weights)
  , Context(std::make_unique<SolveContext>(RotationProblem::Columns, options))
  , Levels(*this->Context, RotationProblem::Columns, this->Operators.relaxation)
  , Rest(this->Context->pool)
  , Steps(*this->Context, this->Levels, this->Rest, options, cells)
{
  if (this->Context->scratch)
  {
    this->Rest.useScratch(*this->Context->scratch, this->Context->traffic.add("rest"));
  }
}

void DeformationEngine::deform(MeshSource& mesh, Handles& handles)
{
  SolveContext& context = *this->Context;
  context.beginReport();
  this->Steps.begin(true);
  this->Steps.solve(
    [&]
    {
      RotationProblem problem(handles, this->EdgeWeights,
        [this](std::int64_t vertex, const double* target) { this->Rest.hold(vertex, target); });
      FirstPass build(context, this->Levels, this->Operators);
      // Measured against the motion: rotations begin at 0.
      const FirstResidual first =
        build.run(mesh, problem, &this->Rest, PositionStep::CoreBytes).alone();
      this->Rest.finish();
      checkAnyHeld(context.report);
      context.report.shared = problem.shared();
      return first;
    });
  if (context.report.resumed_passes > 0)
  {
    ask(mesh, handles);
  }
}

/** Asks the handles for each block, as the first pass does. A run that continues from a checkpoint
 * does not make that pass, but the notes of the handles need it (DescribedHandles::notes()). */
void DeformationEngine::ask(MeshSource& mesh, Handles& handles)
{
  MeshBlock block;
  VertexHandles given;
  while (mesh.next(block))
  {
    given.clear(static_cast<std::size_t>(block.vertices()));
    handles.at(block, given);
  }
}

std::unique_ptr<Solution> DeformationEngine::takeSolution()
{
  SolveContext& context = *this->Context;
  auto displacements =
    std::make_unique<StreamedSolution>(std::move(this->Context), this->Levels.takeWindow());
  auto solution =
    std::make_unique<DeformedPositions>(std::move(displacements), std::move(this->Rest));
  context.progress.finish();
  return solution;
}

} // namespace smg
