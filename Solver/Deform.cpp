// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Deform.h"

#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Solver/Jobs/Deformation/InteractiveEngine.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/ExtendedEngine.h"
#include "Solver/Multigrid/Extended.h"
#include "Solver/Shi2006/Shi2006.h"
#include "smg/DeformationDescription.h"
#include "smg/DescribedHandles.h"
#include "smg/Error.h"
#include "smg/Solve.h"

namespace smg
{

void checkOptions(const DeformOptions& options)
{
  if (options.operators == Shi2006::name)
  {
    throw Error("a deformation needs solutions, which the operator set " + options.operators +
                " does not give: use " + Extended::name);
  }
  checkOptions(static_cast<const SolveOptions&>(options));
  refuseAutomaticTolerance(options, "a deformation");
  checkOperators(options);
  if (options.cycles < 0)
  {
    throw Error("the number of V-cycles a step must not be negative");
  }
}

namespace
{

/**
 * The most effective V-cycles, since a given number of them per step must achieve much with few.
 */
Extended operatorsFor(CellType cells)
{
  return Extended::forFewCycles(cells);
}

} // namespace

std::unique_ptr<Solution> deform(MeshSource& mesh, Handles& handles, const DeformOptions& options)
{
  checkOptions(options);
  const CellType cells = mesh.info().cellType;
  DeformationEngine<Extended> engine(operatorsFor(cells), options, cells);
  engine.deform(mesh, handles);
  return engine.takeSolution();
}

std::unique_ptr<Solution> deform(const StoredMesh& mesh, const DeformationDescription& description,
  const DeformOptions& options, const std::string& name)
{
  DeformOptions completed = options;
  description.applyTo(completed);
  DescribedHandles handles(description, mesh.info(), name);
  const auto source = [&] { return mesh.source(handles.vertexColumns(), handles.cellColumns()); };
  handles.prepare(*source(), completed.scratch, completed.memoryLimit);
  identify(completed, mesh, "");
  return deform(*source(), handles, completed);
}

struct InteractiveDeformation::Implementation
{
  InteractiveEngine<Extended> engine;
};

namespace
{

DeformOptions inCore(DeformOptions options)
{
  options.inCore = true;
  checkOptions(options);
  return options;
}

} // namespace

InteractiveDeformation::InteractiveDeformation(
  MeshSource& mesh, Handles& handles, const DeformOptions& options)
  : Self(new Implementation{
      { operatorsFor(mesh.info().cellType), inCore(options), mesh.info().cellType } })
{
  this->Self->engine.deform(mesh, handles);
}

InteractiveDeformation::~InteractiveDeformation() = default;

bool InteractiveDeformation::update(const VertexHandles& handles)
{
  return this->Self->engine.deformAgain(handles);
}

std::int64_t InteractiveDeformation::vertices() const
{
  return this->Self->engine.report().vertices;
}

void InteractiveDeformation::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  this->Self->engine.read(first, count, values);
}

const Report& InteractiveDeformation::report() const
{
  return this->Self->engine.report();
}

} // namespace smg
