// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/DeformationEngine.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/Pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace smg
{

/** A deformation in core that can be repeated with other motions of the same held vertices: only
 * the right-hand sides change, so that hierarchy and factorisation are kept. All values start anew.
 */
class InteractiveEngine
{
public:
  /** `options` must be those of a deformation in core. */
  InteractiveEngine(CompiledOperators operators, const DeformOptions& options, CellType cells)
    : First(std::move(operators), options, cells)
  {
  }

  /** To be called once. */
  void deform(MeshSource& mesh, Handles& handles) { this->First.deform(mesh, handles); }
  /** After deform(). Returns false, without any change, if other vertices are held. */
  bool deformAgain(const VertexHandles& handles);

  const Report& report() { return this->First.run().report; }
  /** The positions; see Solution. Throws Error after an aborted update. */
  void read(std::int64_t first, std::int64_t count, std::span<double> values);

private:
  template <class F>
  void forHeld(F&& f);
  bool holdsTheSame(const VertexHandles& handles);
  void take(const VertexHandles& handles);
  FirstResidual findRightSide();

  DeformationEngine First;
  /** Whether an update ended with an exception. */
  bool Broken = false;
};

inline bool InteractiveEngine::deformAgain(const VertexHandles& handles)
{
  SolveContext& run = this->First.run();
  checkSize(handles, run.report.vertices);
  if (!this->holdsTheSame(handles))
  {
    return false;
  }
  this->forHeld([&](const RestBlock::Held&, std::size_t i)
    { checkHeld(handles, i, static_cast<std::int64_t>(i)); });
  this->Broken = true;
  run.beginAgain();
  this->take(handles);
  this->First.steps().begin(false);
  this->First.steps().solve(
    [&]
    {
      const FirstResidual first = this->findRightSide();
      Pass(run, this->First.levels()).begin();
      return first;
    });
  this->Broken = false;
  return true;
}

inline void InteractiveEngine::read(
  std::int64_t first, std::int64_t count, std::span<double> values)
{
  if (this->Broken)
  {
    throw Error("the last update was broken off: there are no positions until one succeeds");
  }
  checkVertexRange(first, count, values.size() / PositionStep::Columns, this->report().vertices);
  this->First.levels().window().readX(first, count, values.data());
  this->First.rest().addStart(first, count, values.data());
}

/** Calls f(held, index) for each held vertex. */
template <class F>
void InteractiveEngine::forHeld(F&& f)
{
  for (const RestBlock& block : this->First.rest().blocks())
  {
    for (RestBlock::Held& held : block.held())
    {
      f(held, static_cast<std::size_t>(block.first() + held.node));
    }
  }
}

inline bool InteractiveEngine::holdsTheSame(const VertexHandles& handles)
{
  const auto isHeld = [](std::uint8_t mask) { return mask != 0; };
  bool same =
    std::count_if(handles.mask.begin(), handles.mask.end(), isHeld) == this->report().prescribed;
  this->forHeld(
    [&](const RestBlock::Held&, std::size_t i) { same = same && isHeld(handles.mask[i]); });
  return same;
}

/** Sets the targets of the held vertices, and their rotations and scales; all others begin with 0.
 */
inline void InteractiveEngine::take(const VertexHandles& handles)
{
  LevelWindow<double>& window = this->First.levels().window();
  window.abandon();
  window.setColumns(RotationProblem::Columns);
  std::ranges::fill(window.x().range(0, window.nodes()), 0.0);
  std::int64_t& shared = this->First.run().report.shared;
  shared = 0;
  this->forHeld(
    [&](RestBlock::Held& held, std::size_t i)
    {
      std::copy_n(handles.target.data() + 3 * i, 3, held.target.data());
      double* x = window.x().at(static_cast<std::int64_t>(i));
      std::copy_n(handles.rotation.data() + 3 * i, 3, x);
      x[3] = handles.logScale[i];
      shared += handles.mask[i] > 1 ? 1 : 0;
    });
}

/** Computes the right-hand side of the rotations as Assembly does. With initial values of 0, b - A
 * x is b at free vertices. */
inline FirstResidual InteractiveEngine::findRightSide()
{
  LevelWindow<double>& window = this->First.levels().window();
  std::ranges::copy(window.x().range(0, window.nodes()), window.b().at(0));
  constexpr std::size_t Columns = RotationProblem::Columns;
  ColumnResiduals residual{ std::vector<double>(Columns), std::vector<double>(Columns), {} };
  const auto addSquares = [&](std::int64_t i)
  {
    for (std::size_t c = 0; c < Columns; ++c)
    {
      residual.squares[c] += window.b().at(i)[c] * window.b().at(i)[c];
    }
  };
  for (const RestBlock& block : this->First.rest().blocks())
  {
    addKnownValues(block.first(), std::span<const RestBlock::Link>(block.links()),
      RotationProblem::Columns, window.x(), window.b(), addSquares);
  }
  residual.rounding = residual.squares;
  return residual.alone();
}

} // namespace smg
