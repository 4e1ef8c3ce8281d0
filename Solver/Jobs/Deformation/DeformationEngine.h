// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "Solver/Multigrid/Engine/StreamedSystem.h"
#include "smg/Deform.h"
#include "smg/Solve.h"

#include <functional>
#include <memory>
#include <string>

namespace smg
{

/** The two systems of a deformation on one hierarchy: the rotations, then the positions. */
class DeformationSteps
{
public:
  DeformationSteps(
    StreamedSystem& system, RestShape& rest, const DeformOptions& options, CellType cells)
    : System(system)
    , Context(system.context())
    , Rest(rest)
    , EdgeWeights(options.weights)
    , Cycles(options.cycles)
    , Cells(cells)
  {
  }

  /** Begins the progress. `builds`: the first pass is still to be made. */
  void begin(bool builds) { this->Context.progress.begin(this->stopping(), 0.0, Share, builds); }
  /** Performs both steps. `build` begins the first V-cycle of the rotations and returns their first
   * residual; if there is a checkpoint to continue from, it is not called. */
  void solve(const std::function<FirstResidual()>& build);

private:
  /** The part of the progress that the rotations take. */
  static constexpr double Share = 0.6;

  Stopping stopping() const
  {
    return { this->Context.options.tolerance, this->Context.options.maxCycles, this->Cycles };
  }
  /** What the passes of a step have in common. */
  struct Step
  {
    Step(DeformationSteps& steps, const std::string& what)
      : convergence(steps.stopping(), {})
      , iteration(steps.Context, steps.System.levels(), convergence, what)
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
  double positionScale() const;

  StreamedSystem& System;
  SolveContext& Context;
  RestShape& Rest;
  Weights EdgeWeights;
  int Cycles; // per step; 0: by the tolerance
  CellType Cells;
};

/** Deforms a mesh: the first pass builds the hierarchy and begins the first V-cycle of the
 * rotations; DeformationSteps does the rest. */
class DeformationEngine
{
public:
  DeformationEngine(const DeformOptions& options, CellType cells);
  DeformationEngine(const DeformationEngine&) = delete;
  DeformationEngine& operator=(const DeformationEngine&) = delete;

  /** To be called once. */
  void deform(MeshSource& mesh, Handles& handles);
  /** Returns the positions after deform() and releases everything else. */
  std::unique_ptr<Solution> takeSolution();

  // The parts, for further deformations.

  StreamedSystem& system() { return this->System; }
  RestShape& rest() { return this->Rest; }
  DeformationSteps& steps() { return this->Steps; }

private:
  static void ask(MeshSource& mesh, Handles& handles);

  Weights EdgeWeights;
  StreamedSystem System;
  RestShape Rest;
  DeformationSteps Steps;
};

} // namespace smg
