// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"

#include "Solver/Jobs/Deformation/DeformationEngine.h"
#include "Solver/Jobs/Deformation/PositionStep.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/GivenSystem.h"
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
  for (std::int64_t number = 0; number < rest.blocks(); ++number)
  {
    const RestBlock block = rest.block(number);
    for (RestBlock::Held& held : block.held())
    {
      f(held, static_cast<std::size_t>(block.first() + held.node));
    }
  }
}

/** The rotations and scales of held vertices; all others begin with 0. */
class HeldRotations final : public SystemValues
{
public:
  explicit HeldRotations(const VertexHandles& handles)
    : Handles(handles)
  {
  }

  void give(const SystemRecord& /*record*/, std::int64_t first, std::int64_t count,
    std::span<const double> /*before*/, std::span<double> x, std::span<double> b) override
  {
    std::ranges::fill(x, 0.0);
    for (std::int64_t k = 0; k < count; ++k)
    {
      const auto i = static_cast<std::size_t>(first + k);
      double* value = b.data() + RotationProblem::Columns * k;
      if (this->Handles.mask[i] != 0)
      {
        std::copy_n(this->Handles.rotation.data() + 3 * i, 3, value);
        value[3] = this->Handles.logScale[i];
      }
    }
  }

private:
  const VertexHandles& Handles;
};

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
  return this->Engine->system().context().report;
}

bool InteractiveDeformation::update(const VertexHandles& handles)
{
  StreamedSystem& system = this->Engine->system();
  SolveContext& context = system.context();
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
      HeldRotations rotations(handles);
      GivenSystem next(context, this->Engine->rest().system(), system.window(), rotations,
        RotationProblem::Columns);
      system.restart(next);
      return next.residual(system.levels()).alone();
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
  this->Engine->system().window().readX(first, count, values.data());
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

/** Sets the targets of the held vertices. */
void InteractiveDeformation::take(const VertexHandles& handles)
{
  std::int64_t& shared = this->Engine->system().context().report.shared;
  shared = 0;
  forHeld(this->Engine->rest(),
    [&](RestBlock::Held& held, std::size_t i)
    {
      std::copy_n(handles.target.data() + 3 * i, 3, held.target.data());
      shared += handles.mask[i] > 1 ? 1 : 0;
    });
}

} // namespace smg
