// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Deform.h"

#include "Solver/Jobs/Deformation/DeformationEngine.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "smg/DeformationDescription.h"
#include "smg/DescribedHandles.h"
#include "smg/Solve.h"

// The entries of deformations: check the options and leave the work to the engine.

namespace smg
{

/** Checks what can be checked without the mesh. */
void checkOptions(const DeformOptions& options)
{
  checkOptions(static_cast<const SolveOptions&>(options));
  // There is no estimate of the discretisation error of the two steps.
  refuseAutomaticTolerance(options, "a deformation");
  checkOperators(options);
  require(options.cycles >= 0, "the number of V-cycles a step must not be negative");
}

/** The engine releases everything but the positions when it hands them over. */
std::unique_ptr<Solution> deform(MeshSource& mesh, Handles& handles, const DeformOptions& options)
{
  checkOptions(options);
  DeformationEngine engine(options, mesh.info().cellType);
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

} // namespace smg
