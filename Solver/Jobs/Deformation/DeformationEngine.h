// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Engine/StreamedSolution.h"
#include "smg/Deform.h"
#include "smg/Solve.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace smg
{

/** The two problems of a deformation on one hierarchy: the rotations, then the positions. A shared
 * pass finishes the last V-cycle of the rotations and begins the first one of the positions. */
class DeformationSteps
{
public:
  DeformationSteps(SolveContext& run, Hierarchy& hierarchy, RestShape& rest,
    const DeformOptions& options, CellType cells)
    : Run(run)
    , Levels(hierarchy)
    , Rest(rest)
    , EdgeWeights(options.weights)
    , Cycles(options.cycles)
    , Cells(cells)
  {
  }

  /** Begins the progress. `builds`: the first pass is still to be made. */
  void begin(bool builds) { this->Run.progress.begin(this->stopping(), 0.0, Share, builds); }
  /** Performs both steps. `build` begins the first V-cycle of the rotations and returns their first
   * residual; if there is a checkpoint to continue from, it is not called. */
  void solve(const std::function<FirstResidual()>& build);

private:
  /** The part of the progress that the rotations take. */
  static constexpr double Share = 0.6;

  Stopping stopping() const
  {
    return { this->Run.options.tolerance, this->Run.options.maxCycles, this->Cycles };
  }
  /** What the passes of a step have in common. */
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
    Iteration iteration;
  };

  bool resume(Step& rotations, Step& positions, bool& rotated);
  void beginPositions(Step& rotations, Step& positions);
  double sharedPass(PositionStep& step);
  double positionScale() const;

  SolveContext& Run;
  Hierarchy& Levels;
  RestShape& Rest;
  Weights EdgeWeights;
  int Cycles; // per step; 0: by the tolerance
  CellType Cells;
};

inline void DeformationSteps::solve(const std::function<FirstResidual()>& build)
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
  Report& r = this->Run.report;
  positions.convergence.addStep(r, "position", "position step: ");
  r.relative_to = MeshAtRest;
  r.converged = rotations.convergence.converged() && positions.convergence.converged();
  r.seconds.solve = this->Run.seconds() - r.seconds.build;
  addDeformationNotes(r);
  this->Run.finishReport();
}

/** Continues from a checkpoint, if there is one, and provides for further ones, between passes. A
 * checkpoint has the state of one of the steps: that of the positions if `rotated`, which is true
 * from the shared pass on. */
inline bool DeformationSteps::resume(Step& rotations, Step& positions, bool& rotated)
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
inline void DeformationSteps::beginPositions(Step& rotations, Step& positions)
{
  PositionStep step(this->Run.pool, this->Rest, this->Levels.window());
  const double norm = this->sharedPass(step);
  checkMotions(step.termSquares());
  rotations.convergence.add(std::sqrt(step.rotationSquares()));
  rotations.convergence.addStep(this->Run.report, "rotation", "rotation step: ");
  this->Run.progress.begin(this->stopping(), Share, 1.0, false);
  // The initial values are the mesh at rest.
  const double motion = std::sqrt(step.initialSquares());
  positions.convergence =
    Convergence(this->stopping(), { motion, roundingOf(step.termSquares()), motion });
  positions.convergence.begin(norm);
}

/** Returns the norm of the residual of the positions after their first sweeps. */
inline double DeformationSteps::sharedPass(PositionStep& step)
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

/** An estimate of the largest residual of the positions: weights of triangles are of order 1, those
 * of tetrahedra of the order of lengths. */
inline double DeformationSteps::positionScale() const
{
  const double extent = this->Rest.extent();
  const bool lengths =
    this->Cells == CellType::Tetrahedron && this->EdgeWeights == Weights::Clamped;
  return lengths ? extent * extent : extent;
}

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

/** Deforms a mesh: the first pass builds the hierarchy and begins the first V-cycle of the
 * rotations; DeformationSteps does the rest. */
class DeformationEngine
{
public:
  DeformationEngine(CompiledOperators operators, const DeformOptions& options, CellType cells)
    : Set(std::move(operators))
    , EdgeWeights(options.weights)
    , Run(std::make_unique<SolveContext>(RotationProblem::Columns, options))
    , Levels(*this->Run, RotationProblem::Columns, this->Set.relaxation)
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

  SolveContext& run() { return *this->Run; }
  Hierarchy& levels() { return this->Levels; }
  RestShape& rest() { return this->Rest; }
  DeformationSteps& steps() { return this->Steps; }

private:
  static void ask(MeshSource& mesh, Handles& handles);

  CompiledOperators Set;
  Weights EdgeWeights;
  std::unique_ptr<SolveContext> Run;
  Hierarchy Levels;
  RestShape Rest;
  DeformationSteps Steps;
};

inline void DeformationEngine::deform(MeshSource& mesh, Handles& handles)
{
  SolveContext& run = *this->Run;
  run.beginReport();
  this->Steps.begin(true);
  this->Steps.solve(
    [&]
    {
      RotationProblem problem(handles, this->EdgeWeights,
        [this](std::int64_t vertex, const double* target) { this->Rest.hold(vertex, target); });
      FirstPass build(run, this->Levels, this->Set);
      // Measured against the motion: rotations begin at 0.
      const FirstResidual first =
        build(mesh, problem, &this->Rest, PositionStep::CoreBytes).alone();
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

/** Asks the handles for each block, as the first pass does. A run that continues from a checkpoint
 * does not make that pass, but the notes of the handles need it (DescribedHandles::notes()). */
inline void DeformationEngine::ask(MeshSource& mesh, Handles& handles)
{
  MeshBlock block;
  VertexHandles given;
  while (mesh.next(block))
  {
    given.clear(static_cast<std::size_t>(block.vertices()));
    handles.at(block, given);
  }
}

inline std::unique_ptr<Solution> DeformationEngine::takeSolution()
{
  SolveContext& run = *this->Run;
  auto displacements =
    std::make_unique<StreamedSolution>(std::move(this->Run), this->Levels.takeWindow());
  auto solution =
    std::make_unique<DeformedPositions>(std::move(displacements), std::move(this->Rest));
  run.progress.finish();
  return solution;
}

} // namespace smg
