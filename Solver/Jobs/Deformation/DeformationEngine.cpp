// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/DeformationEngine.h"

#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
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
    rotations.convergence.begin(this->System.levels().residualNorm());
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
    state(this->System.levels(), this->Rest, rotated, rotations.convergence);
    rotated ? state(positions) : state(rotations.iteration);
  };
  const auto load = [&](StateReader& state)
  {
    state(this->System.levels(), this->Rest, rotated, rotations.convergence);
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
  PositionStep step(this->Context.pool, this->Rest, this->System.window(), this->positionScale());
  this->System.advance(step);
  checkMotions(step.termSquares());
  rotations.convergence.add(std::sqrt(step.rotationSquares()));
  rotations.convergence.addStep(this->Context.report, "rotation", "rotation step: ");
  this->Context.progress.begin(this->stopping(), Share, 1.0, false);
  // The initial values are the mesh at rest.
  const double motion = std::sqrt(step.initialSquares());
  positions.convergence =
    Convergence(this->stopping(), { motion, roundingOf(step.termSquares()), motion });
  positions.convergence.begin(this->System.levels().residualNorm());
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
  : EdgeWeights(options.weights)
  , System(compiled(Extended::forFewCycles(cells)), RotationProblem::Columns, options)
  , Rest(this->System.context().pool)
  , Steps(this->System, this->Rest, options, cells)
{
  if (SolveContext& context = this->System.context(); context.scratch)
  {
    this->Rest.useScratch(*context.scratch, context.traffic);
  }
}

void DeformationEngine::deform(MeshSource& mesh, Handles& handles)
{
  SolveContext& context = this->System.context();
  context.beginReport();
  this->Steps.begin(true);
  this->Steps.solve(
    [&]
    {
      RotationProblem problem(handles, this->EdgeWeights,
        [this](std::int64_t vertex, const double* target) { this->Rest.hold(vertex, target); });
      // Measured against the motion: rotations begin at 0.
      const FirstResidual first =
        this->System.build(mesh, problem, &this->Rest, PositionStep::CoreBytes).alone();
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
  SolveContext& context = this->System.context();
  auto solution =
    std::make_unique<DeformedPositions>(this->System.takeSolution(), std::move(this->Rest));
  context.progress.finish();
  return solution;
}

} // namespace smg
