// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "Solver/Multigrid/Engine/SolveRun.h"
#include "smg/Deform.h"

#include <cmath>
#include <functional>
#include <string>

namespace smg
{

/** The two problems of a deformation on one hierarchy: the rotations, then the positions. A shared
 * pass finishes the last V-cycle of the rotations and begins the first one of the positions. */
template <class Relaxation>
class DeformationSteps
{
public:
  DeformationSteps(SolveRun& run, Hierarchy<Relaxation>& hierarchy, RestShape& rest,
    const DeformOptions& options, CellType cells)
    : Run(run)
    , Levels(hierarchy)
    , Rest(rest)
    , EdgeWeights(options.weights)
    , Cycles(options.cycles)
    , Cells(cells)
  {
  }

  /** Begins the progress; `builds`: with the first pass. */
  void begin(bool builds) { this->Run.progress.begin(this->stopping(), 0.0, Share, builds); }
  /** Performs both steps; `build` begins the first V-cycle of the rotations and returns their first
   * residual. With a checkpoint, it continues from that instead, if it can. */
  void solve(const std::function<FirstResidual()>& build);

private:
  /** The share of the rotations in the progress. */
  static constexpr double Share = 0.6;

  Stopping stopping() const
  {
    return { this->Run.options.tolerance, this->Run.options.maxCycles, this->Cycles };
  }
  /** The part of a step that its passes share. */
  struct Step
  {
    Step(DeformationSteps& steps, const std::string& what)
      : convergence(steps.stopping(), {})
      , iteration(steps.Run, steps.Levels, convergence, what)
    {
    }

    template <class State>
    void exchange(State& state)
    {
      state(this->convergence, this->iteration);
    }

    Convergence convergence;
    Iteration<Relaxation> iteration;
  };

  bool resume(Step& rotations, Step& positions, bool& rotated);
  void beginPositions(Step& rotations, Step& positions);
  double sharedPass(PositionStep& step);
  void addStep(const char* name, const Convergence& convergence);
  double positionScale() const;

  SolveRun& Run;
  Hierarchy<Relaxation>& Levels;
  RestShape& Rest;
  Weights EdgeWeights;
  int Cycles; // per step; 0: by the tolerance
  CellType Cells;
};

template <class Relaxation>
void DeformationSteps<Relaxation>::solve(const std::function<FirstResidual()>& build)
{
  Step rotations(*this, "rotation step: "), positions(*this, "position step: ");
  bool rotated = false;
  if (!this->resume(rotations, positions, rotated))
  {
    rotations.convergence = Convergence(this->stopping(), build());
    rotations.convergence.begin(this->Levels.residualNorm());
    this->Run.endPass(1.0);
  }
  if (!rotated)
  {
    rotations.iteration(true);
    this->beginPositions(rotations, positions);
    rotated = true;
    this->Run.endPass(rotations.convergence.residuals().back());
  }
  positions.iteration(false);
  this->addStep("position", positions.convergence);
  Report& r = this->Run.report;
  r.converged = rotations.convergence.converged() && positions.convergence.converged();
  r.seconds.solve = this->Run.seconds() - r.seconds.build;
  addDeformationNotes(r);
  this->Run.finishReport();
}

/** Between passes, `rotated` tells whether the last one was the shared pass or after it. */
template <class Relaxation>
bool DeformationSteps<Relaxation>::resume(Step& rotations, Step& positions, bool& rotated)
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
      this->Run.progress.begin(this->stopping(), Share, 1.0, false);
    }
    rotated ? state(positions) : state(rotations.iteration);
  };
  const auto weights = std::to_string(static_cast<int>(this->EdgeWeights));
  return this->Run.resume({ { "kind of task", "deformation" }, { "kind of weights", weights },
                            { "number of V-cycles", std::to_string(this->Cycles) } },
    { save, load });
}

/** The pass that finishes the last V-cycle of the rotations and begins the first one of the
 * positions. */
template <class Relaxation>
void DeformationSteps<Relaxation>::beginPositions(Step& rotations, Step& positions)
{
  PositionStep step(this->Run.pool, this->Rest, this->Levels.window());
  const double norm = this->sharedPass(step);
  checkMotions(step.termSquares());
  rotations.convergence.add(std::sqrt(step.rotationSquares()));
  this->addStep("rotation", rotations.convergence);
  this->Run.progress.begin(this->stopping(), Share, 1.0, false);
  positions.convergence = Convergence(
    this->stopping(), { std::sqrt(step.initialSquares()), roundingOf(step.termSquares()) });
  positions.convergence.begin(norm);
}

/** Returns the norm of the residual of the positions after their first sweeps. */
template <class Relaxation>
double DeformationSteps<Relaxation>::sharedPass(PositionStep& step)
{
  auto& finest = this->Levels.finest();
  this->Levels.renew(PositionStep::Columns);
  step.startPass();
  Pass(this->Run, this->Levels)(
    this->positionScale(), { [&step] { step.load(); },
                             [&step, &finest](bool follows)
                             {
                               step.advance(finest.finishedUp(step.turned(), follows));
                               finest.setRenewed(step.done());
                             } });
  step.endPass();
  return this->Levels.residualNorm();
}

/** An estimate of the largest residual of the positions: weights are of order 1 on surfaces, and of
 * the order of lengths in volumes. */
template <class Relaxation>
double DeformationSteps<Relaxation>::positionScale() const
{
  const double extent = this->Rest.extent();
  const bool lengths =
    this->Cells == CellType::Tetrahedron && this->EdgeWeights == Weights::Clamped;
  return lengths ? extent * extent : extent;
}

template <class Relaxation>
void DeformationSteps<Relaxation>::addStep(const char* name, const Convergence& convergence)
{
  Report& r = this->Run.report;
  r.cycles += convergence.cycles();
  r.residuals.insert(
    r.residuals.end(), convergence.residuals().begin(), convergence.residuals().end());
  r.steps.push_back({ name, convergence.cycles(),
    convergence.residuals().empty() ? 0.0 : convergence.residuals().back(),
    convergence.converged() });
  convergence.addNotes(r.notes, std::string(name) + " step: ");
}

} // namespace smg
