// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"

#include "Solver/Jobs/Deformation/DeformationEngine.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

// A deformation in core that is repeated with other motions of the same held vertices: only the
// right-hand sides change, so that hierarchy and factorisation are kept. All values start anew.

namespace smg
{
namespace
{

/** The options of an interactive deformation, which are checked like others. */
DeformOptions interactiveOptions(DeformOptions options)
{
  // Updates access the values of all vertices in any order.
  options.inCore = true;
  checkOptions(options);
  return options;
}

/** Calls f(held, index) for each held vertex. */
template <class F>
void forHeld(RestShape& rest, F&& f)
{
  for (const RestBlock& block : rest.blocks())
  {
    for (RestBlock::Held& held : block.held())
    {
      f(held, static_cast<std::size_t>(block.first() + held.node));
    }
  }
}

} // namespace

InteractiveDeformation::InteractiveDeformation(
  MeshSource& mesh, Handles& handles, const DeformOptions& options)
  : Engine(std::make_unique<DeformationEngine>(interactiveOptions(options), mesh.info().cellType))
{
  this->Engine->deform(mesh, handles);
}

InteractiveDeformation::~InteractiveDeformation() = default;

std::int64_t InteractiveDeformation::vertices() const
{
  return this->report().vertices;
}

const Report& InteractiveDeformation::report() const
{
  return this->Engine->context().report;
}

bool InteractiveDeformation::update(const VertexHandles& handles)
{
  SolveContext& context = this->Engine->context();
  checkSize(handles, context.report.vertices);
  if (!this->holdsTheSame(handles))
  {
    return false;
  }
  forHeld(this->Engine->rest(), [&](const RestBlock::Held&, std::size_t i)
    { checkHeld(handles, i, static_cast<std::int64_t>(i)); });
  this->Broken = true;
  context.beginAgain();
  this->take(handles);
  this->Engine->steps().begin(false);
  this->Engine->steps().solve(
    [&]
    {
      const FirstResidual first = this->findRightSide();
      Pass(context, this->Engine->levels()).begin();
      return first;
    });
  this->Broken = false;
  return true;
}

void InteractiveDeformation::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  if (this->Broken)
  {
    throw Error("the last update was broken off: there are no positions until one succeeds");
  }
  checkVertexRange(first, count, values.size() / PositionStep::Columns, this->report().vertices);
  this->Engine->levels().window().readX(first, count, values.data());
  this->Engine->rest().addStart(first, count, values.data());
}

bool InteractiveDeformation::holdsTheSame(const VertexHandles& handles) const
{
  const auto isHeld = [](std::uint8_t mask) { return mask != 0; };
  bool same =
    std::count_if(handles.mask.begin(), handles.mask.end(), isHeld) == this->report().prescribed;
  forHeld(this->Engine->rest(),
    [&](const RestBlock::Held&, std::size_t i) { same = same && isHeld(handles.mask[i]); });
  return same;
}

/** Sets the targets of the held vertices, and their rotations and scales; all others begin with 0.
 */
void InteractiveDeformation::take(const VertexHandles& handles)
{
  LevelWindow<double>& window = this->Engine->levels().window();
  window.abandon();
  window.setColumns(RotationProblem::Columns);
  std::ranges::fill(window.x().range(0, window.nodes()), 0.0);
  std::int64_t& shared = this->Engine->context().report.shared;
  shared = 0;
  forHeld(this->Engine->rest(),
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
FirstResidual InteractiveDeformation::findRightSide()
{
  LevelWindow<double>& window = this->Engine->levels().window();
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
  for (const RestBlock& block : this->Engine->rest().blocks())
  {
    addKnownValues(block.first(), std::span<const RestBlock::Link>(block.links()),
      RotationProblem::Columns, window.x(), window.b(), addSquares);
  }
  residual.rounding = residual.squares;
  return residual.alone();
}

} // namespace smg
