// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Deformation/PositionStep.h"
#include "Solver/Deformation/RestShape.h"
#include "Solver/Engine/Convergence.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/Iteration.h"
#include "Solver/Engine/Pass.h"
#include "Solver/Engine/SolveRun.h"
#include "smg/Deform.h"
#include "smg/Error.h"

#include <cmath>
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
  /** Performs both steps, after the pass that has begun the first V-cycle of the rotations, whose
   * residual was `first`. */
  void solve(const FirstResidual& first);

private:
  /** The share of the rotations in the progress. */
  static constexpr double Share = 0.6;

  Stopping stopping() const
  {
    return { this->Run.options.tolerance, this->Run.options.maxCycles, this->Cycles };
  }
  double sharedPass(PositionStep& step);
  void addStep(const char* name, const Convergence& convergence);
  void addNotes();
  double positionScale() const;

  SolveRun& Run;
  Hierarchy<Relaxation>& Levels;
  RestShape& Rest;
  Weights EdgeWeights;
  int Cycles; // per step; 0: by the tolerance
  CellType Cells;
};

template <class Relaxation>
void DeformationSteps<Relaxation>::solve(const FirstResidual& first)
{
  const Timer solving;
  const Stopping stopping = this->stopping();
  Convergence rotations(stopping, first);
  rotations.begin(this->Levels.residualNorm());
  Iteration(this->Run, this->Levels, rotations, "rotation step: ")(true);

  PositionStep step(this->Run.pool, this->Rest, this->Levels.window());
  const double norm = this->sharedPass(step);
  if (!std::isfinite(step.termSquares()))
  {
    throw Error(
      "the handles move the mesh beyond the range of numbers: use targets that are nearer");
  }
  rotations.add(std::sqrt(step.rotationSquares()));
  this->addStep("rotation", rotations);

  this->Run.progress.begin(stopping, Share, 1.0, false);
  Convergence positions(
    stopping, { std::sqrt(step.initialSquares()), roundingOf(step.termSquares()) });
  positions.begin(norm);
  Iteration(this->Run, this->Levels, positions, "position step: ")(false);
  this->addStep("position", positions);
  this->Run.report.converged = rotations.converged() && positions.converged();
  this->Run.report.seconds.solve = solving.seconds();
  this->addNotes();
  this->Run.finishReport();
}

/** Returns the norm of the residual of the positions after their first sweeps. */
template <class Relaxation>
double DeformationSteps<Relaxation>::sharedPass(PositionStep& step)
{
  auto& finest = this->Levels.finest();
  this->Levels.renew(PositionStep::Columns);
  step.startPass();
  Pass(this->Run, this->Levels)(this->positionScale(), { [&step] { step.load(); },
                                                         [&step, &finest]
                                                         {
                                                           step.advance(finest.finishedUp());
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

template <class Relaxation>
void DeformationSteps<Relaxation>::addNotes()
{
  Report& r = this->Run.report;
  if (r.shared > 0)
  {
    r.notes.push_back(
      std::to_string(r.shared) + " vertices are held by more than one handle: the last one counts");
  }
  if (r.free_components > 0)
  {
    r.notes.push_back(std::to_string(r.free_components) + " of " + std::to_string(r.components) +
                      " components have no held vertex: they stay as they are");
  }
}

} // namespace smg
