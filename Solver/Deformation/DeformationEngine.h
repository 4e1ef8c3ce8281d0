// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/DeformOptions.h"
#include "Solver/Deformation/Handles.h"
#include "Solver/Deformation/PositionStep.h"
#include "Solver/Deformation/RestShape.h"
#include "Solver/Deformation/RotationProblem.h"
#include "Solver/Engine/Engine.txx"
#include "Solver/Engine/Solution.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Two problems on one hierarchy: the rotations, then the positions. The first pass builds and
 * begins the rotations' first V-cycle; the shared pass finishes their last one and begins the
 * positions' first one.
 */
template <OperatorSet Operators>
class DeformationEngine : public Engine<Operators>
{
public:
  DeformationEngine(Operators operators, const DeformOptions& options, CellType cells)
    : Engine<Operators>(std::move(operators), RotationProblem::Columns, options)
    , EdgeWeights(options.weights)
    , Cycles(options.cycles)
    , Cells(cells)
    , Rest(this->Memory)
  {
    if (this->Scratch)
    {
      this->Rest.useScratch(this->Scratch->path(), this->Traffic.add("rest"));
    }
  }

  void deform(MeshSource& mesh, Handles& handles);

  /** The positions: where displacements begin, and these. */
  int columns() const override { return PositionStep::Columns; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;

  using Engine<Operators>::keepSolution;

protected:
  Stopping stopping() const
  {
    return { this->Options.tolerance, this->Options.maxCycles, this->Cycles };
  }
  /** Both steps, after the pass that has begun the first V-cycle of the first one. */
  void solveSteps();

  Weights EdgeWeights;
  int Cycles; // a step; 0: by the tolerance
  CellType Cells;
  RestShape Rest;

private:
  double sharedPass(PositionStep& step);
  void addStep(const char* name, const Convergence& convergence);
  void addNotes();
  double positionScale() const;

  std::vector<double> Start; // of read()
};

template <OperatorSet Operators>
void DeformationEngine<Operators>::deform(MeshSource& mesh, Handles& handles)
{
  this->beginReport();
  this->Progress.begin(this->stopping(), 0.0, 0.6, true);
  RotationProblem problem(handles, this->EdgeWeights, this->Rest);
  this->build(mesh, problem, &this->Rest, PositionStep::CoreBytes);
  this->Rest.finish();
  if (this->Result.prescribed == 0)
  {
    throw Error("no vertex of the mesh is held by a handle: there is nothing to deform it by");
  }
  this->Result.shared = problem.shared();
  this->solveSteps();
}

template <OperatorSet Operators>
void DeformationEngine<Operators>::solveSteps()
{
  const Timer solving;
  const Stopping stopping = this->stopping();
  Convergence rotations(stopping, this->InitialNorm, this->RoundingNorm);
  rotations.begin(this->residualNorm());
  this->iterate(rotations, true, "rotation step: ");

  PositionStep step(this->Memory, this->Rest, this->Hierarchy.finest->window());
  const double norm = this->sharedPass(step);
  if (!std::isfinite(step.termSquares()))
  {
    throw Error(
      "the handles move the mesh beyond the range of numbers: use targets that are nearer");
  }
  rotations.add(std::sqrt(step.rotationSquares()));
  this->addStep("rotation", rotations);

  this->Progress.begin(stopping, 0.6, 1.0, false);
  Convergence positions(stopping, std::sqrt(step.initialSquares()), roundingOf(step.termSquares()));
  positions.begin(norm);
  this->iterate(positions, false, "position step: ");
  this->addStep("position", positions);
  this->Result.converged = rotations.converged() && positions.converged();
  this->Result.seconds.solve = solving.seconds();
  this->addNotes();
  this->finishReport();
}

/** Answers the norm of the positions' residual after their first sweeps. */
template <OperatorSet Operators>
double DeformationEngine<Operators>::sharedPass(PositionStep& step)
{
  auto& finest = *this->Hierarchy.finest;
  finest.window().renew(PositionStep::Columns, true);
  for (auto& level : this->Hierarchy.coarse)
  {
    level->window().renew(PositionStep::Columns, false);
  }
  this->runCore();
  step.startPass();
  this->pass(
    this->positionScale(), [&step] { step.load(); },
    [&step, &finest]
    {
      step.advance(finest.finishedUp());
      finest.setRenewed(step.done());
    });
  step.endPass();
  return this->residualNorm();
}

/** About how large the positions' residuals can be: weights are of the size of 1 on surfaces, of
 * lengths in volumes. */
template <OperatorSet Operators>
double DeformationEngine<Operators>::positionScale() const
{
  const double extent = this->Rest.extent();
  const bool lengths =
    this->Cells == CellType::Tetrahedron && this->EdgeWeights == Weights::Clamped;
  return lengths ? extent * extent : extent;
}

template <OperatorSet Operators>
void DeformationEngine<Operators>::addStep(const char* name, const Convergence& convergence)
{
  Report& r = this->Result;
  r.cycles += convergence.cycles();
  r.residuals.insert(
    r.residuals.end(), convergence.residuals().begin(), convergence.residuals().end());
  r.steps.push_back({ name, convergence.cycles(),
    convergence.residuals().empty() ? 0.0 : convergence.residuals().back(),
    convergence.converged() });
  convergence.addNotes(r.notes, std::string(name) + " step: ");
}

template <OperatorSet Operators>
void DeformationEngine<Operators>::addNotes()
{
  Report& r = this->Result;
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

template <OperatorSet Operators>
void DeformationEngine<Operators>::read(
  std::int64_t first, std::int64_t count, std::span<double> values)
{
  const auto numbers = static_cast<std::size_t>(PositionStep::Columns * count);
  this->checkRange(first, count, values.size() / PositionStep::Columns);
  this->Hierarchy.finest->window().readX(first, count, values.data());
  this->Start.resize(numbers);
  this->Rest.readStart(first, count, this->Start.data());
  for (std::size_t k = 0; k < numbers; ++k)
  {
    values[k] += this->Start[k];
  }
}

} // namespace smg
