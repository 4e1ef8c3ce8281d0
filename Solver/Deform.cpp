// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Deform.h"

#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Solver/Jobs/Deformation/InteractiveEngine.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/MemoryEstimate.h"
#include "Solver/Multigrid/Extended.h"
#include "smg/DeformationDescription.h"
#include "smg/DescribedHandles.h"
#include "smg/Error.h"
#include "smg/Solve.h"

// The entries of deformations, deform() for a mesh stream and InteractiveDeformation for a mesh in
// memory: the instances of the engine templates, which are kept out of the public headers.

namespace smg
{

/** Checks what can be checked without the mesh. */
void checkOptions(const DeformOptions& options)
{
  checkOptions(static_cast<const SolveOptions&>(options));
  // There is no estimate of the discretisation error of the two steps.
  refuseAutomaticTolerance(options, "a deformation");
  checkOperators(options);
  if (options.cycles < 0)
  {
    throw Error("the number of V-cycles a step must not be negative");
  }
}

namespace
{

/** The operators with the fastest V-cycles: a deformation makes few of them, often a given number.
 */
CompiledOperators operatorsFor(CellType cells)
{
  return compiled(Extended::forFewCycles(cells));
}

} // namespace

/** The engine releases everything but the positions when it hands them over. */
std::unique_ptr<Solution> deform(MeshSource& mesh, Handles& handles, const DeformOptions& options)
{
  checkOptions(options);
  const CellType cells = mesh.info().cellType;
  DeformationEngine engine(operatorsFor(cells), options, cells);
  // The mesh is read here, in the first pass; the handles are asked block by block.
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
  constexpr int RotationColumns = 4; // the step that needs more
  requireMemory(mesh.info(), RotationColumns, completed.weights, completed);
  handles.prepare(*source(), completed.scratch, completed.memoryLimit);
  identify(completed, mesh, "");
  return deform(*source(), handles, completed);
}

/** Hides the templates of the engine from the header. */
struct InteractiveDeformation::Implementation
{
  InteractiveEngine engine;
};

namespace
{

/** The options of an interactive deformation, which are checked like others. */
DeformOptions inCore(DeformOptions options)
{
  // Updates access the values of all vertices in any order.
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
  // False if other vertices are held: then the matrix is another one, and a new object is needed.
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
