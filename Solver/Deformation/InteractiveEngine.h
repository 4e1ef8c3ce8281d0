// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/DeformationEngine.h"
#include "Solver/Deformation/HandleChecks.h"

#include <algorithm>

namespace smg
{

/** A deformation in core that can be repeated for other motions of the same held vertices. */
template <OperatorSet Operators>
class InteractiveEngine : public DeformationEngine<Operators>
{
public:
  using DeformationEngine<Operators>::DeformationEngine;

  /** After deform(). Returns false, without any change, if other vertices are held. */
  bool deformAgain(const VertexHandles& handles);

  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    if (this->Broken)
    {
      throw Error("the last update was broken off: there are no positions until one succeeds");
    }
    DeformationEngine<Operators>::read(first, count, values);
  }

private:
  template <class F>
  void forHeld(F&& f);
  bool holdsTheSame(const VertexHandles& handles);
  void take(const VertexHandles& handles);
  void beginRotations();

  /** Whether an update ended with an exception. */
  bool Broken = false;
};

template <OperatorSet Operators>
bool InteractiveEngine<Operators>::deformAgain(const VertexHandles& handles)
{
  this->beginReport();
  checkSize(handles, this->Result.vertices);
  if (!this->holdsTheSame(handles))
  {
    return false;
  }
  this->forHeld([&](const RestBlock::Held&, std::size_t i)
    { checkHeld(handles, i, static_cast<std::int64_t>(i)); });
  this->Broken = true;
  this->take(handles);
  Report& r = this->Result;
  r.passes = r.cycles = 0;
  r.seconds = {};
  r.residuals.clear();
  r.steps.clear();
  r.notes.clear();
  this->Progress.begin(this->stopping(), 0.0, 0.6, false);
  this->beginRotations();
  this->solveSteps();
  this->Broken = false;
  return true;
}

/** Calls f(held, index) for each held vertex. */
template <OperatorSet Operators>
template <class F>
void InteractiveEngine<Operators>::forHeld(F&& f)
{
  for (const RestBlock& block : this->Rest.blocks())
  {
    for (RestBlock::Held& held : block.held())
    {
      f(held, static_cast<std::size_t>(block.first() + held.node));
    }
  }
}

template <OperatorSet Operators>
bool InteractiveEngine<Operators>::holdsTheSame(const VertexHandles& handles)
{
  const auto isHeld = [](std::uint8_t mask) { return mask != 0; };
  bool same =
    std::count_if(handles.mask.begin(), handles.mask.end(), isHeld) == this->Result.prescribed;
  this->forHeld(
    [&](const RestBlock::Held&, std::size_t i) { same = same && isHeld(handles.mask[i]); });
  return same;
}

/** Sets the targets, and the initial rotations. */
template <OperatorSet Operators>
void InteractiveEngine<Operators>::take(const VertexHandles& handles)
{
  LevelWindow<double>& window = this->Hierarchy.finest->window();
  window.abandon();
  window.setColumns(RotationProblem::Columns);
  std::ranges::fill(window.x().range(0, window.nodes()), 0.0);
  this->Result.shared = 0;
  this->forHeld(
    [&](RestBlock::Held& held, std::size_t i)
    {
      std::copy_n(handles.target.data() + 3 * i, 3, held.target.data());
      double* x = window.x().at(static_cast<std::int64_t>(i));
      std::copy_n(handles.rotation.data() + 3 * i, 3, x);
      x[3] = handles.logScale[i];
      this->Result.shared += handles.mask[i] > 1 ? 1 : 0;
    });
}

/** Computes right-hand side and first sweeps of the rotations, like Assembly and the first pass. */
template <OperatorSet Operators>
void InteractiveEngine<Operators>::beginRotations()
{
  LevelWindow<double>& window = this->Hierarchy.finest->window();
  const Ring<double>& x = window.x();
  const Ring<double>& b = window.b();
  std::ranges::copy(x.range(0, window.nodes()), b.at(0));
  double squares = 0.0;
  for (const RestBlock& block : this->Rest.blocks())
  {
    const std::span<const RestBlock::Link> links = block.links();
    for (std::size_t l = 0; l < links.size();)
    {
      const std::int32_t node = links[l].node;
      const std::int64_t i = block.first() + node;
      for (; l < links.size() && links[l].node == node; ++l)
      {
        for (int c = 0; c < RotationProblem::Columns; ++c)
        {
          b.at(i)[c] += static_cast<double>(links[l].weight) * x.at(i + links[l].delta)[c];
        }
      }
      double own = 0.0;
      for (int c = 0; c < RotationProblem::Columns; ++c)
      {
        own += b.at(i)[c] * b.at(i)[c];
      }
      squares += own;
    }
  }
  this->InitialNorm = std::sqrt(squares);
  this->RoundingNorm = roundingOf(squares);
  for (auto& level : this->Hierarchy.coarse)
  {
    level->window().zeroB(0, level->window().nodes());
  }
  this->startPass(true);
  auto& finest = *this->Hierarchy.finest;
  finest.setScale(1.0);
  finest.advanceDown();
  finest.settle();
  this->endPass();
}

} // namespace smg
